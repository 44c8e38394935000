// Images of agents, MG (4), (5), in the form that all tasks share.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <type_traits>
#include <vector>

#include "base/effector_command.hpp"
#include "base/operator.hpp"
#include "base/pose.hpp"
#include "base/task_clock.hpp"
#include "base/transmission.hpp"

namespace mrroc {

/// A part of an image that an agent does not have.
struct None {};

/// Images of an embodied agent a_j whose memory is C. That of a task is `struct Arm : ArmAgent<Memory> {}`, one that sets
/// its virtual sensor `struct Arm : ArmAgent<Memory, SensorSetting> {}`.
/// @tparam S  y_cV
/// @tparam Heard, Said  x_cT and y_cT: an Order and a Report, or what is made of them and has the task's own beside them
///                      (base/link/transmission_link.hpp)
template <class C, class S = None, class Heard = Order, class Said = Report>
struct ArmAgent {
  /// x: memory c, reply e of the effector, reading V of the virtual sensor, order T of the coordinator, macrostep i,
  /// and i_0 in which the behaviour began.
  struct X {
    C c{};
    EffectorReply e;
    SensorReading V;
    Heard T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e to the effector, setting V of the sensor, report T to the coordinator.
  struct Y {
    C c{};
    EffectorCommand e;
    S V;
    Said T;
  };
};

/// Images of the coordinator a_0, which has no effector. That of a task is
/// `struct Coordinator : CoordinatorAgent<Memory, N> {}`.
/// @tparam C  memory c_c0  @tparam N  number of arms, std::dynamic_extent: as many as the run has
/// @tparam Seen, Asked  x_cV0 and y_cV0: what its virtual sensors see, and what it asks of them
/// @tparam Heard, Said  x_cT_0j and y_cT_0j of one arm, as Said and Heard of ArmAgent
template <class C, std::size_t N, class Seen = None, class Asked = None, class Heard = Report,
          class Said = Order>
struct CoordinatorAgent {
  /// One of each arm, by its number.
  template <class T>
  using OfEachArm = std::conditional_t<N == std::dynamic_extent, std::vector<T>, std::array<T, N>>;
  using Memory = C;  ///< c_c0
  /// x_cT0: what the agents and the operator say.
  struct Transmission {
    OfEachArm<Heard> agent;  ///< x_cT_0j
    OperatorImage h;         ///< x_cT_0h
  };
  /// x: memory c, what is seen V, what is told T, task time t, macrostep i, and i_0 in which the behaviour began; no
  /// effector e.
  struct X {
    C c{};
    None e;
    Seen V;
    Transmission T;
    TaskTime t;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, what is asked V, and the orders T.
  struct Y {
    C c{};
    None e;
    Asked V;
    OfEachArm<Said> T;  ///< y_cT_0j
  };
};

/// @param told  a reply, a report or a sample: whatever has a T_0E of six numbers
/// @return the pose 0_E T that it tells
template <class Told>
requires requires(const Told& told) { std::data(told.T_0E); }
[[nodiscard]] Pose pose_of(const Told& told) {
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(std::data(told.T_0E)));
}

}  // namespace mrroc
