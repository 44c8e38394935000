#include "tasks/move/cell/arm_body.hpp"

#include "base/representation.hpp"
#include "ecp/preparation.hpp"
#include "robots/catalogue.hpp"
#include "tasks/move/config.hpp"

namespace mrroc::any_motion {
namespace {

class ArmBody final : public Body {
 public:
  ArmBody(std::unique_ptr<edp::Robot> arm, ecp::Coordinates start, const Pose& T_WE)
      : arm_(std::move(arm)), start_(std::move(start)), T_WE_(T_WE) {}

  [[nodiscard]] int axes() const override { return arm_->axes(); }
  [[nodiscard]] ecp::Coordinates usual_start() const override { return start_; }
  [[nodiscard]] Pose pose(const ecp::Coordinates& joints) const override {
    return arm_->forward(joints) * T_WE_;
  }
  [[nodiscard]] ecp::Coordinates motors(const ecp::Coordinates& joints) const override {
    return arm_->motors_from_joints(joints);
  }
  [[nodiscard]] ecp::Coordinates joints_of_motors(const ecp::Coordinates& motors) const override {
    return arm_->joints_from_motors(motors);
  }
  [[nodiscard]] std::optional<ecp::Coordinates> joints_of_pose(const Pose& T_0E,
                                                               const ecp::Coordinates& near) const override {
    const edp::InverseSolution solution = arm_->inverse(T_0E * T_WE_.inverse(), near);
    return solution.reached ? std::optional<ecp::Coordinates>(solution.joints) : std::nullopt;
  }

 private:
  std::unique_ptr<edp::Robot> arm_;
  ecp::Coordinates start_;
  Pose T_WE_;
};

}  // namespace

std::unique_ptr<Body> make_arm_body(const Config& config, const std::string& arm) {
  const robots::RobotType& type = robots::read_type(config, arm, robots::catalogue(), "irb6_postument");
  const RobotModel tool = robots::read_tool(config, arm, type.driver);
  const ecp::Coordinates start =
      Eigen::Map<const Eigen::VectorXd>(type.start.data(), static_cast<Eigen::Index>(type.start.size()));
  return std::make_unique<ArmBody>(robots::read_robot(config, arm, type), start,
                                   pose_from_numbers(tool.tool_representation, tool.tool).value_or(Pose{}));
}

void run_move_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  run_ecp(process, config, arguments, make_arm_body);
}

}  // namespace mrroc::any_motion
