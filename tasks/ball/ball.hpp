// Two arms carry an object between their palms around a circle.
#pragma once
#include <array>
#include <cstdint>

#include "base/agent_images.hpp"
#include "base/free_body.hpp"
#include "base/motion.hpp"
#include "base/pose.hpp"
#include "ecp/generators/trajectory.hpp"

namespace mrroc::ball {

/// Number of arms: 0 stands on the pedestal and keeps its place along the line between the palms, 1 on the track and
/// presses.
inline constexpr std::size_t kArms = 2;

/// Steps of a macrostep; n_Q is one less.
inline constexpr ecp::Pacing kPacing{.n_s = 10, .n_Q = 9};

/// What is constant during a run.
struct Parameters {
  double force{12.5};           ///< F_d, with which the palms press on the object [N]
  double radius{0.1};           ///< of the circle, which is upright and across the line between the palms [m]
  int turn{800};                ///< macrosteps of one turn at full speed
  double lift{0.05};            ///< so high above the pedestal the circle begins [m]
  double gap{0.04};             ///< between each palm and the object at the beginning [m]
  double touch{1.5};            ///< force at which the approach settles [N]
  double most_force{25};        ///< that the object bears [N]
  double least_force{4};        ///< below it nothing is held [N]
  double margin{1.3};           ///< friction must bear so many times the weight
  double size_tolerance{0.15};  ///< share by which the object may be of another size
  FreeBodyDescription body;     ///< as it is told
  std::array<Pose, kArms> T_UB;  ///< where the bases of the arms are believed to be
};

/// What went wrong, and is remembered until the task ends.
enum class Failure : std::uint8_t { none, no_contact, not_as_told, too_heavy, stayed, lost, crushed };

/// c_c0, the memory of the coordinator, MG (4). Vectors are in the world.
struct Memory {
  Parameters k;
  double age{};                       ///< task time since the behaviour began [macrosteps]
  std::array<Vector3, kArms> grip{};  ///< where the palms were when the behaviour began
  Vector3 shift{Vector3::Zero()};  ///< of the second palm against the first, across, that shares the load [m]
  Vector3 yielded{Vector3::Zero()};   ///< how far both arms have yielded, across [m]
  double closed{};                    ///< distance of the palms when nobody pushes [m]
  double load{};                      ///< weight that the palms bear together [N]
  std::array<int, kArms> touching{};  ///< macrosteps in succession in which each palm has touched
  int steady{};                       ///< macrosteps in succession in which what is waited for has been so
  int lost{};                         ///< ... in which too little force has been felt
  Failure failure{Failure::none};     ///< the first one
};

/// The coordinator a_0.
struct Coordinator : CoordinatorAgent<Memory, kArms> {};

/// Numbers of behaviours.
inline constexpr int kApproach = 1, kSqueeze = 2, kLift = 3, kWeigh = 4, kCircle = 5, kLower = 6,
                     kRelease = 7;

/// m = 0: until both arms are ready and the operator has given start.
extern const Motion<Coordinator> kWaitForStart;
/// m = 1 .. 7, in the order in which they are executed.
extern const std::array<Motion<Coordinator>, 7> kBehaviours;

/// Executes the task. An object that is not as it is told or too heavy is put down and released first.
/// @param port  a Port of the coordinator
/// @return terminated; faulted with x.c.failure; otherwise why the port gave up
template <class P>
Outcome run_program(Coordinator::X& x, P& port) {
  const auto behaviour = [&](int m) { return move(kBehaviours[static_cast<std::size_t>(m - 1)], x, port); };
  const auto may_go_on = [&] { return x.c.failure == Failure::none; };
  Outcome o = move(kWaitForStart, x, port);
  int m = kApproach;
  while (o == Outcome::terminated && m <= kRelease) {
    o = behaviour(m);
    if (o != Outcome::terminated) return o;
    const Failure f = x.c.failure;
    if (f == Failure::lost || f == Failure::crushed || f == Failure::no_contact) return Outcome::faulted;
    if (m == kSqueeze && !may_go_on())
      m = kRelease;
    else if (m == kWeigh && !may_go_on())
      m = kLower;
    else
      ++m;
  }
  return may_go_on() ? o : Outcome::faulted;
}

}  // namespace mrroc::ball
