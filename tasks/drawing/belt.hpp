// Following a belt that runs by itself, by its measured position.
#pragma once
#include <array>

namespace mrroc::drawing {

/// Usual Parameters::belt_lag.
inline constexpr double kBeltLag = 0.1;

/// What the coordinator knows of the belt. Positions are along y of E, in which the arms are commanded.
struct BeltTrack {
  std::array<double, 3> seen{};  ///< in the last macrosteps, newest first [m]
  double start{};                ///< where the arms began to follow [m]
  double followed{};             ///< way for which the arms have got orders since [m]
  bool follows{};                ///< they have begun

  friend bool operator==(const BeltTrack&, const BeltTrack&) = default;
};

/// Takes note of the belt's position in a macrostep.
[[nodiscard]] BeltTrack seen_at(BeltTrack track, double position);

/// From the reading that a report tells to the end of the macrostep which executes the order made on it, in macrosteps:
/// the delays of base/latency.hpp, and the end of a macrostep is one step after step n_Q of its reading.
/// @param n_s  steps of a macrostep
[[nodiscard]] double horizon(int n_s);

/// @return where the belt will be: the parabola through the three positions seen, which is exact while it accelerates
///         evenly
/// @param ahead  behind the newest one [macrosteps]
[[nodiscard]] double foreseen(const BeltTrack& track, double ahead);

/// Lets the arms follow for one macrostep: they are ordered to where the belt will be, whatever they were ordered before, so
/// that no error adds up.
/// @param ahead  as in foreseen()
[[nodiscard]] BeltTrack follow(BeltTrack track, double ahead);

}  // namespace mrroc::drawing
