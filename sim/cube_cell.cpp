#include "sim/cube_cell.hpp"

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <stdexcept>

#include "base/pose.hpp"
#include "robots/irb6/arm.hpp"

namespace mrroc::sim {
namespace {

// The result of the search.
const Vector3 kPlace{0.373, 1.292, 1.281};  // of the cube in the world [m]
constexpr double kAzimuth = 1.105;          // of its axis out of U [rad]
constexpr double kElevation = 0.791;
constexpr double kTurned = 0.230;  // about that axis
const std::array<std::vector<double>, 2> kNear{{{-0.9494, -1.6953, 0.1376, -0.4440, 4.0401, 0.7052},
                                                {0.3916, 1.1953, -1.5479, 0.2417, 0.5134, 1.6346, 3.3068}}};
// The same of the search for a place before the camera.
constexpr double kViewAzimuth = 0.349;  // of the way to the camera [rad]
constexpr double kViewElevation = 0.349;
constexpr double kViewDistance = 0.45;  // [m]
/// Of a face that is looked at again [rad]: by 20 degrees, so that what it mirrors is 40 degrees away. Of eight
/// directions it is the one in which all faces are shown soonest.
const Vector3 kTilt(-0.247, -0.247, 0);
constexpr double kClearance =
    0.001;  // of the palm behind long fingers [m]: the hand that comes has no such palm
constexpr double kNarrowPalm =
    0.018;  // of long fingers [m]: beside it there is room for the other hand's finger
constexpr double kSqueezed = 0.0002;  // by which the pads of a firm grip give way together [m]

/// @return z in the given direction, x level
Matrix3 level(double azimuth, double elevation) {
  Matrix3 R;
  R.col(2) = Vector3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation));
  R.col(0) = Vector3::UnitZ().cross(R.col(2)).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

std::vector<double> joints_at(const ArmParameters& arm, int number, const Pose& T_UE) {
  const auto robot = irb6::make_arm(arm.model == ArmModel::irb6_track ? "irb6_track" : "irb6_postument");
  const auto solution =
      robot->inverse(arm.T_UB.inverse() * T_UE * robot->tool_in_wrist().inverse(), meeting_joints(number));
  if (!solution.reached) throw std::invalid_argument("cube cell: an arm does not reach the cube");
  return {solution.joints.begin(), solution.joints.end()};
}

}  // namespace

GripperBodyParameters gripper_with(Fingers fingers) {
  GripperBodyParameters p;
  if (fingers == Fingers::one_layer) return p;
  p.palm = kCubeEdge / 2 - kTwoLayers + kClearance;
  p.palm_width = kNarrowPalm;
  p.pad_depth = 0.034;
  return p;
}

Pose cube_in_hand(Fingers fingers, rubik::Face face) {
  return Pose{Matrix3::Identity(), {0, 0, fingers == Fingers::one_layer ? kOneLayer : kTwoLayers}} *
         cube_with(face);
}

Pose meeting_place() {
  return {level(kAzimuth, kElevation) * rotation_from_angle_axis({0, 0, kTurned}), kPlace};
}

AxisVector meeting_joints(int arm) {
  const auto& near = kNear[static_cast<std::size_t>(arm)];
  return Eigen::Map<const Eigen::VectorXd>(near.data(), static_cast<Eigen::Index>(near.size()));
}

rubik::Viewing viewing_place(int reading) {
  const auto face = [](const Matrix3& R) { return Pose{R, kPlace + kCubeEdge / 2 * R.col(2)}; };
  const Matrix3 R = level(kViewAzimuth, kViewElevation);
  return {face(reading == 0 ? R : Matrix3(R * rotation_from_angle_axis(kTilt))), kViewDistance, face(R)};
}

Pose grip(int arm) {
  if (arm == kTrack) return {Matrix3::Identity(), {0, 0, -kTwoLayers}};
  return {Eigen::DiagonalMatrix<double, 3>(-1, 1, -1), {0, 0, kOneLayer}};
}

Pose cube_with(rubik::Face face) {
  using rubik::Face;
  constexpr double kQuarter = std::numbers::pi / 2;
  switch (face) {
    case Face::U:
      return {};
    case Face::D:
      return {rotation_from_angle_axis({2 * kQuarter, 0, 0}), Vector3::Zero()};
    case Face::R:
      return {rotation_from_angle_axis({0, -kQuarter, 0}), Vector3::Zero()};
    case Face::L:
      return {rotation_from_angle_axis({0, kQuarter, 0}), Vector3::Zero()};
    case Face::B:
      return {rotation_from_angle_axis({kQuarter, 0, 0}), Vector3::Zero()};
    case Face::F:
      break;
  }
  return {rotation_from_angle_axis({-kQuarter, 0, 0}), Vector3::Zero()};
}

WorldParameters cube_cell(const CubeCellParameters& c) {
  WorldParameters world;
  world.solver_iterations = kCubeIterations;
  world.cube.emplace();
  world.cube->state = c.state;
  world.cube->faces = c.faces;
  world.cube->held_by = kTrack;
  world.cube->T_EC = cube_in_hand(Fingers::two_layers, c.face);

  for (int k = 0; k < 2; ++k) {
    ArmParameters& arm = world.arms[static_cast<std::size_t>(k)];
    arm.gripper = gripper_with(k == kTrack ? Fingers::two_layers : Fingers::one_layer);
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

LoadedTool tool_with_cube(int arm, const CubeParameters& cube) {
  const auto robot = irb6::make_arm(arm == kTrack ? "irb6_track" : "irb6_postument");
  const irb6::ArmParameters& p = robot->parameters();
  const double added = cube.mass * 9.81;
  const Vector3 place = robot->tool_in_wrist() * grip(arm).inverse().p;
  const Vector3 own = Eigen::Map<const Vector3>(p.tool_mass_centre.data());
  return {p.tool_weight + added, (p.tool_weight * own + added * place) / (p.tool_weight + added)};
}

}  // namespace mrroc::sim
