#include "edp/gripper.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "edp/guard.hpp"
#include "edp/regulator.hpp"

namespace mrroc::edp {
namespace {

/// The set point waits for jaws that are farther behind than this many times the error that asks for the whole
/// current: they are held.
constexpr double kLead = 1.5;

const GripperParameters& checked(const GripperParameters& p) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw FaultError(FaultCode::bad_configuration, std::string("gripper: ") + what);
  };
  demand(p.distance != nullptr && p.motor != nullptr, "there must be a transmission");
  demand(p.legal.lower < p.legal.upper, "the distances must be a range");
  for (const double positive : {p.increments_per_rad, p.speed, p.opening_speed, p.acceleration,
                                p.homing_speed, p.max_current, p.stiffness, p.current_gain})
    demand(positive > 0, "speeds, currents and gains must be positive");
  demand(p.blocked_steps >= 1 && p.blocked_steps <= Gripper::kMostBlockedSteps,
         "blocked_steps must lie between 1 and 64");
  return p;
}

}  // namespace

Gripper::Gripper(const GripperParameters& parameters, double dt) : p_(checked(parameters)), dt_(dt) {}

void Gripper::start_homing() noexcept {
  known_ = false;
  homing_ = true;
  steps_ = pressing_ = homing_steps_ = 0;
}

void Gripper::believe(double distance, std::int32_t count) noexcept {
  last_count_ = count;
  counted_ = known_ = true;
  homing_ = false;
  motor_ = last_motor_ = set_ = goal_ = p_.motor(distance);
  set_speed_ = 0;
}

std::optional<Fault> Gripper::measure(std::int32_t count, double current) noexcept {
  last_motor_ = motor_;
  if (counted_)
    motor_ += static_cast<std::int32_t>(static_cast<std::uint32_t>(count) -
                                        static_cast<std::uint32_t>(last_count_)) /
              p_.increments_per_rad;
  last_count_ = count;
  counted_ = true;
  current_ = current;
  judge_blocked();
  if (!(std::abs(current) <= p_.over_current))
    return make_fault(FaultCode::over_current, "jaws [A]", -1, current, p_.over_current);
  const double longest = 2 * std::abs(p_.motor(p_.legal.lower) - p_.open_stop) / p_.homing_speed;  // [s]
  if (homing_ && ++homing_steps_ * dt_ > longest)
    return make_fault(FaultCode::synchro_switch_missing, "jaws: the stop of the opening");
  return {};
}

void Gripper::judge_blocked() noexcept {
  const int oldest = steps_ % p_.blocked_steps;
  const double before =
      steps_ < p_.blocked_steps ? motor_ + 2 * p_.blocked_motion : past_[static_cast<std::size_t>(oldest)];
  past_[static_cast<std::size_t>(oldest)] = motor_;
  steps_ = steps_ + 1 < 2 * p_.blocked_steps ? steps_ + 1 : p_.blocked_steps;
  pressing_ = std::abs(current_) >= p_.blocked_current ? std::min(pressing_ + 1, p_.blocked_steps) : 0;
  blocked_ = pressing_ == p_.blocked_steps && std::abs(motor_ - before) < p_.blocked_motion;
}

void Gripper::move_set_point() noexcept {
  double speed = 0;
  if (homing_) {
    speed = p_.open_direction * p_.homing_speed;
  } else {
    // The speed from which the set point still stops at its goal.
    const double way = goal_ - set_;
    const double braking = std::sqrt(2 * p_.acceleration * std::abs(way));
    const double fastest = way * p_.open_direction > 0 ? p_.opening_speed : p_.speed;
    speed = std::copysign(std::min({fastest, braking, std::abs(way) / dt_}), way);
  }
  const double most = p_.acceleration * dt_;
  set_speed_ += std::clamp(speed - set_speed_, -most, most);
  const double next = set_ + set_speed_ * dt_;
  const double lead = kLead * p_.max_current / p_.stiffness;
  const bool held = std::abs(next - motor_) > lead && std::abs(next - motor_) > std::abs(set_ - motor_);
  if (held)
    set_speed_ = 0;
  else
    set_ = next;
}

double Gripper::step() noexcept {
  if (homing_ && blocked_) believe(p_.distance(p_.open_stop), last_count_);
  if (known_ || homing_) move_set_point();
  const double speed = (motor_ - last_motor_) / dt_;
  const double wanted = std::clamp(p_.stiffness * (set_ - motor_) + p_.damping * (set_speed_ - speed),
                                   -p_.max_current, p_.max_current);
  pwm_ = std::clamp(pwm_ + p_.current_gain * (wanted - current_), -kMaxPwm, kMaxPwm);
  return pwm_;
}

void Gripper::braked() noexcept {
  set_ = motor_;
  if (!blocked_) goal_ = motor_;
  set_speed_ = pwm_ = 0;
  homing_ = false;
}

std::optional<Fault> check_distance(const GripperParameters& gripper, double distance) noexcept {
  if (distance == 0 || gripper.legal.contains(distance)) return {};
  constexpr std::string_view kWhat = "distance of the jaws [m], legal ", kTo = " to ";
  std::array<char, 96> text{};  // a number has at most 24 characters
  char* at = std::ranges::copy(kWhat, text.data()).out;
  at = std::to_chars(at, text.data() + text.size(), gripper.legal.lower).ptr;
  at = std::ranges::copy(kTo, at).out;
  at = std::to_chars(at, text.data() + text.size(), gripper.legal.upper).ptr;
  return make_fault(FaultCode::out_of_limits, std::string_view(text.data(), at), -1, distance,
                    distance < gripper.legal.lower ? gripper.legal.lower : gripper.legal.upper);
}

}  // namespace mrroc::edp
