#include "base/cube/fingers.hpp"

#include <numbers>

namespace mrroc::cube {
namespace {

constexpr double kClearance =
    0.001;  // of the palm behind long fingers [m]: the hand that comes has no such palm
constexpr double kNarrowPalm =
    0.018;  // of long fingers [m]: beside it there is room for the other hand's finger

}  // namespace

GripperShape gripper_with(Fingers fingers) {
  GripperShape p;
  if (fingers == Fingers::one_layer) return p;
  p.palm = kEdge / 2 - depth(Fingers::two_layers) + kClearance;
  p.palm_width = kNarrowPalm;
  p.pad_depth = 0.034;
  return p;
}

Pose cube_with(Face face) {
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

Pose cube_in_hand(Fingers fingers, Face face) {
  return Pose{Matrix3::Identity(), {0, 0, depth(fingers)}} * cube_with(face);
}

}  // namespace mrroc::cube
