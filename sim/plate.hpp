// A plate on an arm's table, around whose edge a tool can be led.
#pragma once
#include <cstdint>

#include "base/pose.hpp"

namespace mrroc::sim {

/// Outline of the plate, seen from above.
enum class PlateShape : std::uint8_t { none, rectangle, ellipse };

/// A plate lies on the table; it is as stiff and as smooth as the paper of the arm (PaperParameters).
struct PlateParameters {
  PlateShape shape{PlateShape::none};  ///< none: there is no plate
  double length{0.08};                 ///< along x of the sheet: to the right, seen from behind the arm [m]
  double width{0.05};                  ///< along y of the sheet: away from the arm [m]
  double thickness{0.03};              ///< [m]
  double distance{0.06};               ///< of its middle from the sheet's centre, away from the arm [m]
};

}  // namespace mrroc::sim
