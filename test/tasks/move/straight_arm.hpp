// An arm whose kinematics can be reckoned by hand: six joints that are x, y, z and the rotation vector of E. Motors turn ten
// times as far.
#pragma once
#include <array>
#include <string>

#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {

class StraightArm final : public Body {
 public:
  static constexpr double kReach = 2;  ///< [m]

  [[nodiscard]] int axes() const override { return 6; }
  [[nodiscard]] ecp::Coordinates usual_start() const override { return ecp::Coordinates::Zero(6); }
  [[nodiscard]] Pose pose(const ecp::Coordinates& joints) const override {
    return pose_from_angle_axis(joints.head<6>());
  }
  [[nodiscard]] ecp::Coordinates motors(const ecp::Coordinates& joints) const override { return 10 * joints; }
  [[nodiscard]] ecp::Coordinates joints_of_motors(const ecp::Coordinates& motors) const override {
    return motors / 10;
  }
  [[nodiscard]] std::optional<ecp::Coordinates> joints_of_pose(const Pose& T_0E,
                                                               const ecp::Coordinates& near) const override {
    if (T_0E.p.norm() > kReach) return std::nullopt;
    return ecp::nearest_coordinates(Representation::xyz_angle_axis, angle_axis_from_pose(T_0E), near);
  }
};

inline MotionFile file_of_text(const std::string& text) {
  const Config config = Config::parse(text, "my.toml");
  MotionFile file = read_motions(config, {{"arm1", 6}, {"arm2", 6}});
  config.check_all_used();
  return file;
}

inline Plan plan_of_text(const std::string& text) {
  const StraightArm arm;
  const std::array<const Body*, 2> bodies{&arm, &arm};
  return make_plan(file_of_text(text), bodies);
}

}  // namespace mrroc::any_motion
