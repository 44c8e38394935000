#include "base/cube/grasp.hpp"

#include <cmath>
#include <numbers>

namespace mrroc::cube {

Vector3 normal(Face face) {
  switch (face) {
    case Face::U:
      return Vector3::UnitZ();
    case Face::R:
      return Vector3::UnitX();
    case Face::F:
      return -Vector3::UnitY();
    case Face::D:
      return -Vector3::UnitZ();
    case Face::L:
      return -Vector3::UnitX();
    case Face::B:
      break;
  }
  return Vector3::UnitY();
}

Face face_along(const Vector3& direction) {
  Face nearest = Face::U;
  for (int k = 1; k < kFaces; ++k)
    if (normal(static_cast<Face>(k)).dot(direction) > normal(nearest).dot(direction))
      nearest = static_cast<Face>(k);
  return nearest;
}

Face cross(Face a, Face b) { return face_along(normal(a).cross(normal(b))); }

bool is_valid(const Grasp& grasp) { return grasp.jaw != grasp.palm && grasp.jaw != opposite(grasp.palm); }

Pose cube_in_hand(const Grasp& grasp) {
  Matrix3 R_CE;
  R_CE.col(1) = normal(grasp.jaw);
  R_CE.col(2) = -normal(grasp.palm);
  R_CE.col(0) = R_CE.col(1).cross(R_CE.col(2));
  return {R_CE.transpose(), {0, 0, depth(grasp.hand)}};
}

Grasp grasp_from(Hand hand, const Matrix3& R_EC) {
  return {hand, face_along(-R_EC.row(2).transpose()), face_along(R_EC.row(1).transpose())};
}

Grasp turned(const Grasp& grasp, int quarters) {
  const Matrix3 R = rotation_from_angle_axis({0, 0, quarters * std::numbers::pi / 2});
  return grasp_from(grasp.hand, R.transpose() * cube_in_hand(grasp).R);
}

std::string to_string(const Grasp& grasp) {
  const std::string hand = grasp.hand == Hand::postument ? "postument" : "track";
  return hand + ' ' + letter(grasp.palm) + '/' + letter(grasp.jaw);
}

}  // namespace mrroc::cube
