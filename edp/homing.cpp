#include "edp/homing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// The edge of the switch lies at most so far back after the arm has come to rest on it [rad]: way of the
/// ramp, following error and play.
constexpr double kRelease = 2 * kTurn;
/// Every turn has a zero mark; a little more than a turn, because the shaft follows late [rad].
constexpr double kIndex = 1.25 * kTurn;
/// Readings until two in succession are of this axis.
constexpr int kFilter = 2;

bool is_set(std::uint8_t switches, AxisSwitch which) {
  return (switches & static_cast<unsigned>(which)) != 0;
}

}  // namespace

Homing::Homing(const Robot& robot, const HomingParameters& parameters, double dt) noexcept
    : robot_(&robot), p_(parameters), dt_(dt), increment_(AxisVector::Zero(robot.axes())), way_(increment_) {}

void Homing::start() noexcept {
  axes_done_ = axes_back_ = 0;
  speed_ = 0;
  way_.setZero();
  enter(Phase::begin);
}

std::optional<Fault> Homing::step(const HardwareReading& reading) noexcept {
  const std::uint8_t switches = reading.switches[static_cast<std::size_t>(axis())];
  const bool sample = is_set(switches, AxisSwitch::synchro);
  if (sample == last_sample_) pressed_ = sample;
  last_sample_ = sample;
  increment_.setZero();
  if (is_set(switches, AxisSwitch::lower_limit) || is_set(switches, AxisSwitch::upper_limit))
    return fault(
        phase_ == Phase::search ? FaultCode::synchro_switch_missing : FaultCode::synchro_switch_stuck,
        range());
  ++steps_;
  if (phase_ == Phase::back) {
    go_back();
    return {};
  }
  if (std::optional<Fault> wrong = move(reading)) return wrong;
  increment_[axis()] = speed_ * dt_;
  way_[axis()] += increment_[axis()];
  travelled_ += std::abs(increment_[axis()]);
  if (phase_ == Phase::settle && steps_ >= p_.settle_steps && speed_ == 0) end_axis();
  return {};
}

std::optional<Fault> Homing::move(const HardwareReading& reading) noexcept {
  const AxisHoming& speed = p_.axis[static_cast<std::size_t>(axis())];
  switch (phase_) {
    case Phase::begin:
      if (steps_ > kFilter) enter(pressed_ ? Phase::leave : Phase::search);
      return {};
    case Phase::leave:
      if (travelled_ > range()) return fault(FaultCode::synchro_switch_stuck, range());
      approach(speed.coarse);
      if (!pressed_) enter(Phase::search);
      return {};
    case Phase::search:
      if (travelled_ > range()) return fault(FaultCode::synchro_switch_missing, range());
      approach(-speed.coarse);
      if (pressed_) enter(Phase::stand);
      return {};
    case Phase::stand:
      approach(0);
      if (steps_ < p_.ramp_steps + p_.standstill_steps) return {};
      if (!pressed_) return fault(FaultCode::synchro_switch_missing, kRelease);
      enter(Phase::release);
      return {};
    case Phase::release:
      if (travelled_ > kRelease) return fault(FaultCode::synchro_switch_stuck, kRelease);
      approach(speed.fine);
      if (!pressed_) enter(Phase::index);
      return {};
    case Phase::index:
      if (travelled_ > kIndex) return fault(FaultCode::encoder_index_missing, kIndex);
      approach(speed.fine);
      if (!is_set(reading.switches[static_cast<std::size_t>(axis())], AxisSwitch::index)) return {};
      count_[static_cast<std::size_t>(axis())] = reading.index[static_cast<std::size_t>(axis())];
      enter(Phase::settle);
      return {};
    case Phase::settle:
      approach(0);
      return {};
    case Phase::back:
      break;
  }
  return {};
}

void Homing::end_axis() noexcept {
  ++axes_done_;
  enter(found() ? Phase::back : Phase::begin);
}

/// At the largest speed, up to the coarse one, from which the ramp still ends where the axis stood.
void Homing::go_back() noexcept {
  const int k = axis();
  if (way_[k] == 0) {  // the last increment is of the step before
    speed_ = 0;
    ++axes_back_;
    return;
  }
  const double coarse = p_.axis[static_cast<std::size_t>(k)].coarse;
  const double change = coarse / p_.ramp_steps;
  const double left = std::abs(way_[k]);
  approach(std::min(coarse, change * (std::sqrt(0.25 + 2 * left / (change * dt_)) - 0.5)));
  increment_[k] = -std::copysign(std::min(speed_ * dt_, left), way_[k]);
  way_[k] += increment_[k];
}

double Homing::range() const noexcept {
  const Range& legal = robot_->axis(axis()).motor;
  return legal.upper - legal.lower;
}

void Homing::enter(Phase phase) noexcept {
  phase_ = phase;
  steps_ = 0;
  travelled_ = 0;
}

void Homing::approach(double speed) noexcept {
  const double most = std::abs(p_.axis[static_cast<std::size_t>(axis())].coarse) / p_.ramp_steps;
  speed_ += std::clamp(speed - speed_, -most, most);
}

Fault Homing::fault(FaultCode code, double limit) const noexcept {
  return make_fault(code, robot_->axis(axis()).name, axis(), travelled_, limit);
}

}  // namespace mrroc::edp
