// The typed links of a platform's agent: plans from the coordinator, positions from the map agent, estimates to it (paper
// REX: T_x_c1,2, T_x_c1,3, T_y_c1,3); and what a motion capture system and the simulation tell.
#pragma once
#include <array>
#include <cstdint>

#include "base/platform_command.hpp"

namespace mrroc {

/// Most points of one plan.
inline constexpr std::size_t kPlanPoints = 64;

/// Most points of the next plan that a plan knows.
inline constexpr std::size_t kPlanAhead = 2;

/// A plan: points of the map that the platform is to pass in this order, T_x_c1,2[desired_plan]. Trivially copyable.
struct Plan {
  std::int64_t number{};  ///< 1, 2, 3...; 0: there is none yet
  std::int32_t n{};       ///< points, 0..kPlanPoints; with those ahead not more
  std::array<std::array<double, 2>, kPlanPoints> point{};  ///< x, y on M [m]
  double speed{};                                          ///< wanted between them [m/s], > 0
  /// Points behind the n that the next plan begins with, 0..kPlanAhead: the last point of this one is passed on the way
  /// to them. 0: the platform rests there.
  std::int32_t ahead{};
};

/// A fragment that a coordinator plans, for the agent that hands it over to its effector driver. Trivially copyable.
struct FragmentOrder {
  Fragment fragment;  ///< number 0: there is none yet
};

/// What the map agent says, T_x_c1,3[x^, y^, phi^]. Trivially copyable.
struct MapReport {
  MapPose pose;             ///< the last plausible one
  std::int32_t rejected{};  ///< implausible ones, so far
};

/// Reading of a motion capture system for one platform, or one box. Trivially copyable.
struct MotionCapture {
  std::int64_t step{};  ///< at which it was measured
  bool seen{};          ///< the platform was; else p means nothing
  PlanarPose p;         ///< of B, or of the middle of a box, on M; phi wrapped
};

/// The true state of a simulated box that platforms push: for figures and viewers, never for control. Trivially copyable.
struct BoxTruth {
  PlanarPose p;                   ///< of its middle on M, phi wrapped
  std::array<double, 3> speed{};  ///< along x and y of M [m/s], about z [rad/s]
  std::array<double, 3> push{};   ///< of all that touches it, along x and y of M [N], about its middle [N m]
};

/// The true state of a simulated platform: for figures and viewers, never for control. Trivially copyable.
struct PlatformTruth {
  PlanarPose p;            ///< of B on M, phi wrapped
  PlanarVelocity v;        ///< of B, along B
  PerWheel wheel_speed{};  ///< [rad/s]
  std::array<std::array<double, 2>, kWheels>
      slip_speed{};  ///< of the contact over the ground, along and across [m/s]
  std::array<std::array<double, 2>, kWheels> friction{};  ///< mu_x, mu_y of the ground below the wheel
  PerWheel load{};                                        ///< vertical force on the wheel [N]
  PerWheel torque{};                                      ///< at the wheel [N m]
};

}  // namespace mrroc
