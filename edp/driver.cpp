#include "edp/driver.hpp"

#include <algorithm>
#include <string>

#include "base/representation.hpp"
#include "edp/guard.hpp"
#include "edp/supervision.hpp"

namespace mrroc::edp {
namespace {

const DriverParameters& checked(const Robot& robot, const DriverParameters& p) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::bad_configuration, std::string("driver: ") + what);
  };
  demand(p.dt > 0 && p.dt <= 0.1, "dt must lie between 0 and 0.1 s");
  demand(p.n_s >= 1 && p.n_s <= kMaxSteps, "n_s must lie between 1 and 1000");
  demand(p.stop_steps >= 1 && p.stop_steps <= kMaxStopSteps, "stop_steps must lie between 1 and 40");
  demand(p.synchro_joints.size() == robot.axes(), "synchro_joints must have one number per axis");
  demand(p.synchro_joints.allFinite(), "synchro_joints must be finite");
  demand(is_proper(p.T_WE), "the tool must be a pose");
  demand(is_proper(p.force.T_WS), "the force sensor's place must be a pose");
  demand(p.force.average >= 1 && p.force.average <= 4, "the force average must lie between 1 and 4");
  demand(p.force.low_pass >= 0, "the corner of the force's low pass must not be negative");
  demand(p.force.patience >= 1, "the force patience must be at least 1");
  demand(p.force.stuck_after >= 0, "the number of equal forces must not be negative");
  return p;
}

std::array<double, 6> six(const Pose& T) {
  const Vector6 r = angle_axis_from_pose(T);
  return {r[0], r[1], r[2], r[3], r[4], r[5]};
}

}  // namespace

Driver::Driver(const Robot& robot, const DriverParameters& parameters)
    : robot_(&robot),
      p_(checked(robot, parameters)),
      encoders_(robot),
      force_(parameters.force, parameters.dt),
      generator_({&robot, parameters.limits, parameters.dt, parameters.stop_steps}, parameters.T_WE),
      servo_(robot, parameters.dt) {
  const AxisVector zero = AxisVector::Zero(robot.axes());
  measured_ = {zero, zero, zero, {}, {}, {}};
}

bool Driver::synchronised() const noexcept {
  return state_ != DriverState::not_synchronised && state_ != DriverState::homing;
}

bool Driver::at_rest() const noexcept {
  return state_ == DriverState::not_synchronised || state_ == DriverState::ready ||
         state_ == DriverState::holding;
}

HardwareCommand Driver::step(const HardwareReading& reading) noexcept {
  const bool stood = at_rest();  // the reading is of the time before this step
  if (reply_due_) sample_count_ = 0;
  reply_due_ = false;
  if (at_boundary()) begin_macrostep(reading);
  ++iota_;
  measure(reading);
  adjust_force(reading, stood);
  add_sample();
  if (iota_ == n_Q_) answer(reading);
  move();

  HardwareCommand command{};
  command.step = reading.step;
  command.commanded_until = commanded_until_;
  held_steps_ = state_ == DriverState::holding ? held_steps_ + 1 : 0;
  command.enabled = synchronised() && state_ != DriverState::faulted && held_steps_ <= kBrakesCloseAfter;
  if (command.enabled) {
    const SetPoint& set = generator_.set_point();
    command.pwm = servo_.step(set.motor_increment, measured_.increment, robot_->gravity(set.axes.joints));
  } else {
    servo_.braked(measured_.increment);
  }
  if (iota_ == n_) end_macrostep();
  ++steps_done_;
  return command;
}

void Driver::begin_macrostep(const HardwareReading& reading) noexcept {
  if (arm_commanded_) {
    state_ = DriverState::executing;
    commanded_until_ = reading.step + n_;
    return;
  }
  n_ = p_.n_s;
  n_Q_ = std::max(1, p_.n_s - 1);
  if (state_ == DriverState::executing) {
    generator_.stop();
    state_ = DriverState::decelerating;
  }
}

void Driver::end_macrostep() noexcept {
  iota_ = 0;
  taken_ = false;
  arm_commanded_ = false;
  answer_ = {};
  const bool over = state_ != DriverState::faulted && generator_.motion() == StepGenerator::Motion::standing;
  if (fault_ && fault_told_ && over) fault_ = {};
}

void Driver::measure(const HardwareReading& reading) noexcept {
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, reading.step - last_step_));
  for (int k = 0; k < robot_->axes(); ++k)
    measured_.increment[k] = steps_done_ > 0 ? Encoders::difference(reading, last_encoder_, k) : 0;
  last_encoder_ = reading.encoder;
  last_step_ = reading.step;

  if (synchro_pending_) {
    const AxisVector motors = robot_->motors_from_joints(p_.synchro_joints);
    encoders_.synchronise(reading, motors);
    hold_at(motors);
    synchro_pending_ = false;
  }
  if (!synchronised()) return;
  measured_.motors = encoders_.motors(reading);
  measured_.joints = robot_->joints_from_motors(measured_.motors);
  measured_.T_0W = robot_->forward(measured_.joints);
  measured_.T_0E = measured_.T_0W * generator_.tool();
  if (reset_pending_) {
    fault_ = {};
    hold_at(measured_.motors);
    reset_pending_ = false;
  }
  if (state_ == DriverState::faulted) return;
  const DriveObservation drives{generator_.set_point().axes.motors, measured_.motors, measured_.increment,
                                steps * p_.dt};
  if (const std::optional<Fault> wrong = supervise_drives(*robot_, p_.supervision, reading, drives))
    trip(*wrong);
}

void Driver::hold_at(const AxisVector& motors) noexcept {
  generator_.stand_at(motors);
  servo_.reset();
  state_ = DriverState::ready;
}

void Driver::adjust_force(const HardwareReading& reading, bool stood) noexcept {
  const ForceSensor::Health health = force_.take(reading.S_F_m, stood);
  if (!synchronised()) return;
  if (state_ != DriverState::faulted)
    if (const std::optional<Fault> wrong = sensor_fault(health, force_.complaint())) trip(*wrong);
  if (bias_pending_) force_.bias(measured_.T_0W.R);
  bias_pending_ = false;
  // 0_W F_a and back to W with the orientation of the same reading is the identity: xi_F alone leads to E.
  measured_.F_a = xi_F(generator_.tool().inverse(), force_.adjusted(measured_.T_0W.R));
}

void Driver::move() noexcept {
  if (state_ != DriverState::executing && state_ != DriverState::decelerating) return;
  if (const std::optional<Fault> wrong = generator_.step(measured_.F_a)) {
    state_ = DriverState::decelerating;
    fail(*wrong);
  }
  if (state_ == DriverState::decelerating && generator_.motion() == StepGenerator::Motion::standing)
    state_ = DriverState::holding;
}

void Driver::trip(const Fault& fault) noexcept {
  state_ = DriverState::faulted;
  fail(fault);
}

void Driver::fail(const Fault& fault) noexcept {
  fault_ = fault;
  fault_told_ = false;
  if (answer_.verdict == Verdict::executed) {
    answer_.verdict = Verdict::failed;
    answer_.fault = fault;
  }
}

void Driver::add_sample() noexcept {
  if (sample_count_ == samples_.size()) {
    std::move(samples_.begin() + 1, samples_.end(), samples_.begin());
    --sample_count_;
  }
  samples_[sample_count_++] = {six(measured_.T_0E), measured_.F_a};
}

void Driver::answer(const HardwareReading& reading) noexcept {
  reply_due_ = true;
  if (answer_.replay) {
    reply_ = protocol_.stored();
    return;
  }
  reply_ = {};
  reply_.session = answer_.verdict == Verdict::none ? protocol_.owner().value_or(0) : answer_.session;
  reply_.number = answer_.number;
  reply_.step = reading.step;
  reply_.expected = protocol_.expected();
  reply_.verdict = answer_.verdict;
  reply_.fault = answer_.verdict == Verdict::none ? fault_ : answer_.fault;
  if (reply_.fault.code == fault_.code) fault_told_ = true;
  reply_.state = state_;
  reply_.representation = answer_.representation;
  const SetPoint& set = generator_.set_point();
  const bool wants_set = answer_.feedback == Feedback::set_value;
  switch (answer_.representation) {
    case Representation::motors:
      reply_.pose = numbers_from_axes(wants_set ? set.axes.motors : measured_.motors);
      break;
    case Representation::joints:
      reply_.pose = numbers_from_axes(wants_set ? set.axes.joints : measured_.joints);
      break;
    case Representation::frame:
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis:
      reply_.pose = numbers_from_pose(answer_.representation, wants_set ? set.T_0E : measured_.T_0E);
      break;
  }
  reply_.T_0E = samples_[sample_count_ - 1].T_0E;
  reply_.F_a = measured_.F_a;
  std::copy_n(measured_.joints.data(), measured_.joints.size(), reply_.joints.begin());
  std::copy_n(measured_.motors.data(), measured_.motors.size(), reply_.motors.begin());
  if (answer_.store) protocol_.store(reply_);
}

}  // namespace mrroc::edp
