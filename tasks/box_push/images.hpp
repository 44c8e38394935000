// Images of the agents of the platforms, and what the coordinator and they say to each other.
#pragma once
#include <cstdint>

#include "base/agent_images.hpp"
#include "base/platform_transmission.hpp"

namespace mrroc::box_push {

/// Order::variant of the coordinator while everything is to stand: the operator has a pause, or a platform does not know
/// where it is.
inline constexpr int kPaused = 1;

/// Constant parameters of an agent.
struct PusherParameters {
  double lost{0.2};  ///< standard deviation of the position above which it says that it does not know it [m]
};

/// c_cj
struct PusherMemory {
  PusherParameters k;     ///< constant during a run
  std::int64_t handed{};  ///< number of the fragment handed over last; 0: none
  bool lost{};            ///< the platform does not know well enough where it is
};

/// x_cT of a platform's agent: the coordinator's order and fragment, the map's pose.
struct PusherHeard : Order {
  FragmentOrder go;  ///< the fragment to be handed over next
  MapReport map;     ///< where the platform is
  using Order::operator=;
};
/// y_cT of a platform's agent. Report::event is the number of the last fragment that has reached its notify.
struct PusherSaid : Report {
  PlatformEstimate estimate;  ///< for the map agent
  using Report::operator=;
};

/// Report::sensor of a platform's agent: a sum of these, and of kIterationUnit times the iterations to the end of what has been
/// handed over.
inline constexpr int kStands = 1;        ///< at rest at the end of what it was handed
inline constexpr int kPositionLost = 2;  ///< it does not know its position well enough
/// Report::sensor counts iterations in this unit.
inline constexpr int kIterationUnit = 4;

/// Images of a platform's agent.
struct Pusher {
  /// x: memory c, reply of the effector driver e, what is heard T.
  struct X {
    PusherMemory c{};
    PlatformReply e;
    None V;
    PusherHeard T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e, report and estimate T.
  struct Y {
    PusherMemory c{};
    PlatformCommand e;
    None V;
    PusherSaid T;
  };
};

}  // namespace mrroc::box_push
