#include "tasks/visual_servo/regulator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/screw.hpp"

namespace mrroc::visual_servo {
namespace {

Vector3 clipped(const Vector3& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3(most / length * v) : v;
}

AngleAxisPose clipped(const AngleAxisPose& r, double most, double most_angle) {
  AngleAxisPose result;
  result << clipped(Vector3(r.head<3>()), most), clipped(Vector3(r.tail<3>()), most_angle);
  return result;
}

}  // namespace

RegulatorParameters eased(const RegulatorParameters& k, double ease) {
  RegulatorParameters slower = k;
  for (double* const speed :
       {&slower.speed, &slower.angular_speed, &slower.top_speed, &slower.top_angular_speed})
    *speed *= ease;
  return slower;
}

RegulatorParameters quieted(const RegulatorParameters& k, const Pose& e, const Matrix6& covariance) {
  const Vector6 xi = log_screw(e).vector();
  const double square = xi.dot(covariance.llt().solve(xi));  // in standard deviations
  const double beyond = square > 0 ? std::max(0., 1 - k.significance * k.significance / square) : 0;
  const double share = k.quiet + (1 - k.quiet) * beyond;
  RegulatorParameters result = k;
  result.gain *= share;
  result.angular_gain *= share;
  return result;
}

Pose regulate(const RegulatorParameters& k, const Pose& e, double duration) {
  AngleAxisPose r = angle_axis_from_pose(e);
  r.head<3>() *= k.gain;
  r.tail<3>() *= k.angular_gain;
  return pose_from_angle_axis(clipped(r, k.speed * duration, k.angular_speed * duration));
}

Pose smooth(const RegulatorParameters& k, const Pose& wanted, const Pose& previous, double duration) {
  const AngleAxisPose before = angle_axis_from_pose(previous);
  const AngleAxisPose slow =
      clipped(angle_axis_from_pose(wanted), k.top_speed * duration, k.top_angular_speed * duration);
  const double square = duration * duration;
  const AngleAxisPose change =
      clipped(slow - before, k.acceleration * square, k.angular_acceleration * square);
  return pose_from_angle_axis(before + change);
}

}  // namespace mrroc::visual_servo
