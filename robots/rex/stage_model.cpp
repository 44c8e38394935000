#include "robots/rex/stage_model.hpp"

#include <algorithm>
#include <cmath>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

/// @return whether something can be learnt of the ground: the wheels move over it by torques that are known
bool learning(const StageVector& z, const WindowStage& to, const EstimatorNoise& noise) noexcept {
  const double speed = z.segment<2>(kVelocity).norm() + kHalfTrack * std::abs(z[kTurnRate]);
  return to.torque_known && speed >= noise.rest_speed;
}

NoiseVector deviations(const WindowStage& to, bool learning, const EstimatorNoise& noise) noexcept {
  NoiseVector deviation;
  deviation.segment<3>(kPose).setConstant(noise.pose_process);
  deviation.segment<3>(kVelocity).setConstant(noise.velocity_process);
  deviation.segment<4>(kWheelSpeed)
      .setConstant(to.torque_known ? noise.wheel_process : noise.braked_wheel_process);
  deviation.segment<3>(kSlipIndex).setConstant(learning ? noise.slip_process : 0);
  return deviation;
}

void clamp(StageVector& z, int first, int count, double most) noexcept {
  for (int i = first; i < first + count; ++i) z[i] = std::clamp(z[i], -most, most);
}

}  // namespace

StageTransition transition(const StageVector& z, const WindowStage& from, const WindowStage& to,
                           const Load& weighed, const EstimatorNoise& noise) noexcept {
  Load load = weighed;
  for (std::size_t i = 0; i < kWheels; ++i) load.wheel[i] = to.load[static_cast<int>(i)];
  const auto moved = ocp::integrate(SkidSteer(load), State(z.head<10>()), Torques(to.torque),
                                    Friction(z.segment<3>(kSlipIndex)), kPlatformPeriod);
  const bool learns = learning(z, to, noise);
  StageTransition next;
  next.z = z;
  next.F.setIdentity();
  if (moved.x.allFinite() && moved.A.allFinite() && moved.C.allFinite()) {
    next.z.head<10>() = moved.x;
    next.F.topLeftCorner<10, 10>() = moved.A;
    if (learns) next.F.block<10, 3>(0, kSlipIndex) = moved.C;
  }
  if (from.picture) {
    next.z.segment<3>(kCloneIndex) = z.segment<3>(kPose);
    next.F.block<3, 3>(kCloneIndex, kPose).setIdentity();
    next.F.block<3, 3>(kCloneIndex, kCloneIndex).setZero();
  }
  next.deviation = deviations(to, learns, noise);
  return next;
}

StageVector contained(const StageVector& z) noexcept {
  constexpr SlipBounds kBounds;
  StageVector in = z;
  clamp(in, kPose, 3, 1e5);
  clamp(in, kVelocity, 2, 20);
  clamp(in, kTurnRate, 1, 50);
  clamp(in, kWheelSpeed, 4, 300);
  for (int i = kSlipIndex; i < kSlipIndex + 2; ++i)
    in[i] = std::clamp(in[i], kBounds.least_friction, kBounds.most_friction);
  clamp(in, kSlipIndex + 2, 1, kBounds.most_split);
  clamp(in, kCloneIndex, 3, 1e5);
  return in;
}

StageVector difference(const StageVector& a, const StageVector& b) noexcept {
  StageVector d = a - b;
  d[kHeading] = wrap_angle(d[kHeading]);
  d[kCloneIndex + kHeading] = wrap_angle(d[kCloneIndex + kHeading]);
  return d;
}

}  // namespace mrroc::rex
