#include "robots/irb6/arm.hpp"

namespace mrroc::irb6 {

Arm::Arm(const ArmParameters& parameters)
    : parameters_(parameters),
      transmission_(parameters),
      kinematics_(parameters),
      T_WS_(pose_from_angle_axis(AngleAxisPose(parameters.sensor_in_wrist.data()))),
      T_WE_(pose_from_angle_axis(AngleAxisPose(parameters.tool_in_wrist.data()))) {}

AxisVector Arm::front() const noexcept {
  return Eigen::Map<const AxisVector>(parameters_.front.data(), axes());
}

AxisVector Arm::synchronised() const noexcept { return joints_from_motors(AxisVector::Zero(axes())); }

std::unique_ptr<Arm> make_arm(std::string_view name, ParameterSet set) {
  const bool calibrated = set == ParameterSet::calibrated;
  if (name == kPostument.name) return std::make_unique<Arm>(calibrated ? kPostumentCalibrated : kPostument);
  if (name == kTrack.name) return std::make_unique<Arm>(calibrated ? kTrackCalibrated : kTrack);
  return nullptr;
}

}  // namespace mrroc::irb6
