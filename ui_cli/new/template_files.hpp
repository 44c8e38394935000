// The files from which `ui_cli new` makes robots, tasks and sensors: those of ui_cli/new/templates, inside the program.
#pragma once
#include <span>
#include <string_view>

namespace mrroc::ui {

/// One template.
struct TemplateFile {
  std::string_view path;  ///< below ui_cli/new/templates, without the ending .template
  std::string_view text;  ///< with places to be filled in
};

/// @return all of them, in alphabetical order
[[nodiscard]] std::span<const TemplateFile> template_files();

}  // namespace mrroc::ui
