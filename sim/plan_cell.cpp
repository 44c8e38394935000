#include "sim/plan_cell.hpp"

#include <algorithm>
#include <cmath>

#include "sim/bullet/cell_collision.hpp"
#include "sim/cube_cell.hpp"
#include "sim/robot_description.hpp"

namespace mrroc::sim {
namespace {

// The pitch axes add up at the absolute angle of T, whose motor turns along with that of V: at these speeds of all
// joints together the motor of V, the one that is used most, makes 246 of its 250 rad/s.
constexpr std::array<double, 6> kSpeeds{1.0, 0.4, 0.4, 0.4, 1.2, 0.75};  // [rad/s]
constexpr double kTrackSpeed = 0.12;                                     // [m/s]
constexpr double kRamp = 0.25;                                           // from rest to full speed [s]

rubik::JointLimits joint_limits(const irb6::Arm& robot) {
  rubik::JointLimits limits{AxisVector(robot.axes()), {}};
  if (robot.parameters().on_track) limits.velocity[0] = kTrackSpeed;
  limits.velocity.tail<irb6::kArmAxes>() = Eigen::Map<const Vector6>(kSpeeds.data());
  limits.acceleration = limits.velocity / kRamp;
  return limits;
}

double share(double x, const edp::Range& range) {
  return 2 * std::min(x - range.lower, range.upper - x) / (range.upper - range.lower);
}

}  // namespace

CubePlanCell::CubePlanCell(const WorldParameters& world, const std::optional<rubik::Viewing>& viewing)
    : viewing_(viewing), collision_(std::make_unique<CellCollision>(world, viewing)) {
  for (std::size_t k = 0; k < 2; ++k) {
    const ArmParameters& p = world.arms[k];
    Side& s = sides_[k];
    s.robot = irb6::make_arm(robot_name(p.model), irb6::model_number(p.kinematics));
    s.T_UB = p.T_UB;
    s.T_EW = s.robot->tool_in_wrist().inverse();
    s.limits = joint_limits(*s.robot);
    meeting_.joints[k] = meeting_joints(static_cast<int>(k));
  }
  meeting_.T_UM = meeting_place();
}

CubePlanCell::~CubePlanCell() = default;

const rubik::JointLimits& CubePlanCell::limits(rubik::Hand hand) const { return side(hand).limits; }

Pose CubePlanCell::forward(rubik::Hand hand, const AxisVector& joints) const {
  const Side& s = side(hand);
  return s.T_UB * s.robot->forward(joints) * s.robot->tool_in_wrist();
}

std::optional<AxisVector> CubePlanCell::inverse(rubik::Hand hand, const Pose& T_UE,
                                                const AxisVector& near) const {
  const Side& s = side(hand);
  const auto solution = s.robot->inverse(s.T_UB.inverse() * T_UE * s.T_EW, near);
  if (!solution.reached) return {};
  return solution.joints;
}

double CubePlanCell::reserve(rubik::Hand hand, const AxisVector& joints) const {
  const irb6::Arm& robot = *side(hand).robot;
  const AxisVector motors = robot.motors_from_joints(joints);
  double least = 1;
  for (int k = 0; k < robot.axes(); ++k)
    least = std::min({least, share(joints[k], robot.axis(k).joint), share(motors[k], robot.axis(k).motor)});
  return least;
}

double CubePlanCell::dexterity(rubik::Hand hand, const AxisVector& joints) const {
  // The axes of T and N are parallel where q5 is a multiple of pi.
  return std::abs(std::sin(joints[side(hand).robot->axes() - 2]));
}

bool CubePlanCell::is_free(const rubik::CellState& state) const { return collision_->is_free(state); }

std::string CubePlanCell::touching() const {
  return collision_->touching()[0] + " and " + collision_->touching()[1];
}

}  // namespace mrroc::sim
