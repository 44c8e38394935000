// Two platforms side by side behind a box: where they stand, as seen from the box.
#pragma once
#include <array>
#include <cstddef>

#include "base/planar.hpp"

namespace mrroc::box_push {

/// Platforms of the task.
inline constexpr std::size_t kPlatforms = 2;

/// Side of the box against which the pair pushes: it drives forward along x of the box, or against it.
enum class Side : std::uint8_t { back, front };
inline constexpr std::array kSides{Side::back, Side::front};

/// Place in the pair.
enum class Place : std::uint8_t { left, right };
inline constexpr std::array kPlaces{Place::left, Place::right};

/// Sizes of box and platforms, and how these stand behind it.
struct Formation {
  double box_length{0.5}, box_width{1.5};             ///< along x and y of the box [m]
  double platform_length{0.8}, platform_width{0.66};  ///< outline, with B in its middle [m]
  double gap{0.10};                                   ///< between noses and box before a push [m]
  double retreat{0.35};                               ///< the same where platforms turn on the spot [m]
};

/// @return between the middles of both platforms [m]: as far apart as their noses are wholly, or nearly, before the box
[[nodiscard]] constexpr double apart(const Formation& f) {
  constexpr double kLeast = 0.06, kBeyond = 0.24;
  const double wide = f.box_width - f.platform_width + kBeyond;
  const double least = f.platform_width + kLeast;
  return wide > least ? wide : least;
}

/// @param gap  between noses and box [m]
/// @return the pair, that is the middle between both platforms with their heading, in the frame of the box
[[nodiscard]] inline PlanarPose pair_at(const Formation& f, Side side, double gap) {
  const double behind = f.box_length / 2 + f.platform_length / 2 + gap;
  if (side == Side::back) return {-behind, 0, 0};
  return {behind, 0, wrap_angle(std::acos(-1.0))};
}

/// @return a platform in the frame of the pair
[[nodiscard]] constexpr PlanarPose member_at(const Formation& f, Place place) {
  return {0, (place == Place::left ? 0.5 : -0.5) * apart(f), 0};
}

}  // namespace mrroc::box_push
