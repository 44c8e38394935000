#include "tasks/manual/cell/arm_reach.hpp"

#include "base/representation.hpp"
#include "edp/guard.hpp"
#include "robots/catalogue.hpp"
#include "tasks/manual/config.hpp"

namespace mrroc::manual {
namespace {

Pose pose_of(Representation r, const PoseNumbers& numbers) {
  return pose_from_numbers(r, numbers).value_or(Pose{});
}

class ArmReach final : public Reach {
 public:
  explicit ArmReach(std::unique_ptr<edp::Robot> arm) : arm_(std::move(arm)) {}

  [[nodiscard]] std::optional<Fault> validation_error(Representation space, const ecp::Coordinates& goal,
                                                      const EffectorReply& now,
                                                      std::optional<int> model) const override {
    if (now.state == DriverState::not_synchronised || now.state == DriverState::homing ||
        now.state == DriverState::jogging)
      return {};
    const edp::Robot* const other = model ? arm_->with_model(*model) : nullptr;
    const edp::Robot& robot = other ? *other : *arm_;
    const int axes = robot.axes();
    const edp::AxisPositions from{Eigen::Map<const Eigen::VectorXd>(now.joints.data(), axes),
                                  Eigen::Map<const Eigen::VectorXd>(now.motors.data(), axes)};
    edp::AxisPositions to = from;
    if (space == Representation::motors) {
      to.motors = goal;
      to.joints = robot.joints_from_motors(to.motors);
    } else if (space == Representation::joints) {
      to.joints = goal;
    } else {
      PoseNumbers measured{};
      std::ranges::copy(now.T_0E, measured.begin());
      const Pose T_WE =
          robot.forward(from.joints).inverse() * pose_of(Representation::xyz_angle_axis, measured);
      const Pose T_0W = pose_of(space, numbers_from_axes(goal)) * T_WE.inverse();
      const edp::InverseSolution solution = robot.inverse(T_0W, from.joints);
      if (!solution.reached)
        return edp::make_fault(FaultCode::unreachable_pose, "missing [m]", -1, solution.missing);
      to.joints = solution.joints;
    }
    if (space != Representation::motors) to.motors = robot.motors_from_joints(to.joints);
    return edp::check_range(robot, from, to, 0);
  }

 private:
  std::unique_ptr<edp::Robot> arm_;
};

}  // namespace

std::unique_ptr<Reach> make_arm_reach(const Config& config, const std::string& arm) {
  const robots::RobotType& type = robots::read_type(config, arm, robots::catalogue(), "irb6_postument");
  return std::make_unique<ArmReach>(robots::read_robot(config, arm, type));
}

void run_manual_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const auto reach = make_arm_reach(config, arguments.arm);
  run_ecp(process, config, arguments, *reach);
}

}  // namespace mrroc::manual
