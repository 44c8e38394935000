#include "tasks/rubik/cell/belief.hpp"

#include <stdexcept>
#include <utility>

#include "base/cube/cube_config.hpp"
#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "base/fault.hpp"
#include "base/representation.hpp"
#include "base/table_config.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {
namespace {

constexpr std::array kUsualFingers{Fingers::one_layer, Fingers::two_layers};

GripperShape read_gripper(const Config& config, const std::string& arm) {
  constexpr int kAsGiven = -1;
  const int given = config.section("robots." + arm)
                        .choice("fingers", 0, {{"none", 0}, {"one_layer", 1}, {"two_layers", 2}});
  int layers =
      config.section("cell.robots." + arm)
          .choice("fingers", kAsGiven, {{"as_given", kAsGiven}, {"one_layer", 1}, {"two_layers", 2}});
  if (layers == kAsGiven) layers = given;
  if (layers == 0)
    throw FaultError(FaultCode::bad_configuration, "robots." + arm + ".fingers: this task needs fingers");
  return gripper_with(layers == 1 ? Fingers::one_layer : Fingers::two_layers);
}

ArmBelief read_arm(const Config& config, const std::string& key, const robots::RobotType& usual) {
  ArmBelief arm;
  arm.type = &robots::read_type(config, key, robots::catalogue(), usual.name);
  if (arm.type != &usual)
    throw FaultError(FaultCode::bad_configuration, "robots." + key + ".model: this task plans for the " +
                                                       std::string(usual.name) + " there");
  arm.model = robots::read_robot(config, key, *arm.type)->model();
  arm.T_UB = robots::read_place(config, key, "cell", *arm.type);
  arm.gripper = read_gripper(config, key);
  const auto start =
      config.section("robots." + key).list("start_joints", std::vector<double>{}, {-10, 10}, "rad, m");
  arm.start = Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  return arm;
}

Grasp read_grasp(const Config& config) {
  const Config cell = config.section("cell.cube");
  const Config given = config.section("cube");
  std::string holder = given.text("held_by", "");
  if (const std::string believed = cell.text("held_by", ""); !believed.empty()) holder = believed;
  const std::string& track = kArmKeys[index(Hand::track)];
  if (holder != track)
    throw FaultError(FaultCode::bad_configuration,
                     "cube.held_by: " + track + " holds the cube at the beginning; give that, or nothing");
  const auto names = face_names();
  Face facing = given.choice("facing", Face::U, std::span(std::as_const(names)));
  std::vector<std::pair<std::string_view, std::optional<Face>>> believed{{"as_given", std::nullopt}};
  for (const auto& [name, face] : names) believed.emplace_back(name, face);
  if (const auto face = cell.choice("facing", std::optional<Face>(), std::span(std::as_const(believed))))
    facing = *face;
  return grasp_from(Hand::track, cube_with(facing).R);
}

Cube read_known(const Config& config) {
  const Cube given = read_given_cube(config);
  const Config cell = config.section("cell.cube");
  const std::string state = cell.text("state", "");
  const std::string scramble = cell.text("scramble", "");
  if (!state.empty() && !scramble.empty())
    throw FaultError(FaultCode::bad_configuration, "cell.cube: give one of state and scramble");
  if (!state.empty()) return cube_from_facelets(state);
  return scramble.empty() ? given : after({}, parse_moves(scramble));
}

}  // namespace

CellBelief usual_cell() {
  CellBelief cell;
  for (std::size_t k = 0; k < cell.arms.size(); ++k) {
    const robots::RobotType* const type = robots::find(kArmModels[k]);
    if (!type)
      throw FaultError(FaultCode::bad_configuration, "no robot is called " + std::string(kArmModels[k]));
    cell.arms[k] = {type, 0, type->T_UB, gripper_with(kUsualFingers[k]), {}};
  }
  cell.grasp = grasp_from(Hand::track, cube_with(Face::U).R);
  return cell;
}

CellBelief read_belief(const Config& config) {
  CellBelief cell = usual_cell();
  for (std::size_t k = 0; k < cell.arms.size(); ++k)
    cell.arms[k] = read_arm(config, kArmKeys[k], *cell.arms[k].type);
  const TableDescription told = read_table(config);
  const Config table = config.section("cell.table");
  cell.T_0P.p.x() = table.number("distance", told.distance, TableBounds::kDistance, "m");
  cell.T_0P.p.z() = table.number("height", told.height, TableBounds::kHeight, "m");
  cell.grasp = read_grasp(config);
  cell.known = read_known(config);
  return cell;
}

std::array<AxisVector, 2> joints_at_meeting(const CellBelief& cell, double retreat) {
  std::array<AxisVector, 2> joints;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const ArmBelief& arm = cell.arms[k];
    Pose T_ME = grip(static_cast<int>(k));
    if (k != index(Hand::track))
      T_ME = T_ME * pose_from_angle_axis((AngleAxisPose() << 0, 0, -retreat, 0, 0, 0).finished());
    const Pose T_0W = arm.T_UB.inverse() * (meeting_place() * T_ME) * arm.type->driver.T_WE.inverse();
    const auto solution = arm.type->make(arm.model)->inverse(T_0W, meeting_joints(static_cast<int>(k)));
    if (!solution.reached)
      throw std::invalid_argument("the cell of the cube: an arm does not reach the cube");
    joints[k] = solution.joints;
  }
  return joints;
}

}  // namespace mrroc::rubik
