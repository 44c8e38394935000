#include "edp/platform/driver.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "edp/guard.hpp"
#include "edp/platform/failing_tracker.hpp"

namespace mrroc::edp {
namespace {

// Steps of the macrostep, from 1.
constexpr int kEstimates = 1;
constexpr int kFollows = 2;
constexpr int kTorques = 3;
constexpr int kReplies = 9;

void demand(bool good, const std::string& what) {
  if (!good) throw FaultError(FaultCode::bad_configuration, "driver of the platform: " + what);
}

/// @return what was asked for, or the first; it is one that there is
std::string_view chosen(std::span<const std::string_view> kinds, const std::string& asked, const char* what) {
  demand(!kinds.empty(), std::string("it has no ") + what);
  if (asked.empty()) return kinds.front();
  const auto found = std::ranges::find(kinds, asked);
  std::string all;
  for (const std::string_view kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kind);
  demand(found != kinds.end(), std::string("there is no ") + what + " '" + asked + "', but " + all);
  return *found;
}

const PlatformProperties& checked(const PlatformProperties& q) {
  demand(q.wheel_radius > 0 && q.half_track >= 0,
         "wheel_radius must be positive, and half_track not negative");
  demand(q.increments_per_turn > 0, "increments_per_turn must be positive");
  demand(q.max_torque > 0 && q.max_wheel_speed > 0 && q.brake >= 0,
         "max_torque and max_wheel_speed must be positive, and brake not negative");
  demand(q.braking_torque >= 0 && q.braking_torque <= q.max_torque,
         "braking_torque must not be negative, and at most max_torque");
  demand(q.max_speed > 0 && q.max_turn_rate > 0 && q.max_lateral_acceleration > 0,
         "max_speed, max_turn_rate and max_lateral_acceleration must be positive");
  demand(q.horizon_period > 0, "horizon_period must be positive");
  return q;
}

const PlatformDriverParameters& checked(const PlatformDriverParameters& p) {
  demand(p.synchro_rest >= 0.1 && p.synchro_rest <= 60, "synchro_rest must lie between 0.1 and 60 s");
  demand(p.synchro_timeout > p.synchro_rest && p.synchro_timeout <= 600,
         "synchro_timeout must be longer than synchro_rest, and at most 600 s");
  demand(p.silence >= 1, "silence must be at least 1 macrostep");
  demand(p.brake_after >= 1, "brake_after must be at least 1 macrostep");
  demand(p.start_guard_steps >= 0, "start_guard_steps must not be negative");
  demand(p.nominal.mu_x > 0 && p.nominal.mu_x <= 2 && p.nominal.mu_y > 0 && p.nominal.mu_y <= 2,
         "the nominal friction must be positive, and at most 2");
  demand(std::abs(p.nominal.split) < 1, "the nominal split must lie between -1 and 1");
  return p;
}

std::unique_ptr<Tracker> tracker(const Platform& platform, const PlatformDriverParameters& parameters) {
  auto tracker = platform.tracker(chosen(platform.trackers(), parameters.tracker, "tracker"));
  if (parameters.solver_fails.to == 0) return tracker;
  return std::make_unique<FailingTracker>(std::move(tracker), parameters.solver_fails);
}

}  // namespace

PlatformDriver::PlatformDriver(const Platform& platform, const PlatformDriverParameters& parameters)
    : platform_(&checked(platform.properties())),
      p_(checked(parameters)),
      sensors_(*platform_, kStep),
      synchronisation_(parameters, kStep),
      observer_(platform.estimator(chosen(platform.estimators(), parameters.estimator, "estimator")),
                parameters),
      follower_(tracker(platform, parameters), *platform_),
      supervision_(*platform_),
      wheel_brake_(*platform_, kStep) {}

PlatformDrive PlatformDriver::step(const PlatformReading& reading) noexcept {
  if (at_boundary()) begin_macrostep(reading);
  ++iota_;
  reply_due_ = false;
  measure(reading);
  if (iota_ == kEstimates) {
    if (state_ == DriverState::homing && !begun_)
      locate();
    else if (begun_)
      estimate_state();
  }
  if (iota_ == kFollows && position_known_) follow();
  if (iota_ == kTorques) {
    enabled_ = followed_;
    torque_ = followed_ ? follower_.torque() : PerWheel{};
  }
  brake();
  if (iota_ == kReplies) answer();
  const PlatformDrive command = drive();
  sensors_.command(command);
  if (iota_ == kPlatformSteps) end_macrostep();
  ++steps_done_;
  return command;
}

void PlatformDriver::begin_macrostep(const PlatformReading& reading) noexcept {
  if (reset_pending_) reset();
  hear_silence();
  if (!protocol_.owner()) {
    fire(PlatformEvent::abandoned);
    begun_ = position_known_;
    stopped_ = true;
  }
  if (state_ == DriverState::executing && queue_.empty()) {
    fire(PlatformEvent::arrived);
    hold(false);
  }
  if (state_ == DriverState::decelerating) {
    pace_.go_to(0, Pace::rate(queue_.at(0).v, Pace::kStop));
    if (queue_.empty() || pace_.now() == 0) {
      queue_.drop();
      fire(PlatformEvent::stood);
      hold(true);
    }
  }
  if (state_ == DriverState::holding && engaged() && !stopped_ && silent_ < p_.silence)
    standstill_.regulated(reading.step + kPlatformSteps);
  if (state_ != DriverState::executing) return;
  pace_.go_to(wanted_pace_, Pace::rate(queue_.at(0).v, kPaceChange));
  commanded_until_ = reading.step + kPlatformSteps;
}

void PlatformDriver::hear_silence() noexcept {
  silent_ = heard_ || !protocol_.owner() ? 0 : std::min(silent_ + 1, p_.silence);
  heard_ = false;
  if (silent_ < p_.silence) return;
  if (state_ == DriverState::executing)
    fail(make_fault(FaultCode::peer_silent, "macrosteps without a command", -1, silent_, p_.silence));
  fire(PlatformEvent::silence);
}

void PlatformDriver::hold(bool stopped) noexcept {
  stopped_ = stopped;
  braked_ = false;
  rest_ = held_ = 0;
}

void PlatformDriver::end_macrostep() noexcept {
  iota_ = 0;
  taken_ = false;
  answer_ = {};
  if (moves()) {
    queue_.advance(pace_.passes(1));
    pace_.advance();
  }
  if (fault_ && fault_told_ && state_ != DriverState::faulted && !moves()) fault_ = {};
}

void PlatformDriver::reset() noexcept {
  reset_pending_ = false;
  wheel_brake_.end();
  enabled_ = false;
  torque_ = {};
  fault_ = {};
  fire(position_known_ ? PlatformEvent::reset : PlatformEvent::reset_unknown);
}

void PlatformDriver::measure(const PlatformReading& reading) noexcept {
  step_ = reading.step;
  sensors_.measure(reading);
  AxisVector increments(static_cast<int>(kWheels));
  std::ranges::copy(sensors_.wheels().increments(), increments.data());
  standstill_.step(step_, increments, commanded_until_, !enabled_ || state_ == DriverState::holding);
  if (state_ == DriverState::homing) synchronisation_.step(sensors_);
  const bool needed = position_known_ || state_ == DriverState::homing;
  if (needed && state_ != DriverState::faulted && sensors_.imu_silent())
    trip(make_fault(FaultCode::sensor_silent, "readings of the IMU that are absent", -1,
                    StageCollector::kImuSilent, StageCollector::kImuSilent));
}

void PlatformDriver::locate() noexcept {
  if (const std::optional<MapPose> pose = observer_.take_map(step_)) synchronisation_.add(*pose);
  if (const std::optional<Fault> wrong = synchronisation_.failed()) return trip(*wrong);
  const std::int64_t stage = step_ - step_ % kPlatformSteps;
  const std::optional<StandingStill> found = synchronisation_.found(sensors_, stage);
  if (!found) return;
  std::ignore = sensors_.take(stage);
  sensors_.set_static_load(found->load);
  observer_.begin(*found);
  begun_ = true;
}

void PlatformDriver::estimate_state() noexcept {
  stage_ = sensors_.take(step_ - step_ % kPlatformSteps);
  const std::optional<Fault> lost = observer_.step(stage_, step_);
  offset_.come_back(reference_.front().p);
  offset_.add(observer_.result().displacement);
  if (lost) begun_ = position_known_ = false;
  if (state_ == DriverState::faulted) return;
  if (lost) return trip(*lost);
  if (state_ == DriverState::homing && observer_.known()) {
    position_known_ = true;
    fire(PlatformEvent::located);
  }
  const bool driven = enabled_ && stage_.enabled;
  if (!driven) supervision_.forget();
  const PathPoint wanted = driven ? reference_.front() : PathPoint{};
  if (const std::optional<Fault> wrong = supervision_.step(stage_, observer_.result().estimate, wanted))
    return trip(*wrong);
  if (state_ == DriverState::holding) settle();
  // After a stop it rests where it stands, and does not go back to where it was to stand.
  if (state_ == DriverState::ready || (state_ == DriverState::holding && stopped_)) {
    queue_.hold_at(observer_.result().estimate.p);
    offset_.drop();
  }
}

void PlatformDriver::settle() noexcept {
  const PlatformEstimate& x = observer_.result().estimate;
  const PlanarPose held = queue_.end().p;
  const double away = std::hypot(x.p.x - held.x, x.p.y - held.y);
  const double turned = std::abs(wrap_angle(x.p.phi - held.phi));
  const auto within = [&](double times) {
    return away <= times * kHeldPosition && turned <= times * kHeldHeading;
  };
  const bool rests = std::hypot(x.v.vx, x.v.vy) < kRestSpeed && std::abs(x.v.w) < kRestTurnRate;
  rest_ = rests && (stopped_ || within(1)) ? rest_ + 1 : 0;
  ++held_;
  const bool long_enough =
      stopped_ ? rest_ >= kStoppedRest || held_ >= kStoppedMost : rest_ >= p_.brake_after;
  if (!braked_ && long_enough) {
    braked_ = true;
    if (stopped_) wheel_brake_.begin();
  }
  if (braked_ && !stopped_ && !within(2)) hold(false);
}

void PlatformDriver::follow() noexcept {
  reference_ = reference_ahead(queue_, pace_, platform_->horizon_period);
  const bool followed = followed_;
  followed_ = engaged();
  if (!followed_) return;
  wheel_brake_.end();
  const EstimatorResult& x = observer_.result();
  if (!followed) {
    follower_.begin(x);
    offset_.drop();
    follow_watch_.forget();
  }
  const Reference displaced = offset_.applied(reference_, platform_->horizon_period);
  if (const std::optional<Fault> held = follow_watch_.step(displaced, x.estimate.p)) return trip(*held);
  const Reference near = drawn_near(displaced, x.estimate.p);
  if (const std::optional<Fault> wrong = follower_.step(x, observer_.slip(), stage_.load, near)) trip(*wrong);
}

void PlatformDriver::answer() noexcept {
  const PlatformView view{.step = step_,
                          .state = state_,
                          .fault = fault_,
                          .position_known = position_known_,
                          .at_rest = standstill_.at_rest(),
                          .follows = followed_,
                          .queue = queue_,
                          .observer = observer_,
                          .follower = follower_,
                          .reference = reference_,
                          .torque = torque_,
                          .load = stage_.load};
  reply_ = build_reply(view, answer_, protocol_);
  telemetry_ = build_telemetry(view);
  reply_due_ = true;
  if (answer_.store) protocol_.store(reply_);
  if (!answer_.replay && reply_.fault.code == fault_.code) fault_told_ = true;
}

void PlatformDriver::brake() noexcept {
  const bool brakes = wheel_brake_.engaged();
  const PerWheel torque = wheel_brake_.step(sensors_.wheels());
  if (!brakes) return;
  torque_ = torque;
  enabled_ = wheel_brake_.engaged();
}

PlatformDrive PlatformDriver::drive() noexcept {
  PlatformDrive command;
  command.step = step_;
  command.enabled = enabled_;
  command.torque = torque_;
  command.imu_reset = state_ == DriverState::homing && synchronisation_.resets_imu();
  return command;
}

void PlatformDriver::trip(const Fault& fault) noexcept {
  const bool of_a_wheel = fault.code == FaultCode::wheel_blocked || fault.code == FaultCode::encoder_fault;
  const bool moved = enabled_;
  fire(PlatformEvent::trip);
  queue_.drop();
  pace_.set(0);
  enabled_ = followed_ = false;
  torque_ = {};
  begun_ = position_known_;
  if (fault.code == FaultCode::hardware_silent)
    wheel_brake_.end();  // nobody knows how the wheels turn
  else if (moved && (of_a_wheel || !wheel_brake_.engaged()))
    wheel_brake_.begin(of_a_wheel ? fault.axis : -1);
  fail(fault);
}

void PlatformDriver::fail(const Fault& fault) noexcept {
  fault_ = fault;
  fault_told_ = false;
  if (answer_.verdict == Verdict::executed) {
    answer_.verdict = Verdict::failed;
    answer_.fault = fault;
  }
}

}  // namespace mrroc::edp
