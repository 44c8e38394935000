// Force generators: rows of the task frame and pure rules for guided motion, approach and edge following.
#pragma once
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/axis_command.hpp"
#include "base/pose.hpp"

namespace mrroc::ecp {

// The usual inertias and mobilities of the papers' tables.
inline constexpr double kInertia = 20;           ///< I along an axis [kg]
inline constexpr double kMobility = 0.005;       ///< B along an axis [s/kg]
inline constexpr double kTurningInertia = 0.5;   ///< I about an axis [kg m^2]
inline constexpr double kTurningMobility = 0.1;  ///< B about an axis [s/(kg m^2)]

/// Guided motion ("nose run"): a person who pushes the tool leads it, along and about the axes given; the
/// others stay.
[[nodiscard]] constexpr TaskFrameCommand guided(std::initializer_list<Axis> axes) {
  TaskFrameCommand frame;
  for (const Axis a : axes)
    frame[a] = a < Axis::ax ? c(0, kInertia, kMobility) : c(0, kTurningInertia, kTurningMobility);
  return frame;
}
/// The same for all six axes.
[[nodiscard]] constexpr TaskFrameCommand guided() {
  return guided({Axis::x, Axis::y, Axis::z, Axis::ax, Axis::ay, Axis::az});
}

/// Approach until contact: GUARDED along one linear axis, the others stay. In contact the force settles at
/// `force`.
/// @param velocity  [m/s], not 0  @param force  [N], with the sign of the velocity  @param I  [kg]
[[nodiscard]] constexpr TaskFrameCommand approach(Axis axis, double velocity, double force, double I = 5) {
  TaskFrameCommand frame;
  frame[axis] = g(velocity, I, velocity / force);
  return frame;
}

/// Contact is a force of at least `share` of the one at which the approach settles, for longer than a bounce:
/// to be called once per macrostep.
/// @param macrosteps  in succession so far, of the memory c_c
/// @return the same now; contact is made when it is as large as the task wants
[[nodiscard]] constexpr int in_contact(int macrosteps, double force, double settled, double share = 0.9) {
  return force / settled >= share ? macrosteps + 1 : 0;
}

/// Edge following (the original's benchmark): the tool pushes along x of the task frame, goes along y, and
/// the frame is turned about z so that x points into the edge.
struct EdgeRule {
  double force{4};                ///< F_d along x [N], > 0
  double I{kInertia};             ///< [kg]
  double B{kMobility};            ///< [s/kg]
  double speed_per_force{0.002};  ///< v_y = speed_per_force |F| [m/s/N]; its sign is the sense of going round
  double turn_per_force{0.2};     ///< turns so much more outward per force too much [rad/N]
  double least_force{0.5};        ///< below this the direction of the force means nothing [N]
};

/// An edge of stiffness K that is met with v_d = B F is hit with B sqrt(K I) times F, its damping ratio being the half of the
/// inverse: a hard impact tells that the edge is too stiff for the rule, however the arm gives way.
/// @param peak  of the impact [N] @param settled  force at which the approach settles [N]
/// @return share of its speed with which the rule suits the edge as if the impact had been twice the settled force
[[nodiscard]] inline double share_after_impact(double peak, double settled) {
  constexpr double kSoftImpact = 2;
  const double hard = peak / (kSoftImpact * settled);
  return hard > 1 ? 1 / (hard * hard) : 1;
}

/// @return the rule with s times the speed everywhere, and the forces as they were; it turns less, too, as readings
///         are as late as before. I stays, so that the damping ratio on an edge of stiffness K, 1 / (2 B sqrt(K I)), grows by 1 / s
[[nodiscard]] constexpr EdgeRule slowed(EdgeRule rule, double s) {
  rule.B *= s;
  rule.speed_per_force *= s;
  rule.turn_per_force *= s;
  return rule;
}

/// A force counts up to so many times F_d: an impact on a stiff edge is no reason to turn away from it.
inline constexpr double kImpact = 1.5;

/// Decision of edge following in one macrostep.
struct EdgeStep {
  double angle{};          ///< of the task frame about z from now on [rad]
  TaskFrameCommand frame;  ///< rows
};

/// @param rule   parameters
/// @param angle  of the task frame about z when the force was measured [rad]
/// @param F_a    measured force in that frame
/// @param now    angle that is commanded now [rad]: kept when the force is too small to show the edge
[[nodiscard]] inline EdgeStep follow_edge(const EdgeRule& rule, double angle, const Wrench& F_a, double now) {
  const double force = std::hypot(F_a[Axis::x], F_a[Axis::y]);
  const double counted = std::min(force, kImpact * rule.force);
  EdgeStep step{now, {}};
  step.frame.x = c(rule.force, rule.I, rule.B);
  step.frame.y = u(rule.speed_per_force * counted);
  if (force < rule.least_force) return step;
  const double sense = rule.speed_per_force < 0 ? -1 : 1;
  step.angle =
      angle + std::atan2(F_a[Axis::y], F_a[Axis::x]) + sense * rule.turn_per_force * (counted - rule.force);
  return step;
}

}  // namespace mrroc::ecp
