#include "robots/irb6/gravity.hpp"

namespace mrroc::irb6 {
namespace {

constexpr double kG = 9.81;  // [m/s^2], as the simulation has it

double moment(const LinkMass& link) { return link.mass * link.centre; }

}  // namespace

Gravity::Gravity(const ArmParameters& arm) noexcept : first_(arm.first()), count_(arm.axis_count()) {
  const auto T = static_cast<std::size_t>(first_) + 3;
  gear_T_ = arm.axes[T].drive.gear;
  gear_V_ = arm.axes[T + 1].drive.gear;
  const LinkMasses m{};
  const Lengths& l = arm.lengths;
  const double hand = m.wrist_body.mass + m.wrist.mass + arm.tool_weight / kG;
  const double forearm = m.wrist_fork.mass + hand;
  g2_ = kG * (moment(m.lower_arm) + l.a2 * (m.upper_arm.mass + forearm));
  g3_ = kG * (moment(m.upper_arm) + l.a3 * forearm);
  g4_ = kG * (moment(m.wrist_fork) + l.d5 * hand);
  g5_ = kG * (moment(m.wrist_body) + moment(m.wrist)) + arm.tool_weight * arm.tool_mass_centre[2];
}

AxisVector Gravity::torques(const AxisVector& motors, const Transmission& transmission) const noexcept {
  AxisVector torque = AxisVector::Zero(count_);
  const int k = first_;
  const Pitches links = transmission.pitches(motors);
  const auto [c4, s4] = links.theta4;
  const auto [c5, s5] = links.q5;
  const double roll = g5_ * c4 * c5 / gear_V_;  // of V, which turns along with T
  torque[k + 1] = -g2_ * links.theta2.c / transmission.lower_arm_gear(links.theta2);
  torque[k + 2] = -g3_ * links.theta3.c / transmission.upper_arm_gear(links.theta3);
  torque[k + 3] = (-g4_ * c4 - g5_ * s4 * s5) / gear_T_ - roll;
  torque[k + 4] = roll;
  return torque;
}

}  // namespace mrroc::irb6
