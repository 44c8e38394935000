// Walks an SVG document and collects its drawing. Internal to the SVG reader.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tasks/drawing/svg_outline.hpp"

namespace mrroc::drawing::svg {

/// The drawing of a document, in the user units of its outermost element; y points down.
struct Document {
  std::vector<SubPath> paths;  ///< in document order
  std::string
      ignored;  ///< visible elements that have no outline, such as "image (1), text (3)", and style rules
                ///< about visibility that were not understood
};

/// @param text  the document
/// @param name  its file's name, for errors
/// @throws FileError  not well-formed, not SVG, a bad value in an element that is drawn, too much of it
[[nodiscard]] Document read_document(std::string_view text, const std::string& name);

}  // namespace mrroc::drawing::svg
