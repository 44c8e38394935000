// A drawing: strokes on a sheet of paper.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/text_file.hpp"

namespace mrroc::drawing {

/// A point in sheet coordinates [mm]: origin at the sheet's centre, x right, y up, seen from above.
using Point = Eigen::Vector2d;
/// The line between a touch-down and the next lift-off of the pen: a polyline [mm]. One point alone is a dot.
using Stroke = std::vector<Point>;
/// Strokes in the order in which they are drawn.
using Drawing = std::vector<Stroke>;

inline constexpr double kDefaultSize = 120;        ///< larger side of a drawing's bounding box [mm]
inline constexpr double kSheetSize = 200;          ///< side of the sheet, all of which an arm reaches [mm]
inline constexpr double kFlatness = 0.05;          ///< a curve's distance from its polyline, at most [mm]
inline constexpr std::size_t kMaxPoints = 10'000;  ///< points of a drawing after flattening, at most

/// The drawing of MS fig. 7: six feathers of an arrow, three on each side of a shaft that is not drawn. Each
/// is a straight stroke of 39.6 mm; together they take 56 x 68 mm, centred on the sheet.
[[nodiscard]] Drawing arrow();

/// @param size_mm  larger side of the new bounding box [mm]
/// @return the drawing scaled uniformly to that size and centred on the sheet. A drawing without extent (dots
/// at one place) is only centred.
[[nodiscard]] Drawing fitted(Drawing drawing, double size_mm);

/// @return the drawing without points that repeat their predecessor. Strokes never become empty.
[[nodiscard]] Drawing without_repeats(Drawing drawing);

/// Refuses a size that is not in (0, kSheetSize].
/// @param name  the file that the size is for, named in the error
/// @throws FileError
void check_size(double size_mm, const std::string& name);

/// Refuses a drawing that cannot be drawn: no stroke, an empty stroke, a number that is not finite, more than
/// max_points points, a point off the sheet.
/// @param name        the file that it came from, named in the error
/// @param max_points  recorded ink has a point per step, and may have any number
/// @throws FileError
void check(const Drawing& drawing, const std::string& name, std::size_t max_points = kMaxPoints);

}  // namespace mrroc::drawing
