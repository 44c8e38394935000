#include "robots/irb6/arm.hpp"

#include <vector>

namespace mrroc::irb6 {

Arm::Arm(const ArmParameters& parameters)
    : parameters_(parameters),
      transmission_(parameters),
      kinematics_(parameters),
      gravity_(parameters),
      T_WS_(pose_from_angle_axis(AngleAxisPose(parameters.sensor_in_wrist.data()))),
      T_WE_(pose_from_angle_axis(AngleAxisPose(parameters.tool_in_wrist.data()))) {}

const edp::Robot* Arm::with_model(int number) const noexcept {
  if (number < 0 || number >= models()) return nullptr;
  return family_.empty() ? this : &family_[static_cast<std::size_t>(number)];
}

AxisVector Arm::front() const noexcept {
  return Eigen::Map<const AxisVector>(parameters_.front.data(), axes());
}

AxisVector Arm::synchronised() const noexcept { return joints_from_motors(AxisVector::Zero(axes())); }

/// All models of one robot, by their numbers.
class Family {
 public:
  Family(const ArmParameters& nominal, const ArmParameters& calibrated) {
    const std::size_t rules = nominal.on_track ? 3 : 1;
    for (std::size_t k = 0; k < 2 * rules; ++k) {
      ArmParameters table = k % 2 == 0 ? nominal : calibrated;
      table.track_rule = static_cast<TrackRule>(k / 2);
      arms_.emplace_back(table).model_ = static_cast<int>(k);
    }
    for (Arm& arm : arms_) arm.family_ = arms_;
  }
  Family(const Family&) = delete;
  Family& operator=(const Family&) = delete;
  [[nodiscard]] std::unique_ptr<Arm> copy(int model) const {
    if (model < 0 || model >= static_cast<int>(arms_.size())) return nullptr;
    return std::make_unique<Arm>(arms_[static_cast<std::size_t>(model)]);
  }

 private:
  std::vector<Arm> arms_;
};

std::unique_ptr<Arm> make_arm(std::string_view name, int model) {
  static const Family postuments{kPostument, kPostumentCalibrated};
  static const Family tracks{kTrack, kTrackCalibrated};
  if (name == kPostument.name) return postuments.copy(model);
  if (name == kTrack.name) return tracks.copy(model);
  return nullptr;
}

}  // namespace mrroc::irb6
