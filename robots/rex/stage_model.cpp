#include "robots/rex/stage_model.hpp"

#include <algorithm>
#include <cmath>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

/// What the wheels do on the ground.
enum class Contact { rests, rolls, slides };

/// @return how far friction is from being in proportion to slip: s^2 / (s^2 + v_s^2) for the wheels' root mean square s, 0..1
double saturation(const StageVector& z, const PlanarPose& centre) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double a = kWheelX[i] - centre.x;
    const double b = kWheelY[i] - centre.y;
    const double s_x = z[kVelocity] - b * z[kTurnRate] - kWheelRadius * z[kWheelSpeed + static_cast<int>(i)];
    const double s_y = z[kVelocity + 1] + a * z[kTurnRate];
    sum += s_x * s_x + s_y * s_y;
  }
  const double square = sum / static_cast<double>(kWheels);
  return square / (square + kSlipSpeed * kSlipSpeed);
}

/// @return what they do by torques that are known; with torques that are not, as at rest, nothing is to be learnt
Contact contact(const StageVector& z, const WindowStage& to, const PlanarPose& centre,
                const EstimatorNoise& noise) noexcept {
  const double speed = z.segment<2>(kVelocity).norm() + kHalfTrack * std::abs(z[kTurnRate]);
  if (!to.torque_known || speed < noise.rest_speed) return Contact::rests;
  return saturation(z, centre) < noise.sliding ? Contact::rolls : Contact::slides;
}

double slip_deviation(Contact contact, const EstimatorNoise& noise) noexcept {
  switch (contact) {
    case Contact::rests:
      return 0;
    case Contact::rolls:
      return noise.rolling_slip_process;
    case Contact::slides:
      return noise.slip_process;
  }
  return 0;
}

NoiseVector deviations(const WindowStage& to, Contact contact, const EstimatorNoise& noise) noexcept {
  NoiseVector deviation;
  deviation.segment<3>(kPose).setConstant(noise.pose_process);
  deviation.segment<3>(kVelocity).setConstant(noise.velocity_process);
  deviation.segment<4>(kWheelSpeed)
      .setConstant(to.torque_known ? noise.wheel_process : noise.braked_wheel_process);
  deviation.segment<3>(kSlipIndex).setConstant(slip_deviation(contact, noise));
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
  const Contact wheels = contact(z, to, load.centre, noise);
  StageTransition next;
  next.z = z;
  next.F.setIdentity();
  if (moved.x.allFinite() && moved.A.allFinite() && moved.C.allFinite()) {
    next.z.head<10>() = moved.x;
    next.F.topLeftCorner<10, 10>() = moved.A;
    if (wheels == Contact::slides) next.F.block<10, 3>(0, kSlipIndex) = moved.C;
  }
  if (from.picture) {
    next.z.segment<3>(kCloneIndex) = z.segment<3>(kPose);
    next.F.block<3, 3>(kCloneIndex, kPose).setIdentity();
    next.F.block<3, 3>(kCloneIndex, kCloneIndex).setZero();
  }
  next.deviation = deviations(to, wheels, noise);
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
