// The coordinator of two platforms that push a box: looks where the box is, chooses pushes, brings the platforms behind the
// box one after the other, and steers both while they push.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/agent_images.hpp"
#include "base/motion.hpp"
#include "base/platform_transmission.hpp"
#include "tasks/box_push/approach.hpp"
#include "tasks/box_push/images.hpp"
#include "tasks/box_push/push_run.hpp"

namespace mrroc::box_push {

/// Agents that the coordinator speaks with: those of both platforms, then their map agents.
inline constexpr std::size_t kAgents = 2 * kPlatforms;

/// How near to its goal the box is to be, as it is measured: within 30 mm and 5 degrees, less what a look may be wrong by,
/// three standard deviations of the mean of its readings (kReadings).
struct Tolerance {
  double position{0.025};  ///< [m]
  double heading{0.077};   ///< [rad]
};

/// Readings of the box at rest that make one look.
inline constexpr std::size_t kReadings = 10;

/// Constant parameters of the coordinator.
struct CoordinatorParameters {
  Hall hall{};                 ///< where the box is pushed
  DriveLimits drive{};         ///< of platforms by themselves
  PushSpeeds speeds{};         ///< of the pair
  PlanarPose goal{};           ///< of the box on M
  Tolerance tolerance{};       ///< of the goal
  double short_by{0.006};      ///< a push goes on when the box rests farther before its target [m]
  int pushes{12};              ///< at most
  std::int64_t timeout{1500};  ///< for a platform that does not know its position [macrosteps]; 0: for ever
  int n_s{10};                 ///< steps of a macrostep
};

/// Why there is no next push.
enum class DeadEnd : std::uint8_t {
  none,         ///< there is one
  for_box,      ///< no pushes lead to the goal
  for_platform  ///< a platform cannot come behind the box
};

/// What the coordinator expects of the rest of the task.
struct Outlook {
  int pushes{};      ///< to the goal, the next one among them
  double seconds{};  ///< about how long they take [s]
};

/// What a platform has been told to do.
struct Track {
  std::vector<Fragment> waiting{};  ///< to be sent, the next one first
  Fragment sent{};                  ///< sent last; number 0: none yet
  PlanarPose end{};                 ///< where the platform is when all of that is done
};

/// c_c0
struct CoordinatorMemory {
  CoordinatorParameters k{};              ///< constant during a run
  std::array<Track, kPlatforms> track{};  ///< of the platforms
  std::int64_t looked_at{-1};             ///< step of the newest reading of the box
  std::vector<PlanarPose> look;           ///< readings of the box since everything stands
  PlanarPose box{};                       ///< where it was found last
  Approach approach{};                    ///< of the push that is next or under way
  DeadEnd dead_end{};                     ///< why there is no next push
  Outlook outlook{};                      ///< when the next push was chosen
  PushRun run{};                          ///< the push
  std::int64_t rests_from{};  ///< macrostep since which the push is at its end, and at rest; 0: it is not
  int pushes{};               ///< begun so far
  std::int64_t lost_in{};     ///< macrostep from which on a platform has not known its position; 0: all do
};

/// x_cV of the coordinator: the newest reading of the box that is visible; step -1: there is none yet.
struct BoxSeen {
  MotionCapture box{.step = -1, .seen = false, .p = {}};
};

/// Order with the fragment that goes to a platform's agent on a link of its own.
struct GoOrder : Order {
  FragmentOrder go;
};

/// Images of the coordinator.
struct Coordinator : CoordinatorAgent<CoordinatorMemory, kAgents, BoxSeen, None, Report, GoOrder> {};

/// Behaviours. m of an order is that of its behaviour; Order::variant is kPaused while everything is to stand.
extern const Motion<Coordinator>
    kStart;  ///< m = 0: until all agents are ready and the operator has given start
extern const Motion<Coordinator>
    kLook;  ///< m = 1: until the box has been seen some times, with everything at rest
extern const Motion<Coordinator>
    kApproach;                           ///< m = 2: chooses a push; until both platforms stand behind the box
extern const Motion<Coordinator> kPush;  ///< m = 3: until the box has come as far as it is to come
extern const Motion<Coordinator> kRetreat;  ///< m = 4: until both platforms are away from the box

/// @return distance and turn of the box from its goal, when it was looked at last
[[nodiscard]] PlanarPose error_of(const CoordinatorMemory& c);
/// @return whether the box is at its goal, as it was seen
[[nodiscard]] bool at_goal(const CoordinatorMemory& c);
/// A platform has not known its position for too long.
[[nodiscard]] bool position_gone(const Coordinator::X& x);
/// @return whether the task can go on: there is a next push, the box goes with it, and the platforms know where they are
[[nodiscard]] bool goes_on(const Coordinator::X& x);

/// Pushes until the box is at its goal, it or a platform has no way, it does not move, or there have been enough pushes.
template <class Port>
Outcome push_box(Coordinator::X& x, Port& port) {
  Outcome o = move(kStart, x, port);
  const auto well = [&] { return o == Outcome::terminated && goes_on(x); };
  while (well()) {
    o = move(kLook, x, port);
    if (!well() || at_goal(x.c) || x.c.pushes >= x.c.k.pushes) break;
    for (const Motion<Coordinator>* const motion : {&kApproach, &kPush, &kRetreat})
      if (well()) o = move(*motion, x, port);
  }
  return o;
}

}  // namespace mrroc::box_push
