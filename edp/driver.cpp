#include "edp/driver.hpp"

#include <algorithm>
#include <string>

#include "edp/guard.hpp"
#include "edp/supervision.hpp"

namespace mrroc::edp {
namespace {

/// Rise of the share of the gravity feed-forward in a step once homing has found the positions: no jolt.
constexpr double kGravityFeedForwardRise = 0.01;

const DriverParameters& checked(const Robot& robot, const DriverParameters& p) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::bad_configuration, std::string("driver: ") + what);
  };
  demand(p.dt > 0 && p.dt <= 0.1, "dt must lie between 0 and 0.1 s");
  demand(p.n_s >= 1 && p.n_s <= kMaxSteps, "n_s must lie between 1 and 1000");
  demand(p.stop_steps >= 1 && p.stop_steps <= kMaxStopSteps, "stop_steps must lie between 1 and 40");
  if (p.synchronisation == Synchronisation::known_pose) {
    demand(p.synchro_joints.size() == robot.axes(), "synchro_joints must have one number per axis");
    demand(p.synchro_joints.allFinite(), "synchro_joints must be finite");
  }
  demand(p.homing.first_axis >= 0 && p.homing.first_axis < robot.axes(), "homing must begin with an axis");
  demand(p.homing.ramp_steps >= 1 && p.homing.standstill_steps >= 0 && p.homing.settle_steps >= 0,
         "the steps of homing must not be negative, and its ramp has at least one");
  for (const AxisHoming& axis : p.homing.axis)
    demand(axis.coarse > 0 && axis.fine > 0, "the speeds of homing must be positive");
  demand(is_proper(p.T_WE), "the tool must be a pose");
  demand(is_proper(p.force.T_WS), "the force sensor's place must be a pose");
  demand(p.force.average >= 1 && p.force.average <= 4, "the force average must lie between 1 and 4");
  demand(p.force.low_pass >= 0, "the corner of the force's low pass must not be negative");
  demand(!p.servo || Servo::known(p.servo->algorithm_no, p.servo->parameter_set_no),
         "there is no such servo algorithm or parameter set");
  demand(p.force.fault_after >= 1, "the number of bad forces must be at least 1");
  demand(is_usable(p.oscillation), "the bounds of an unstable contact must be positive, and in order");
  demand(p.supervision.torque_steps >= 1, "the steps of full torque must be at least 1");
  demand(p.force.stuck_after >= 0, "the number of equal forces must not be negative");
  return p;
}

}  // namespace

Driver::Driver(const Robot& robot, const DriverParameters& parameters)
    : robot_(&robot),
      p_(checked(robot, parameters)),
      encoders_(robot),
      force_(parameters.force, parameters.dt),
      generator_({&robot, parameters.limits, parameters.dt, parameters.stop_steps}, parameters.T_WE),
      oscillation_(parameters.oscillation, parameters.dt),
      softening_(parameters.oscillation, parameters.dt),
      servo_(robot, parameters.dt),
      homing_(robot, parameters.homing, parameters.dt),
      torque_(parameters.supervision.torque_steps) {
  const AxisVector zero = AxisVector::Zero(robot.axes());
  measured_ = {zero, zero, p_.dt, {}, {}, {}};
  if (p_.gripper) {
    if (robot.axes() >= kMaxAxes)
      throw FaultError(FaultCode::bad_configuration, "driver: there is no room for the motor of the jaws");
    gripper_.emplace(*p_.gripper, p_.dt);
  }
  generator_.set_position_known(false);
  model_.kinematic_model = static_cast<std::uint16_t>(robot.model());
  model_.weight = p_.force.weight;
  std::copy_n(p_.force.mass_centre.data(), 3, model_.mass_centre.begin());
  for (int k = 0; parameters.servo && k < robot.axes(); ++k)
    servo_.select(k, parameters.servo->algorithm_no, parameters.servo->parameter_set_no);
}

bool Driver::stands() const noexcept {
  return state_ == DriverState::not_synchronised || state_ == DriverState::ready ||
         state_ == DriverState::holding;
}

HardwareCommand Driver::step(const HardwareReading& reading) noexcept {
  const bool stood = stands();  // the reading is of the time before this step
  if (at_boundary()) begin_macrostep(reading);
  ++iota_;
  reply_builder_.begin_step(reading);
  measure(reading);
  watch_standstill();
  supervise(reading);
  adjust_force(reading, stood);
  reply_builder_.add(measured_.T_0E, measured_.F_a);
  if (iota_ == n_Q_) answer(reading);
  move(reading);
  if (reply_builder_.due()) reply_builder_.complete(view(), answer_, protocol_);
  const HardwareCommand command = drive(reading);
  if (iota_ == n_) end_macrostep();
  ++steps_done_;
  return command;
}

DriverView Driver::view() const noexcept {
  return {.robot = *robot_,
          .generator = generator_,
          .servo = servo_,
          .gripper = gripper_ ? &*gripper_ : nullptr,
          .model = model_,
          .motors = measured_.motors,
          .state = state_,
          .fault = fault_,
          .position_known = position_known_,
          .at_rest = standstill_.at_rest()};
}

void Driver::answer(const HardwareReading& reading) noexcept {
  reply_builder_.build(view(), answer_, protocol_, reading);
  if (!answer_.replay && reply_builder_.reply().fault.code == fault_.code) fault_told_ = true;
}

void Driver::watch_standstill() noexcept {
  const bool set_point_stands =
      state_ != DriverState::homing && generator_.phase() == StepGenerator::MotionPhase::standing;
  standstill_.step(last_step_, measured_.increment, commanded_until_, braked() || set_point_stands);
}

HardwareCommand Driver::drive(const HardwareReading& reading) noexcept {
  if (state_ == DriverState::holding || state_ == DriverState::not_synchronised)
    held_steps_ = std::min(held_steps_ + 1, kSettleAtGoal + 1);
  else if (state_ != DriverState::faulted)
    held_steps_ = 0;
  HardwareCommand command{};
  command.step = reading.step;
  command.outputs = outputs_;
  command.enabled = !braked();
  if (command.enabled) {
    command.pwm =
        servo_.step(generator_.set_point().motor_increment, measured_.increment, gravity_feed_forward());
  } else {
    servo_.braked(measured_.increment);
  }
  drive_jaws(command);
  return command;
}

void Driver::drive_jaws(HardwareCommand& command) noexcept {
  if (!gripper_) return;
  command.jaws_enabled = state_ != DriverState::faulted && (gripper_->known() || gripper_->homing());
  if (command.jaws_enabled)
    command.pwm[static_cast<std::size_t>(robot_->axes())] = gripper_->step();
  else
    gripper_->braked();
}

AxisVector Driver::gravity_feed_forward() noexcept {
  if (!position_known_) return AxisVector::Zero(robot_->axes());
  gravity_feed_forward_share_ = std::min(1., gravity_feed_forward_share_ + kGravityFeedForwardRise);
  return gravity_feed_forward_share_ * robot_->gravity(generator_.set_point().axes.motors);
}

void Driver::begin_macrostep(const HardwareReading& reading) noexcept {
  if (motion_event_) {
    fire(*motion_event_);
    commanded_until_ = reading.step + n_;
    return;
  }
  n_ = p_.n_s;
  n_Q_ = std::max(1, p_.n_s - 1);
  if (!protocol_.owner()) fire(Event::abandoned);
  if (state_ == DriverState::executing || state_ == DriverState::jogging) {
    // A motor that leaves its limit switch must not return towards it.
    leaving_ != 0 ? generator_.stop() : generator_.finish();
  }
  fire(Event::silence);
}

void Driver::end_macrostep() noexcept {
  iota_ = 0;
  taken_ = false;
  motion_event_.reset();
  answer_ = {};
  const bool over =
      state_ != DriverState::faulted && generator_.phase() == StepGenerator::MotionPhase::standing;
  if (fault_ && fault_told_ && over) fault_ = {};
}

void Driver::measure(const HardwareReading& reading) noexcept {
  if (steps_done_ == 0) {
    encoders_.synchronise(reading, AxisVector::Zero(robot_->axes()));
    last_encoder_ = reading.encoder;
  }
  const int axes = robot_->axes();
  for (int k = 0; k < axes; ++k) measured_.increment[k] = Encoders::difference(reading, last_encoder_, k);
  measured_.time = static_cast<double>(std::max<std::int64_t>(1, reading.step - last_step_)) * p_.dt;
  last_encoder_ = reading.encoder;
  last_step_ = reading.step;

  if (state_ == DriverState::homing) home(reading);
  measured_.motors = encoders_.motors(reading);
  leaving_ &= at_limit_switch(reading);
  if (reset_pending_) {
    leaving_ = at_limit_switch(reading);
    reset();
  }
  if (!position_known_) return;
  measured_.T_0W = robot_->forward_from_motors(measured_.motors);
  measured_.T_0E = measured_.T_0W * generator_.tool();
}

void Driver::home(const HardwareReading& reading) noexcept {
  if (p_.synchronisation == Synchronisation::known_pose) {
    const AxisVector motors = robot_->motors_from_joints(p_.synchro_joints);
    encoders_.synchronise(reading, motors);
    set_position_known();
    generator_.stand_at(motors);
    gravity_feed_forward_share_ = 1;  // the brakes have held the arm until now
    believe_jaws(reading);
    return;
  }
  if (!homing_.done())
    if (const std::optional<Fault> wrong = homing_.step(reading)) return trip(*wrong);
  if (!homing_.done() || !home_jaws(reading)) return;
  // The regulators go on without a jolt: the set point keeps its distance from the shafts.
  const AxisVector lag = generator_.set_point().axes.motors - encoders_.motors(reading);
  for (int k = 0; k < robot_->axes(); ++k)
    encoders_.set_zero(k, homing_.count(k), p_.homing.axis[static_cast<std::size_t>(k)].position);
  set_position_known();
  generator_.stand_at(encoders_.motors(reading) + lag);
}

void Driver::believe_jaws(const HardwareReading& reading) noexcept {
  if (gripper_) gripper_->believe(p_.jaws, reading.encoder[static_cast<std::size_t>(robot_->axes())]);
}

bool Driver::home_jaws(const HardwareReading& reading) noexcept {
  if (p_.jaws_known) believe_jaws(reading);
  if (!gripper_ || gripper_->known()) return true;
  if (!gripper_->homing()) gripper_->start_homing();
  return false;
}

void Driver::set_position_known() noexcept {
  position_known_ = true;
  generator_.set_position_known(true);
  fire(Event::homed);
}

void Driver::reset() noexcept {
  fault_ = {};
  stand_where_measured();
  fire(position_known_ ? Event::reset : Event::reset_unknown);
  reset_pending_ = false;
}

void Driver::stand_where_measured() noexcept {
  generator_.stand_at(measured_.motors);
  servo_.reset();
}

void Driver::supervise(const HardwareReading& reading) noexcept {
  if (gripper_) {
    const auto jaws = static_cast<std::size_t>(robot_->axes());
    const std::optional<Fault> wrong = gripper_->measure(reading.encoder[jaws], reading.current[jaws]);
    if (wrong && state_ != DriverState::faulted) trip(*wrong);
  }
  if (state_ == DriverState::faulted || (!position_known_ && braked())) return;
  const SetPoint& set = generator_.set_point();
  const DriveObservation drives{set.axes.motors, measured_.motors,    measured_.increment,
                                measured_.time,  set.motor_increment, leaving_};
  if (const std::optional<Fault> wrong = supervise_drives(*robot_, p_.supervision, reading, drives))
    trip(*wrong);
}

void Driver::adjust_force(const HardwareReading& reading, bool stood) noexcept {
  const ForceSensor::Health health = force_.take(reading.S_F_m, stood);
  if (!position_known_ && braked()) return;
  if (state_ != DriverState::faulted)
    if (const std::optional<Fault> wrong = sensor_fault(health, force_.diagnostic())) trip(*wrong);
  if (!position_known_) return;
  if (bias_pending_) force_.bias(measured_.T_0W.R);
  bias_pending_ = false;
  // 0_W F_a and back to W with the orientation of the same reading is the identity: xi_F alone leads to E.
  measured_.F_a = xi_F(generator_.tool_inverse(), force_.adjusted(measured_.T_0W.R));
}

std::optional<Fault> Driver::relieve(const HardwareReading& reading) noexcept {
  if (!moves()) {
    torque_.forget();
    return {};
  }
  std::optional<Fault> heavy =
      torque_.step(*robot_, reading, servo_.at_limit(), measured_.increment, measured_.time);
  if (heavy) stand_where_measured();
  return heavy;
}

void Driver::move(const HardwareReading& reading) noexcept {
  if (const std::optional<Fault> heavy = relieve(reading)) {
    fire(Event::failed);
    fail(*heavy);
  }
  const AxisSet watched = state_ == DriverState::executing ? force_axes_ : AxisSet();
  oscillation_.forget(softening_.step(measured_.F_a, watched));
  generator_.set_mobility_shares(softening_.shares());
  if (const std::optional<Fault> swings = oscillation_.step(measured_.F_a, watched)) {
    generator_.stop();
    fire(Event::failed);
    fail(with_law(*swings, rows_));
  }
  if (state_ == DriverState::homing) return generator_.shift(homing_.increment());
  if (!moves()) return;
  if (const std::optional<Fault> wrong = generator_.step(measured_.F_a)) {
    fire(Event::failed);
    fail(*wrong);
  }
  if (state_ != DriverState::executing && generator_.phase() == StepGenerator::MotionPhase::standing)
    fire(Event::stood);
}

void Driver::trip(const Fault& fault) noexcept {
  fire(Event::trip);
  held_steps_ = kSettleAtGoal + 1;
  fail(fault);
}

void Driver::drop_owner() noexcept {
  protocol_.drop_owner();
  if (moves()) generator_.stop();
}

void Driver::fail(const Fault& fault) noexcept {
  fault_ = fault;
  fault_told_ = false;
  if (answer_.verdict == Verdict::executed) {
    answer_.verdict = Verdict::failed;
    answer_.fault = fault;
  }
}

}  // namespace mrroc::edp
