#include "tasks/drawing/svg_shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tasks/drawing/svg_path.hpp"

namespace mrroc::drawing::svg {
namespace {

constexpr double kPi = std::numbers::pi;

// Reads the lengths of one shape.
class Lengths {
 public:
  Lengths(const pugi::xml_node& node, const Viewport& viewport) : node_(node), viewport_(viewport) {}

  [[nodiscard]] double x(const char* name) const { return read(name, viewport_.width); }
  [[nodiscard]] double y(const char* name) const { return read(name, viewport_.height); }
  [[nodiscard]] double width(const char* name) const { return positive(name, x(name)); }
  [[nodiscard]] double height(const char* name) const { return positive(name, y(name)); }
  [[nodiscard]] double radius(const char* name) const {
    return positive(name, read(name, std::hypot(viewport_.width, viewport_.height) / std::numbers::sqrt2));
  }
  /// @return whether the attribute gives a value of its own
  [[nodiscard]] bool has(const char* name) const {
    const std::string_view value = node_.attribute(name).value();
    return !value.empty() && value != "auto";
  }

 private:
  [[nodiscard]] double read(const char* name, double whole) const {
    return has(name) ? length_attribute(node_, name, whole) : 0;
  }
  static double positive(const char* name, double value) {
    if (value < 0) throw BadValue(fmt::format("{} = {} is negative", name, value));
    return value;
  }

  const pugi::xml_node& node_;
  const Viewport& viewport_;
};

Outline line(const Lengths& of) {
  Outline out;
  out.move_to({of.x("x1"), of.y("y1")});
  out.line_to({of.x("x2"), of.y("y2")});
  return out;
}

Outline polyline(const pugi::xml_node& node, bool closed) {
  const std::vector<double> points = numbers(node.attribute("points").value());
  if (points.size() % 2 != 0) throw BadValue("points has an odd number of coordinates");
  Outline out;
  for (std::size_t k = 0; k < points.size(); k += 2) {
    const Point p(points[k], points[k + 1]);
    if (k == 0)
      out.move_to(p);
    else
      out.line_to(p);
  }
  if (closed || points.size() == 2) out.close();  // one point alone is a dot
  return out;
}

Outline ellipse(const Point& centre, double rx, double ry) {
  Outline out;
  if (rx == 0 || ry == 0) return out;
  out.move_to(centre + Point(rx, 0));
  out.ellipse(centre, rx, ry, 0, 2 * kPi);
  return out;
}

Outline rect(const Lengths& of) {
  const double w = of.width("width");
  const double h = of.height("height");
  Outline out;
  if (w == 0 || h == 0) return out;
  // One radius given stands for both (SVG 2, 10.2).
  const double given_x = of.has("rx") ? of.width("rx") : of.height("ry");
  const double given_y = of.has("ry") ? of.height("ry") : of.width("rx");
  const double rx = std::min(given_x, w / 2);
  const double ry = std::min(given_y, h / 2);
  const bool round = rx > 0 && ry > 0;
  const Point low(of.x("x"), of.y("y"));
  const Point high = low + Point(w, h);
  if (!round) {
    out.move_to(low);
    out.line_to({high.x(), low.y()});
    out.line_to(high);
    out.line_to({low.x(), high.y()});
    out.close();
    return out;
  }
  const Point near = low + Point(rx, ry);
  const Point far = high - Point(rx, ry);
  out.move_to({near.x(), low.y()});
  out.line_to({far.x(), low.y()});
  out.ellipse({far.x(), near.y()}, rx, ry, -kPi / 2, kPi / 2);
  out.line_to({high.x(), far.y()});
  out.ellipse(far, rx, ry, 0, kPi / 2);
  out.line_to({near.x(), high.y()});
  out.ellipse({near.x(), far.y()}, rx, ry, kPi / 2, kPi / 2);
  out.line_to({low.x(), near.y()});
  out.ellipse(near, rx, ry, kPi, kPi / 2);
  out.close();
  return out;
}

}  // namespace

std::string_view property(const pugi::xml_node& node, const char* name) {
  const std::string_view styled = style_property(node.attribute("style").value(), name);
  return styled.empty() ? std::string_view(node.attribute(name).value()) : styled;
}

double length_attribute(const pugi::xml_node& node, const char* name, double whole) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (!attribute) return 0;
  try {
    return length_of(attribute.value(), whole);
  } catch (const BadValue& bad) {
    throw BadValue(fmt::format("{}=\"{:.40}\": {}", name, attribute.value(), bad.what()));
  }
}

std::optional<Outline> shape(const pugi::xml_node& node, std::string_view name, const Viewport& viewport) {
  const Lengths of(node, viewport);
  if (name == "path") return path_data(node.attribute("d").value());
  if (name == "line") return line(of);
  if (name == "polyline" || name == "polygon") return polyline(node, name == "polygon");
  if (name == "rect") return rect(of);
  if (name == "circle") return ellipse({of.x("cx"), of.y("cy")}, of.radius("r"), of.radius("r"));
  if (name == "ellipse") {
    const double rx = of.has("rx") ? of.width("rx") : of.height("ry");
    return ellipse({of.x("cx"), of.y("cy")}, rx, of.has("ry") ? of.height("ry") : rx);
  }
  return std::nullopt;
}

}  // namespace mrroc::drawing::svg
