// The operator leads a tool that moves only on a virtual fixture: freely along it, stiffly across it.
#pragma once
#include <array>
#include <memory>

#include "base/agent_images.hpp"
#include "base/motion.hpp"
#include "ecp/generators/rows.hpp"
#include "tasks/guide/law.hpp"

namespace mrroc::guide {

/// Steps of a macrostep; n_Q is one less. Short: a fixture is as stiff as it is quick.
inline constexpr ecp::Pacing kPacing{.n_s = 4, .n_Q = 3};

/// What is constant during a run.
struct Setup {
  Fixture fixture{Pose{}, {0.1, 0.1}};  ///< in the base of the arm
  Law law;                              ///< how it holds
  Pose T_WE;                            ///< the tool before it is turned
  double capture{0.005};                ///< so near the fixture takes hold of the tool [m]
  double entry{1};                      ///< time in which its stiffness grows [s]
  double leave{1};                      ///< time in which it goes [s]
  double entry_speed{0.03};             ///< while it grows or goes it moves the tool no faster [m/s]
};

/// c_c: what the arm remembers.
struct Memory {
  std::shared_ptr<const Setup> k = std::make_shared<const Setup>();  ///< not null
  Matrix3 R_0W = Matrix3::Identity();  ///< orientation of the wrist, which stays
  double s{};                          ///< place on the curve [m]
  double way{};                        ///< along it in the last macrosteps, mean per macrostep [m]
};

/// The only one of the task.
struct Arm : ArmAgent<Memory> {};

/// Numbers of behaviours.
inline constexpr int kEnter = 2, kGuided = 3, kLeave = 4, kAway = 5;

/// The behaviours: freely to the fixture, entry, along it, leave, away from it.
extern const std::array<Motion<Arm>, 5> kGuide;

/// @param x  @return how the tool stood when the reply was made
[[nodiscard]] Standing standing(const Arm::X& x);

}  // namespace mrroc::guide
