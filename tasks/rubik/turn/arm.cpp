#include "tasks/rubik/turn/arm.hpp"

#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {
namespace {

constexpr std::size_t kAngle = 5;  // of pose: about z

}  // namespace

TurnOrder turn_of(const Order& order) {
  return {.torque = order.arm.frame.az.force,
          .mobility = order.arm.frame.az.mobility,
          .angle = order.arm.pose[kAngle]};
}

void put_turn(const TurnOrder& turn, Order& order) {
  order.arm.mu = Interpolation::tcim_velocity;
  order.arm.representation = Representation::xyz_angle_axis;
  order.arm.reference = Reference::relative;
  order.arm.frame = kTurn;
  order.arm.frame.az = c(turn.torque, kTurn.az.inertia, turn.mobility);
  order.arm.pose = {};
  order.arm.pose[kAngle] = turn.angle;
}

double jaw_step_of(const Order& order) { return order.arm.gripper > 0 ? order.arm.gripper : kJawStep; }

}  // namespace mrroc::rubik
