#include "tasks/guide/cell/guide_cell.hpp"

#include <fmt/core.h>

#include "base/table_config.hpp"
#include "edp/guard.hpp"
#include "robots/catalogue.hpp"
#include "sim/config.hpp"
#include "sim/start_joints.hpp"

namespace mrroc::guide {
namespace {

constexpr double kBetween = 0.005;  // places that are tried [m]
constexpr double kAbove = 0.005;    // the table, at least [m]
constexpr const char* kRemedy = "move it with task.centre, turn it with task.turned, or make it smaller";

[[noreturn]] void refuse(const Vector3& p, const std::string& why) {
  throw FaultError(
      FaultCode::bad_configuration,
      fmt::format("the fixture goes through ({:.3f}, {:.3f}, {:.3f}) m: {}", p.x(), p.y(), p.z(), why),
      kRemedy);
}

}  // namespace

Pose sheet_of(const Config& config) { return sim::read_world(config).arms.at(0).paper.T_0P; }

double hand_compliance(const Config& config) {
  const sim::HandParameters hand = sim::read_world(config).arms.at(0).hand;
  return 1 / hand.stiffness + (hand.mass > 0 ? 1 / hand.grip_stiffness : 0);
}

void check_reach(const Config& config, const Setup& setup) {
  const double table = read_table(config).height;
  const robots::RobotType& type = robots::read_type(config, "arm1", robots::catalogue(), "irb6_postument");
  const auto robot = robots::read_robot(config, "arm1", type);
  edp::AxisPositions from{sim::start_joints(sim::read_world(config).arms.at(0)), {}};
  from.motors = robot->motors_from_joints(from.joints);
  const Matrix3 R_0W = robot->forward(from.joints).R;
  for (const Vector3& p : setup.fixture.points(kBetween)) {
    if (p.z() < table + kAbove) refuse(p, "that is in the table");
    const edp::InverseSolution solution = robot->inverse({R_0W, p - R_0W * setup.T_WE.p}, from.joints);
    if (!solution.reached) refuse(p, "the tool does not reach it");
    const edp::AxisPositions to{solution.joints, robot->motors_from_joints(solution.joints)};
    if (const auto fault = edp::check_range(*robot, from, to, 0)) refuse(p, describe(*fault));
    from = to;
  }
}

}  // namespace mrroc::guide
