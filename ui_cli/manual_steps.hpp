// Steps, speeds and coordinates that the page of manual operation offers.
#pragma once
#include <array>
#include <string>

namespace mrroc::ui {

/// Steps of motors [rad], of joints and rotations [rad], of the track and positions [m].
inline constexpr std::array<std::array<double, 7>, 3> kSteps{{{0.5, 1, 2, 5, 10, 20, 50},
                                                              {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5},
                                                              {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1}}};
/// Shares of the largest speed.
inline constexpr std::array<double, 5> kSpeeds{0.05, 0.15, 0.3, 0.5, 1};

/// @param pose  coordinates of a pose, otherwise of axes  @param axis  counted from 0
/// @return name of a coordinate
[[nodiscard]] inline std::string coordinate_name(bool pose, int axis) {
  constexpr std::array<const char*, 6> kPose{"x", "y", "z", "a1", "a2", "a3"};
  return pose ? kPose[static_cast<std::size_t>(axis)] : "axis " + std::to_string(axis + 1);
}

}  // namespace mrroc::ui
