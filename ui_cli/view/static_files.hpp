// The files of the page, compiled into the program, so that it does not depend on the sources' folder.
#pragma once
#include <span>
#include <string_view>

namespace mrroc::view {

/// One file.
struct StaticFile {
  std::string_view path;     ///< as in the address, beginning with '/'
  std::string_view type;     ///< of its content, for the browser
  std::string_view content;  ///< all of it, as it is sent
};

/// @return every file that the page may ask for
[[nodiscard]] std::span<const StaticFile> static_files();

}  // namespace mrroc::view
