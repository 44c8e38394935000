// The forces of a virtual fixture, as rows of the task frame: CONTACT on every linear axis.
#pragma once
#include <limits>

#include "base/axis_command.hpp"
#include "tasks/guide/fixture.hpp"

namespace mrroc::guide {

/// How stiff a fixture is, and how freely a tool goes along it. I and B are those of law MG (28).
struct Law {
  double stiffness{20'000};     ///< across the fixture [N/m]
  double mobility{0.001};       ///< B across it and in its walls [s/kg]
  double inertia{2};            ///< I across it [kg]
  double free_mobility{0.035};  ///< B along it, and of a tool that is led without it [s/kg]
  double free_inertia{3};       ///< I of the same [kg]
  /// In bends of this radius the tool is as free along the fixture as elsewhere, in narrower ones less by the ratio of both:
  /// it would be through them before the task frame has turned. 0: nowhere [m]
  double bend{0.01};
  double wall_stiffness{5'000};  ///< of the walls at its ends [N/m]
  double wall_softness{
      0.002};             ///< depth in a wall from which on it is as stiff as that, and as little mobile [m]
  double most_force{60};  ///< a fixture and its walls push no harder, and so give way to who does [N]
};

/// K B of the stiffest part: how quickly a fixture takes a deviation back [1/s]. A measured pose becomes motion about
/// kReaction later, and the product of both has to stay well below 1.
[[nodiscard]] double return_rate(const Law& law);
/// Largest return_rate.
inline constexpr double kMostReturnRate = 30;

/// @param depth  in a wall [m]; negative: in the one on the other side
/// @return force of the wall [N], against the depth; it and its slope begin at 0
[[nodiscard]] double wall_force(const Law& law, double depth);

/// Energy that a tool has to bring to come so deep into a wall [J].
[[nodiscard]] double wall_energy(const Law& law, double depth);

/// @param share       of the fixture that holds, 0: the tool is free, 1: all of it
/// @param most_speed  with which it moves a tool that nobody holds [m/s]
/// @return rows of the task frame; the orientation stays
[[nodiscard]] TaskFrameCommand rows(const Law& law, const Fixture& fixture, const Standing& standing,
                                    double share,
                                    double most_speed = std::numeric_limits<double>::infinity());

/// @param u  0..1, clipped @return from 0 to 1 with slope 0 at both ends
[[nodiscard]] double smooth(double u);

}  // namespace mrroc::guide
