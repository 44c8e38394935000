#include "tasks/visual_servo/object_track.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace mrroc::visual_servo {
namespace {

using Covariance = ObjectTrack::Covariance;

Matrix6 two(double linear, double angular) {
  Vector6 d;
  d << Vector3::Constant(linear), Vector3::Constant(angular);
  return d.cwiseAbs2().asDiagonal();
}

ObjectTrack first(const TrackParameters& k, const Sighting& seen) {
  ObjectTrack track{.known = true, .step = seen.step, .T_0G = seen.T_0G};
  track.P.topLeftCorner<6, 6>() = seen.covariance;
  track.P.bottomRightCorner<6, 6>() = two(k.speed, k.angular_speed);
  return track;
}

ObjectTrack predicted(const TrackParameters& k, const ObjectTrack& track, double time) {
  ObjectTrack next = track;
  next.T_0G = carried(track.T_0G, {track.v, track.omega}, time);
  Covariance F = Covariance::Identity();
  F.topRightCorner<6, 6>().diagonal().setConstant(time);
  Eigen::Matrix<double, 12, 6> G;  // of the acceleration on the state
  G << 0.5 * time * time * Matrix6::Identity(), time * Matrix6::Identity();
  next.P = F * track.P * F.transpose() + G * two(k.acceleration, k.angular_acceleration) * G.transpose();
  return next;
}

Vector6 deviation(const Pose& from, const Pose& to) {
  Vector6 z;
  z << to.p - from.p, angle_axis_from_rotation(to.R * from.R.transpose());
  return z;
}

double shrink(const TrackParameters& k, const Vector3& v, const Matrix3& covariance) {
  const double square = v.dot(covariance.llt().solve(v));  // standard deviations, squared
  return square > 0 ? std::max(0., 1 - k.significance * k.significance / square) : 0;
}

}  // namespace

ObjectTrack see(const TrackParameters& k, const ObjectTrack& track, const Sighting& seen, double dt) {
  if (!track.known || seen.step - track.step > k.memory) return first(k, seen);
  if (seen.step < track.step) return track;
  ObjectTrack next = predicted(k, track, static_cast<double>(seen.step - track.step) * dt);
  next.step = seen.step;
  const Vector6 z = deviation(next.T_0G, seen.T_0G);
  if (z.head<3>().norm() > k.jump || z.tail<3>().norm() > k.angular_jump) return first(k, seen);
  const Eigen::LLT<Matrix6> S(next.P.topLeftCorner<6, 6>() + seen.covariance);
  const Eigen::Matrix<double, 6, 12> C = next.P.topRows<6>();
  const Eigen::Matrix<double, 12, 6> K = S.solve(C).transpose();
  const Eigen::Matrix<double, 12, 1> x = K * z;
  next.T_0G.p += x.head<3>();
  next.T_0G.R = orthonormal(rotation_from_angle_axis(x.segment<3>(3)) * next.T_0G.R);
  next.v += x.segment<3>(6);
  next.omega += x.tail<3>();
  next.P -= K * C;
  next.P = Covariance(0.5 * (next.P + next.P.transpose()));
  return next;
}

ObjectMotion significant_motion(const TrackParameters& k, const ObjectTrack& track) {
  if (!track.known) return {};
  return {shrink(k, track.v, track.P.block<3, 3>(6, 6)) * track.v,
          shrink(k, track.omega, track.P.block<3, 3>(9, 9)) * track.omega};
}

Pose carried(const Pose& T_0G, const ObjectMotion& motion, double time) {
  return {rotation_from_angle_axis(motion.omega * time) * T_0G.R, T_0G.p + motion.v * time};
}

}  // namespace mrroc::visual_servo
