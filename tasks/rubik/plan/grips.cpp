#include "tasks/rubik/plan/grips.hpp"

#include <cmath>

namespace mrroc::rubik {
namespace {

constexpr double kTrackStep = 0.1;      // [m]
constexpr int kTrackSteps = 6;          // to either side
constexpr Eigen::Index kArmJoints = 6;  // without a track

}  // namespace

Pose turn_about_z(double angle) { return {rotation_from_angle_axis({0, 0, angle}), Vector3::Zero()}; }
Pose along_z(double distance) { return {Matrix3::Identity(), {0, 0, distance}}; }

Pose front_grip(const Meeting& meeting, Hand hand) {
  const Pose T_ME =
      hand == Hand::track ? Pose{} : Pose{Eigen::DiagonalMatrix<double, 3>(-1, 1, -1), Vector3::Zero()};
  return meeting.T_UM * T_ME * along_z(-depth(hand));
}

SideGrip side_grip(const Meeting& meeting, Hand comes, double angle) {
  const Hand offers = other(comes);
  const Vector3 z = front_grip(meeting, offers).R.col(2);
  const Vector3 direction = meeting.T_UM.R * Vector3(std::cos(angle), std::sin(angle), 0);
  // The fingers of the postument cover one layer only, so they fit before and behind the narrow palm of the track arm,
  // whichever of the two hands comes; those of the track arm lie beside both hands.
  const bool track_comes = comes == Hand::track;
  const Vector3 beside = z.cross(direction);
  const Vector3 y_offers = track_comes ? direction : beside, y_comes = track_comes ? beside : z;
  Matrix3 R_offers, R_comes;
  R_offers << y_offers.cross(z), y_offers, z;
  R_comes << y_comes.cross(direction), y_comes, direction;
  return {.comes = {R_comes, meeting.T_UM.p - depth(comes) * direction},
          .offers = {R_offers, meeting.T_UM.p - depth(offers) * z}};
}

std::vector<AxisVector> along_track(const AxisVector& joints) {
  if (joints.size() <= kArmJoints) return {joints};
  std::vector<AxisVector> places;
  for (int k = -kTrackSteps; k <= kTrackSteps; ++k) {
    places.push_back(joints);
    places.back()[0] += k * kTrackStep;
  }
  return places;
}

}  // namespace mrroc::rubik
