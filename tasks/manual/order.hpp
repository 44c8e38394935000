// The operator's orders to one arm.
#pragma once
#include <cstdint>

#include "base/effector_command.hpp"
#include "mrroc/manual_order_t.hpp"

namespace mrroc::manual {

/// Kinds of orders.
enum class Kind : std::uint8_t {
  nothing,
  home,             ///< SYNCHRO, then the tool of the configuration and a new force bias
  move,             ///< a motion with a trapezoidal velocity
  tool,             ///< T_WE
  force_tool,       ///< weight and mass centre beyond the sensor
  kinematic_model,  ///< parameter set of the kinematics
  servo_algorithm,  ///< algorithm and parameter set of all motors
  gripper,          ///< distance of the jaws
  bias,             ///< the force is zero from now on
  reset,            ///< acknowledges a fault
  stop,             ///< ends whatever the arm does; it comes to rest and holds
};

/// y_cT_0j of the task. Trivially copyable.
struct ManualOrder {
  std::int64_t number{};                         ///< 1, 2, 3... for each arm; 0: none yet
  Kind kind{Kind::nothing};                      ///< decides which of the fields below count
  Representation space{Representation::joints};  ///< move: motors, joints, xyz_euler_zyz or xyz_angle_axis
  /// move: relative to where the arm is; poses in space relative to E (MG tab. 1)
  Reference reference{Reference::absolute};
  /// move: coordinates; tool: angle-axis pose; force_tool: weight [N], mass centre [m]; gripper: distance [m]
  PoseNumbers value{};
  double velocity{0.15};         ///< move: share of the largest speed, above 0 up to 1
  double acceleration{0.02};     ///< move: share of the largest acceleration, above 0 up to 1
  std::uint16_t model{};         ///< kinematic_model
  std::uint8_t algorithm{};      ///< servo_algorithm
  std::uint8_t parameter_set{};  ///< servo_algorithm
};

/// The order as a message; meaning and units stay. The header is left to the channel.
[[nodiscard]] manual_order_t to_message(const ManualOrder& order);

}  // namespace mrroc::manual

namespace mrroc {

/// The message as an order. @param m  a proper one
[[nodiscard]] manual::ManualOrder from_message(const manual_order_t& m);
/// @return whether the kind is one that there is, and all numbers are finite. Real-time safe
[[nodiscard]] bool is_proper(const manual_order_t& m) noexcept;

}  // namespace mrroc
