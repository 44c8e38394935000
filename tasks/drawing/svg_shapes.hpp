// SVG's shapes as outlines. Internal to the SVG reader.
#pragma once
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "tasks/drawing/svg_outline.hpp"

namespace mrroc::drawing::svg {

/// Lengths to which percentages refer [user units]; NaN where the document does not say.
struct Viewport {
  /// Of the element that holds the shapes [user units].
  double width{std::numeric_limits<double>::quiet_NaN()};
  double height{std::numeric_limits<double>::quiet_NaN()};
};

/// @return a property from the style attribute or, failing that, from the attribute of that name; empty if
/// neither gives it
[[nodiscard]] std::string_view property(const pugi::xml_node& node, const char* name);

/// @param whole  what 100% is [user units]
/// @return the length in an attribute [user units]; 0 if there is none @throws BadValue
[[nodiscard]] double length_attribute(const pugi::xml_node& node, const char* name, double whole);

/// @param name  the element's name without prefix
/// @return the outline of a path, line, polyline, polygon, rect, circle or ellipse in its own coordinates;
/// nothing if the element is none of these
/// @throws BadValue
[[nodiscard]] std::optional<Outline> shape(const pugi::xml_node& node, std::string_view name,
                                           const Viewport& viewport);

}  // namespace mrroc::drawing::svg
