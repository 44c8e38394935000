#include "robots/rex/stage_residuals.hpp"

#include "base/platform_path.hpp"
#include "robots/rex/planar.hpp"

namespace mrroc::rex {
namespace {

using Eigen::Vector2d;

/// One number of z was measured.
void add(StageResiduals& to, int index, double error, double deviation) noexcept {
  to.H.row(to.count).setZero();
  to.H(to.count, index) = 1 / deviation;
  to.r[to.count] = error / deviation;
  ++to.count;
}

void add(StageResiduals& to, const PlanarPrediction& predicted, const PlanarFactor& measured) noexcept {
  Eigen::Vector3d error = predicted.value - measured.value;
  error[2] = wrap_angle(error[2]);
  to.H.middleRows<3>(to.count).noalias() = measured.whitening * predicted.slope;
  to.r.segment<3>(to.count).noalias() = measured.whitening * error;
  to.count += 3;
}

}  // namespace

PlanarPrediction pose_of_body(const StageVector& z, const Vector2d& centre, double delay) noexcept {
  const Eigen::Matrix2d R = rotation(z[2]);
  const double w = z[5];
  const Vector2d velocity = z.segment<2>(3) - w * turned(centre);  // of B, along B
  const Vector2d from_centre = R * (delay * velocity - centre);
  PlanarPrediction b;
  b.value << z.head<2>() + from_centre, z[2] + delay * w;
  b.slope.setZero();
  b.slope.leftCols<3>().setIdentity();
  b.slope.block<2, 1>(0, 2) = turned(from_centre);
  b.slope.block<2, 2>(0, 3) = delay * R;
  b.slope.block<2, 1>(0, 5) = -delay * (R * turned(centre));
  b.slope(2, 5) = delay;
  return b;
}

PlanarPrediction motion_of_body(const StageVector& z, const Vector2d& centre) noexcept {
  const Eigen::Matrix2d back = rotation(z[kCloneIndex + 2]).transpose();
  const Eigen::Matrix2d turn = rotation(z[2] - z[kCloneIndex + 2]);
  const Vector2d moved = back * (z.head<2>() - z.segment<2>(kCloneIndex));  // of the centre of mass
  PlanarPrediction b;
  b.value << moved + centre - turn * centre, z[2] - z[kCloneIndex + 2];
  b.slope.setZero();
  b.slope.block<2, 2>(0, 0) = back;
  b.slope.block<2, 1>(0, 2) = -turn * turned(centre);
  b.slope.block<2, 2>(0, kCloneIndex) = -back;
  b.slope.block<2, 1>(0, kCloneIndex + 2) = turn * turned(centre) - turned(moved);
  b.slope(2, 2) = 1;
  b.slope(2, kCloneIndex + 2) = -1;
  return b;
}

StageResiduals residuals(const StageVector& z, const WindowStage& stage, double yaw_offset,
                         const Vector2d& centre, const EstimatorNoise& noise) noexcept {
  constexpr int kWheelIndex = 6;
  StageResiduals all;
  if (stage.wheels_valid)
    for (int i = 0; i < 4; ++i)
      add(all, kWheelIndex + i, z[kWheelIndex + i] - stage.wheel_speed[i], noise.wheel_speed);
  if (stage.imu_valid) {
    add(all, 5, z[5] - stage.yaw_rate, noise.yaw_rate);
    add(all, 2, wrap_angle(z[2] - (stage.yaw + yaw_offset)), noise.yaw);
  }
  if (stage.map.valid) add(all, pose_of_body(z, centre, stage.map_delay), stage.map);
  if (stage.odometry.valid) add(all, motion_of_body(z, centre), stage.odometry);
  return all;
}

}  // namespace mrroc::rex
