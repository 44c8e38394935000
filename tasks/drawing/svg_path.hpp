// SVG path data. Internal to the SVG reader.
#pragma once
#include <string_view>

#include "tasks/drawing/svg_outline.hpp"

namespace mrroc::drawing::svg {

/// @param d  path data: M L H V C S Q T A Z and their relative forms (SVG 2, 9.3)
/// @return its outline; empty data and "none" draw nothing
/// @throws BadValue  with the place of the first error
[[nodiscard]] Outline path_data(std::string_view d);

}  // namespace mrroc::drawing::svg
