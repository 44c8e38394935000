#include "test/rig/cube_cell.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

#include "base/pose.hpp"
#include "robots/irb6/robot_type.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kSqueezed = 0.0002;  // by which the pads of a firm grip give way together [m]

std::vector<double> joints_at(const sim::ArmParameters& arm, int number, const Pose& T_UE) {
  const auto robot = arm.type->make(0);
  const auto solution =
      robot->inverse(arm.T_UB.inverse() * T_UE * arm.type->driver.T_WE.inverse(), meeting_joints(number));
  if (!solution.reached) throw std::invalid_argument("cube cell: an arm does not reach the cube");
  return {solution.joints.begin(), solution.joints.end()};
}

}  // namespace

sim::WorldParameters cube_cell(const CubeCellParameters& c) {
  sim::WorldParameters world = rig::irb6_cell();
  world.solver_iterations = kCubeIterations;
  world.cube.emplace();
  world.cube->state = c.state;
  world.cube->faces = c.faces;
  world.cube->held_by = kTrack;
  world.cube->T_EC = cube_in_hand(Fingers::two_layers, c.face);

  for (int k = 0; k < 2; ++k) {
    sim::ArmParameters& arm = world.arms[static_cast<std::size_t>(k)];
    arm.gripper = sim::gripper_body(gripper_with(k == kTrack ? Fingers::two_layers : Fingers::one_layer));
    arm.jaws.emplace();
    Pose T_ME = grip(k);
    if (k == kTrack) {
      arm.jaws->start = world.cube->edge - kSqueezed;
    } else {
      arm.jaws->start = c.jaws;
      T_ME = T_ME * pose_from_angle_axis((AngleAxisPose() << c.grasp_error.x(), c.grasp_error.y(),
                                          -c.distance, 0, 0, c.turn_error)
                                             .finished());
    }
    arm.start = joints_at(arm, k, meeting_place() * T_ME);
  }
  return world;
}

LoadedTool tool_with_cube(int arm, const sim::CubeParameters& cube) {
  const robots::DriverDefaults& p = (arm == kTrack ? irb6::track() : irb6::postument()).driver;
  const double added = cube.mass * 9.81;
  const Vector3 place = p.T_WE * grip(arm).inverse().p;
  const Vector3 own = Eigen::Map<const Vector3>(p.tool_mass_centre.data());
  return {p.tool_weight + added, (p.tool_weight * own + added * place) / (p.tool_weight + added)};
}

}  // namespace mrroc::rubik
