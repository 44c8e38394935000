#include "edp/loopback_hardware.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrroc::edp {
namespace {

constexpr int kSubsteps = 4;          // of a step
constexpr double kSwitchPlace = -3;   // the synchronisation switch is pressed below [rad]
constexpr double kForceNoise = 0.02;  // of the force sensor [N], [N m]
constexpr double kBraking = 0.8;      // share of the speed that a closed brake takes in a substep
constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

LoopbackPlant::LoopbackPlant(const Robot& robot, const AxisVector& motors, double dt)
    : robot_(&robot),
      dt_(dt),
      start_(motors),
      motors_(motors),
      speed_(AxisVector::Zero(motors.size())),
      deflection_(AxisVector::Zero(motors.size())) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  free_.fill({-kNowhere, kNowhere});
  for (int k = 0; k < robot.axes(); ++k) read_switches(k, motors_[k]);
  read();
}

void LoopbackPlant::step(const HardwareCommand* command) {
  silent_ = command ? 0 : silent_ + 1;
  if (command) command_ = *command;
  if (silent_ > kCommandTimeout) command_.enabled = command_.jaws_enabled = false;
  const AxisVector holding = robot_->gravity(motors_);
  for (int k = 0; k < robot_->axes(); ++k) {
    const double before = motors_[k];
    reading_.current[static_cast<std::size_t>(k)] = 0;
    limited_[static_cast<std::size_t>(k)] = false;
    for (int substep = 0; substep < kSubsteps; ++substep)
      turn(k, command_.pwm[static_cast<std::size_t>(k)], holding[k]);
    read_switches(k, before);
  }
  reading_.inputs = command_.outputs;
  ++reading_.step;
  read();
}

void LoopbackPlant::turn(int motor, double pwm, double load) {
  const DriveModel& drive = robot_->axis(motor).servo.drive;
  const double h = dt_ / kSubsteps;
  double& speed = speed_[motor];
  if (command_.enabled) {
    const double voltage = drive.supply * std::clamp(pwm, -kPwmScale, kPwmScale) / kPwmScale;
    double& deflection = deflection_[motor];  // friction after Dahl, as a spring that yields
    deflection = (deflection + h * speed) / (1 + h * std::abs(speed) / drive.presliding);
    const double friction = drive.friction * deflection / drive.presliding;
    const double K = drive.torque_constant;
    const double before = speed;
    // Implicit in the induced voltage, which would make small motors unstable.
    speed = (before + h / drive.inertia * (K * voltage / drive.resistance - friction - load)) /
            (1 + h * K * K / (drive.resistance * drive.inertia));
    double current = (voltage - K * speed) / drive.resistance;
    if (std::abs(current) > drive.current_limit) {
      current = std::copysign(drive.current_limit, current);
      speed = before + h / drive.inertia * (K * current - friction - load);
      limited_[static_cast<std::size_t>(motor)] = true;
    }
    reading_.current[static_cast<std::size_t>(motor)] += current / kSubsteps;
  } else {
    speed *= 1 - kBraking;
  }
  const double to = motors_[motor] + h * speed;
  const Range& free = free_[static_cast<std::size_t>(motor)];
  motors_[motor] = std::clamp(to, free.lower, free.upper);
  if (!free.contains(to)) speed = 0;
}

void LoopbackPlant::read_switches(int motor, double before) {
  const double now = motors_[motor];
  const auto k = static_cast<std::size_t>(motor);
  const AxisProperties& axis = robot_->axis(motor);
  unsigned bits = 0;
  const auto press = [&](AxisSwitch which, bool pressed) {
    bits |= pressed ? static_cast<unsigned>(which) : 0;
  };
  press(AxisSwitch::lower_limit, now < axis.motor.lower);
  press(AxisSwitch::upper_limit, now > axis.motor.upper);
  press(AxisSwitch::synchro, now < kSwitchPlace);
  press(AxisSwitch::current_limited, limited_[k]);
  if (std::floor(now / kTurn) != std::floor(before / kTurn)) {
    press(AxisSwitch::index, true);
    const double mark = kTurn * std::max(std::floor(now / kTurn), std::floor(before / kTurn));
    reading_.index[k] =
        static_cast<std::int32_t>(std::lround((mark - start_[motor]) * axis.increments_per_rad));
  }
  reading_.switches[k] = static_cast<std::uint8_t>(bits);
}

void LoopbackPlant::read() {
  for (int k = 0; k < robot_->axes(); ++k)
    reading_.encoder[static_cast<std::size_t>(k)] =
        static_cast<std::int32_t>(std::lround((motors_[k] - start_[k]) * robot_->axis(k).increments_per_rad));
  for (double& component : reading_.S_F_m.v) {
    noise_ = noise_ * 6364136223846793005U + 1442695040888963407U;
    component = kForceNoise * (static_cast<double>(noise_ >> 11U) * 0x1p-52 - 1);
  }
}

LoopbackHardware::LoopbackHardware(LoopbackPlant plant, double dt, bool wall) : plant_(std::move(plant)) {
  if (wall) clock_.emplace(dt);
}

ReadResult LoopbackHardware::read(std::int64_t step) {
  const std::int64_t now = clock_ ? clock_->await(step) : step;
  while (plant_.reading().step < now) plant_.step(nullptr);
  return {ReadStatus::reading, plant_.reading()};
}

void LoopbackHardware::write(const HardwareCommand& command) {
  plant_.step(&command);
  if (clock_) clock_->end(std::chrono::steady_clock::now());
}

}  // namespace mrroc::edp
