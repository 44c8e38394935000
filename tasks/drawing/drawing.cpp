#include "tasks/drawing/drawing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tasks/drawing/strokes.hpp"

namespace mrroc::drawing {
namespace {

constexpr double kSamePlace = 1e-6;     // [mm] closer points are one; far below what an arm can resolve
constexpr double kRoundingRoom = 1e-6;  // [mm] a drawing that fills the sheet is not refused for its last bit

}  // namespace

Drawing arrow() {
  constexpr double kReach = 28;    // of a feather, to the side and down [mm]
  constexpr double kSpacing = 20;  // of the feathers along the shaft [mm]
  Drawing feathers;
  for (const double side : {-1.0, 1.0})
    for (const double row : {-1.0, 0.0, 1.0}) {
      const double root = kReach / 2 + row * kSpacing;
      feathers.push_back({Point(0, root), Point(side * kReach, root - kReach)});
    }
  return feathers;
}

Drawing fitted(Drawing drawing, double size_mm) {
  const Box box = bounds(drawing);
  if (box.isEmpty()) return drawing;
  const Point centre = box.center();
  const double extent = box.sizes().maxCoeff();
  const double scale = extent > 0 ? size_mm / extent : 1;
  for (Stroke& stroke : drawing)
    for (Point& p : stroke) p = (p - centre) * scale;
  return drawing;
}

Drawing without_repeats(Drawing drawing) {
  const auto same = [](const Point& a, const Point& b) { return (a - b).norm() < kSamePlace; };
  for (Stroke& stroke : drawing) stroke.erase(std::unique(stroke.begin(), stroke.end(), same), stroke.end());
  return drawing;
}

void check_size(double size_mm, const std::string& name) {
  if (size_mm > 0 && size_mm <= kSheetSize) return;
  throw FileError(name, 0, fmt::format("a drawing cannot be {} mm large", size_mm),
                  fmt::format("give a size above 0 and up to {} mm, the side of the sheet", kSheetSize));
}

void check(const Drawing& drawing, const std::string& name, std::size_t max_points) {
  if (drawing.empty()) throw FileError(name, 0, "there is nothing to draw in it", "give at least one stroke");
  std::size_t points = 0;
  for (std::size_t k = 0; k < drawing.size(); ++k) {
    if (drawing[k].empty())
      throw FileError(name, 0, fmt::format("stroke {} has no points", k), "give it one or leave it out");
    points += drawing[k].size();
    for (const Point& p : drawing[k]) {
      if (!p.allFinite())
        throw FileError(name, 0, fmt::format("stroke {} has a coordinate that is not a finite number", k),
                        "mend the coordinate");
      if (p.cwiseAbs().maxCoeff() > kSheetSize / 2 + kRoundingRoom)
        throw FileError(
            name, 0,
            fmt::format("stroke {} goes to ({:.1f}, {:.1f}) mm, off the reachable sheet of {} x {} mm", k,
                        p.x(), p.y(), kSheetSize, kSheetSize),
            "make the drawing smaller or move it to the sheet's centre");
    }
  }
  if (points > max_points)
    throw FileError(name, 0,
                    fmt::format("{} points after flattening, over the limit of {}", points, max_points),
                    "simplify the drawing or draw it smaller");
}

}  // namespace mrroc::drawing
