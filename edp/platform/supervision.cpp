#include "edp/platform/supervision.hpp"

#include <cmath>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

/// @return the wheel before or behind, on the same side: FL and RL, FR and RR
constexpr std::size_t beside(std::size_t wheel) { return (wheel + 2) % kWheels; }
constexpr bool is_left(std::size_t wheel) { return wheel % 2 == 0; }

}  // namespace

std::optional<Fault> WheelSupervision::step(const StageReading& stage, const PlatformEstimate& estimate,
                                            const PathPoint& wanted) noexcept {
  for (std::size_t k = 0; k < kWheels; ++k) {
    const int axis = static_cast<int>(k);
    const double speed = stage.theta_dot[k];
    const double b = is_left(k) ? -platform_->half_track : platform_->half_track;
    const bool is_to_turn = std::abs(wanted.v + wanted.w * b) > kTurns * platform_->wheel_radius;
    const bool stands = is_to_turn && std::abs(speed) < kStands;
    const bool pushed = std::abs(stage.torque[k]) > kTorque;
    const bool other_turns = std::abs(stage.theta_dot[beside(k)]) > kTurns;
    const double residual = speed - estimate.theta_dot[k];
    const bool contradicts =
        !(std::abs(residual) <= kResidual) || std::abs(speed) > kOverSpeed * platform_->max_wheel_speed;
    blocked_[k] = stands && pushed ? blocked_[k] + 1 : 0;
    wrong_[k] = contradicts || (stands && !pushed && other_turns) ? wrong_[k] + 1 : 0;
    if (blocked_[k] >= kBlocked)
      return make_fault(FaultCode::wheel_blocked, "torque [N m] of a wheel that stands", axis,
                        stage.torque[k], kTorque);
    if (wrong_[k] < kWrong) continue;
    if (contradicts)
      return make_fault(FaultCode::encoder_fault, "speed beyond what is estimated [rad/s]", axis, residual,
                        kResidual);
    return make_fault(FaultCode::encoder_fault, "speed of a wheel that is to turn [rad/s]", axis, speed,
                      kTurns);
  }
  return {};
}

}  // namespace mrroc::edp
