#include "tasks/rubik/cell/plan_cell.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/rubik/cell/collision.hpp"
#include "tasks/rubik/cell/layout.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kOfMotors = 0.984;  // share of the motors' speed that is used
// From rest to full speed [s]. The large motors draw three fifths of their largest current then, more than which their
// regulators do not ask for; so arms that are heavier than believed follow, too. Those of V and N draw a fifth.
constexpr double kRamp = 0.35;
constexpr double kWristRamp = 0.12;
constexpr double kHandSpeed = 1.4;      // [m/s]: the task's drivers allow 1.5
constexpr double kHandTurnSpeed = 3.7;  // [rad/s]: they allow 4

SpeedLimits speed_limits(const edp::Robot& robot) {
  AxisVector speeds(robot.axes());
  for (int k = 0; k < robot.axes(); ++k) speeds[k] = kOfMotors * robot.axis(k).max_motor_speed;
  AxisVector accelerations = speeds / kRamp;
  accelerations.tail<2>() = speeds.tail<2>() / kWristRamp;
  return {{speeds, accelerations}, kHandSpeed, kHandTurnSpeed};
}

double share(double x, const edp::Range& range) {
  return 2 * std::min(x - range.lower, range.upper - x) / (range.upper - range.lower);
}

}  // namespace

CubePlanCell::CubePlanCell(const CellBelief& cell, const std::optional<Viewing>& viewing)
    : viewing_(viewing), collision_(std::make_unique<CellCollision>(cell, viewing)) {
  for (std::size_t k = 0; k < 2; ++k) {
    const ArmBelief& p = cell.arms[k];
    Side& s = sides_[k];
    s.robot = p.type->make(p.model);
    s.T_UB = p.T_UB;
    s.T_WE = p.type->driver.T_WE;
    s.T_EW = s.T_WE.inverse();
    s.limits = speed_limits(*s.robot);
    meeting_.joints[k] = meeting_joints(static_cast<int>(k));
  }
  meeting_.T_UM = meeting_place();
}

CubePlanCell::~CubePlanCell() = default;

const SpeedLimits& CubePlanCell::limits(Hand hand) const { return side(hand).limits; }

AxisVector CubePlanCell::motors(Hand hand, const AxisVector& joints) const {
  return side(hand).robot->motors_from_joints(joints);
}

AxisVector CubePlanCell::joints(Hand hand, const AxisVector& motors) const {
  return side(hand).robot->joints_from_motors(motors);
}

Pose CubePlanCell::forward(Hand hand, const AxisVector& joints) const {
  const Side& s = side(hand);
  return s.T_UB * s.robot->forward(joints) * s.T_WE;
}

std::optional<AxisVector> CubePlanCell::inverse(Hand hand, const Pose& T_UE, const AxisVector& near) const {
  const Side& s = side(hand);
  const auto solution = s.robot->inverse(s.T_UB.inverse() * T_UE * s.T_EW, near);
  if (!solution.reached) return {};
  return solution.joints;
}

double CubePlanCell::joint_limit_margin(Hand hand, const AxisVector& joints) const {
  const edp::Robot& robot = *side(hand).robot;
  const AxisVector motors = robot.motors_from_joints(joints);
  double least = 1;
  for (int k = 0; k < robot.axes(); ++k)
    least = std::min({least, share(joints[k], robot.axis(k).joint), share(motors[k], robot.axis(k).motor)});
  return least;
}

double CubePlanCell::manipulability(Hand hand, const AxisVector& joints) const {
  // The axes of T and N are parallel where q5 is a multiple of pi.
  return std::abs(std::sin(joints[side(hand).robot->axes() - 2]));
}

bool CubePlanCell::is_free(const CellState& state) const { return collision_->is_free(state); }

std::string CubePlanCell::touching() const {
  return collision_->touching()[0] + " and " + collision_->touching()[1];
}

}  // namespace mrroc::rubik
