// Ink: the points that a pen left on the paper, with their times.
#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "tasks/drawing/drawing.hpp"

namespace mrroc::drawing {

/// A place where the pen touched the paper.
struct InkPoint {
  int stroke{};  ///< counted from 0 in the order of drawing
  double t{};    ///< simulated time [s]
  double x{};    ///< sheet coordinates [mm]
  double y{};    ///< sheet coordinates [mm]

  friend bool operator==(const InkPoint&, const InkPoint&) = default;
};

/// Points in the order of time; each continues the line of the one before, if that is of the same stroke.
using Ink = std::vector<InkPoint>;

/// The highest stroke number that a file may name.
inline constexpr std::size_t kMaxStrokes = kMaxPoints;

/// @return the polylines of the ink. A stroke number that does not occur gives an empty stroke.
[[nodiscard]] Drawing strokes_of(const Ink& ink);

/// A pen that hops in a hand that trembles leaves a dashed stroke: one that begins within kHopTime after the end of the
/// one before belongs to it. Nobody lifts a pen, moves it and lowers it again in that time.
/// @return the same points, their strokes numbered anew
[[nodiscard]] Ink without_hops(Ink ink);
inline constexpr double kHopTime = 0.5;  ///< [s]

/// @return a drawing as ink at time 0, as input.csv holds it
[[nodiscard]] Ink ink_of(const Drawing& drawing);

/// Writes `stroke,t,x,y`, a row per point: t to 0.1 ms, x and y to 0.1 um.
/// @throws FaultError cannot_write; internal_error when a number is not finite
void write_ink(const std::filesystem::path& file, const Ink& ink);

/// Reads what write_ink writes. Strokes must not go back and t must not within a stroke.
/// @throws FileError  naming file and line
[[nodiscard]] Ink read_ink(const std::filesystem::path& file);

/// Appends the ink point of one row of a file: stroke, t, x, y.
/// @param lines  the file, for errors
/// @throws FileError  naming file and line: a bad field, a stroke that goes back, time that goes back in
/// it
void append_ink_row(Ink& ink, const Lines& lines, std::string_view row, char separator);

}  // namespace mrroc::drawing
