#include "edp/platform/supervision.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

/// @return the wheel before or behind, on the same side: FL and RL, FR and RR
constexpr std::size_t beside(std::size_t wheel) { return (wheel + 2) % kWheels; }
constexpr bool is_left(std::size_t wheel) { return wheel % 2 == 0; }

}  // namespace

/// A wheel in one iteration; "forwards" is the direction in which it is to turn.
struct WheelSupervision::Wheel {
  double rolls{};     // |speed| that the way wants of it [rad/s]
  double speed{};     // measured [rad/s]
  double torque{};    // [N m]
  double forwards{};  // torque forwards [N m]
  double other{};     // |speed| of the other one of its side [rad/s]
  double side{};      // rate of turn to its side beyond the way [rad/s]; nan: not known
  bool stands{};      // although it is to turn

  [[nodiscard]] bool pushed() const noexcept { return forwards > kTorque; }
};

WheelSupervision::Wheel WheelSupervision::seen(std::size_t k, const StageReading& stage,
                                               const PathPoint& wanted) const noexcept {
  const double b = is_left(k) ? -platform_->half_track : platform_->half_track;
  const double rolls = (wanted.v + wanted.w * b) / platform_->wheel_radius;
  Wheel wheel{.rolls = std::abs(rolls), .speed = stage.theta_dot[k], .torque = stage.torque[k]};
  wheel.forwards = std::copysign(1, rolls) * wheel.torque;
  const double turns = stage.imu_valid ? stage.yaw_rate : std::numeric_limits<double>::quiet_NaN();
  wheel.side = (is_left(k) ? 1 : -1) * std::copysign(1, rolls) * (turns - wanted.w);
  wheel.other = std::abs(stage.theta_dot[beside(k)]);
  wheel.stands = wheel.rolls > kTurns && std::abs(wheel.speed) < kStands;
  return wheel;
}

bool WheelSupervision::is_dragged(std::size_t k, const Wheel& wheel) noexcept {
  // A blocked wheel drags the platform to its side. A speed is measured over more than an iteration: what makes it stand happened
  // up to two before. Nothing is greater than a rate of turn that is not known.
  if (!wheel.stands)
    dragged_[k] = false;
  else if (!stood_[k])
    dragged_[k] = wheel.side - side_before_[1][k] > kDrags * 2 * kPlatformPeriod;
  stood_[k] = wheel.stands;
  side_before_[1][k] = std::exchange(side_before_[0][k], wheel.side);
  return dragged_[k];
}

// The speed of the other one is pushed up and let down while a tracker drives against a wheel that stands: no single iteration tells.
bool WheelSupervision::side_follows(std::size_t k, const Wheel& wheel) noexcept {
  follows_[k] = wheel.stands ? follows_[k] + (wheel.other >= kFollows * wheel.rolls ? 1 : -1) : 0;
  return follows_[k] > 0;
}

std::optional<Fault> WheelSupervision::stands_too_long(std::size_t k, const Wheel& wheel) noexcept {
  const bool dragged = is_dragged(k, wheel);
  const bool blocks = dragged || !side_follows(k, wheel);
  blocked_[k] = wheel.stands && wheel.pushed() ? blocked_[k] + 1 : 0;
  // A wheel that brakes may stand for a while: it slips.
  missed_[k] = wheel.stands && wheel.forwards >= 0 ? missed_[k] + wheel.rolls * kPlatformPeriod : 0;
  const bool missed = missed_[k] >= kMissed && (wheel.pushed() || !blocks);
  if (blocked_[k] < kBlocked && !missed) return {};
  const int axis = static_cast<int>(k);
  if (blocks)
    return make_fault(FaultCode::wheel_blocked, "torque [N m] of a wheel that stands", axis, wheel.torque,
                      kTorque);
  return make_fault(FaultCode::encoder_fault, "speed of a wheel that is to turn [rad/s]", axis, wheel.speed,
                    kTurns);
}

std::optional<Fault> WheelSupervision::contradicts(std::size_t k, const Wheel& wheel,
                                                   double estimated) noexcept {
  const double residual = wheel.speed - estimated;
  const bool beyond =
      !(std::abs(residual) <= kResidual) || std::abs(wheel.speed) > platform_->impossible_wheel_speed();
  const bool alone = wheel.stands && std::abs(wheel.torque) <= kTorque && wheel.other > kTurns;
  wrong_[k] = beyond || alone ? wrong_[k] + 1 : 0;
  if (wrong_[k] < kWrong) return {};
  const int axis = static_cast<int>(k);
  return beyond ? make_fault(FaultCode::encoder_fault, "speed beyond what is estimated [rad/s]", axis,
                             residual, kResidual)
                : make_fault(FaultCode::encoder_fault, "speed of a wheel that is to turn [rad/s]", axis,
                             wheel.speed, kTurns);
}

std::optional<Fault> WheelSupervision::step(const StageReading& stage, const PlatformEstimate& estimate,
                                            const PathPoint& wanted) noexcept {
  for (std::size_t k = 0; k < kWheels; ++k) {
    const Wheel wheel = seen(k, stage, wanted);
    if (const std::optional<Fault> fault = stands_too_long(k, wheel)) return fault;
    if (const std::optional<Fault> fault = contradicts(k, wheel, estimate.theta_dot[k])) return fault;
  }
  return {};
}

}  // namespace mrroc::edp
