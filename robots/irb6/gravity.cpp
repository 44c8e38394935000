#include "robots/irb6/gravity.hpp"

#include <cmath>

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

AxisVector Gravity::torques(const AxisVector& joints, const Transmission& transmission) const noexcept {
  AxisVector torque = AxisVector::Zero(count_);
  const int k = first_;
  const double theta2 = joints[k + 1];
  const double beyond = theta2 + joints[k + 2];  // theta3 = beyond + pi/2
  const double c2 = std::cos(theta2), s2 = std::sin(theta2);
  const double c3 = -std::sin(beyond), s3 = std::cos(beyond);
  const double s4 = std::cos(beyond + joints[k + 3]), c4 = -std::sin(beyond + joints[k + 3]);
  const double s5 = std::sin(joints[k + 4]), c5 = std::cos(joints[k + 4]);
  const double roll = g5_ * c4 * c5 / gear_V_;  // of V, which turns along with T
  torque[k + 1] = -g2_ * c2 / transmission.lower_arm_gear(c2, s2);
  torque[k + 2] = -g3_ * c3 / transmission.upper_arm_gear(c3, s3);
  torque[k + 3] = (-g4_ * c4 - g5_ * s4 * s5) / gear_T_ - roll;
  torque[k + 4] = roll;
  return torque;
}

}  // namespace mrroc::irb6
