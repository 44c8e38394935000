#include "sim/bullet/arm_kind.hpp"

#include <numbers>
#include <stdexcept>
#include <string>

#include "robots/irb6/arm.hpp"
#include "sim/robot_description.hpp"

namespace mrroc::sim {
namespace {

using std::numbers::pi;

// Motor T, counted from the column; motor V, the next one, turns along with it.
constexpr int kAxisT = 3;

// Rotors behind their gears, as felt at the joints. Products between the joints are neglected.
AxisVector reflected_inertia(const edp::Robot& robot, const ArmParameters& p, const AxisVector& joints) {
  const AxisMatrix J = robot.motors_per_joints(joints);
  AxisVector inertia = AxisVector::Zero(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    for (int m = 0; m < robot.axes(); ++m)
      inertia[k] += p.motors[static_cast<std::size_t>(m)].rotor_inertia * J(m, k) * J(m, k);
  return inertia;
}

// The pitch links are driven by absolute angles, so a rotor
// belongs to the link alone; the product term between T and V is neglected (docs/plant.md).
AxisVector irb6_inertia(const irb6::Arm& robot, const ArmParameters& p, const AxisVector& joints) {
  const AxisMatrix J = robot.transmission().jacobian(joints);
  AxisVector inertia(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    inertia[k] = p.motors[static_cast<std::size_t>(k)].rotor_inertia * J(k, k) * J(k, k);
  const int T = robot.parameters().first() + kAxisT;
  const int V = T + 1;
  inertia[T] += p.motors[static_cast<std::size_t>(V)].rotor_inertia * J(V, T) * J(V, T);
  return inertia;
}

class Irb6Kind final : public ArmKind {
 public:
  [[nodiscard]] std::unique_ptr<edp::Robot> make(const ArmParameters& p) const override {
    return irb6::make_arm(robot_name(p.model), irb6::model_number(p.kinematics));
  }
  [[nodiscard]] ArmBody build(const edp::Robot& robot, const ArmParameters& p, const AxisVector& joints,
                              const std::optional<ToolMass>& tool) const override {
    const auto& arm = static_cast<const irb6::Arm&>(robot);
    return build_arm(robot_description(p.model), &arm.parameters().lengths, p.T_UB,
                     irb6_inertia(arm, p, joints), tool, p.gripper);
  }
  /// The pen stands upright above the middle of the sheet.
  [[nodiscard]] AxisVector start(const edp::Robot& robot, const ArmParameters& p) const override {
    const Vector3 tip = p.paper.T_0P * Vector3(0, 0, p.start_height);
    const Pose T_0E{Eigen::DiagonalMatrix<double, 3>(1, -1, -1), tip};
    AxisVector near = AxisVector::Zero(robot.axes());
    near.tail<irb6::kArmAxes>() << 0, -pi / 2, 0, 0, 3 * pi / 2, pi / 2;
    const auto solution =
        robot.inverse(T_0E * static_cast<const irb6::Arm&>(robot).tool_in_wrist().inverse(), near);
    if (!solution.reached)
      throw std::invalid_argument("world: " + std::string(robot.name()) + " does not reach the sheet");
    return solution.joints;
  }
};

/// Arms that are all in ArmParameters::kind.
class OtherKind final : public ArmKind {
 public:
  [[nodiscard]] std::unique_ptr<edp::Robot> make(const ArmParameters& p) const override {
    return p.kind->make();
  }
  [[nodiscard]] ArmBody build(const edp::Robot& robot, const ArmParameters& p, const AxisVector& joints,
                              const std::optional<ToolMass>& tool) const override {
    return build_arm(p.kind->urdf, nullptr, p.T_UB, reflected_inertia(robot, p, joints), tool, p.gripper);
  }
  [[nodiscard]] AxisVector start(const edp::Robot& robot, const ArmParameters&) const override {
    throw std::invalid_argument("world: " + std::string(robot.name()) + " has no joints to start with");
  }
};

}  // namespace

const ArmKind& kind_of(const ArmParameters& p) {
  static const Irb6Kind irb6;
  static const OtherKind other;
  if (p.kind) return other;
  if (p.model == ArmModel::other) throw std::invalid_argument("world: an arm is of no kind");
  return irb6;
}

}  // namespace mrroc::sim
