#include "vsp/pen_state/pen_state_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "vsp/sample.hpp"

#include "base/agent_images.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kJump = 0.005;  // in one step [m]: no arm moves at 2.5 m/s
constexpr double kTremor = 2;    // no tremor raises the force by so many amplitudes
constexpr double kSure = 3;      // deviations of the plane within which the paper is

std::size_t samples(double time, double dt) { return static_cast<std::size_t>(std::lround(time / dt)); }

}  // namespace

PenStateSensor::PenStateSensor(const PenStateParameters& parameters)
    : k_(parameters),
      z_(samples(k_.tremor_period, k_.dt)),
      force_(samples(k_.tremor_period, k_.dt)),
      paper_(k_.paper) {}

void PenStateSensor::begin(const Pose& T_0E, double F) {
  first_ = settled_ = false;
  state_ = PenState::above_paper;
  timer_ = pressing_ = 0;
  T_0S_ = T_0E;
  p_ = Vector3::Zero();
  F_ = F;
  v_ = amplitude_ = 0;
  past_.fill({.F = F, .amplitude = 0});
  z_.begin(0);
  force_.begin(F);
  fall_ = {};
  paper_.forget();
}

void PenStateSensor::filter(const StepSample& sample) {
  const Pose T_0E = pose_of(sample);
  const double F = sample.F_a[Axis::z];
  const Vector3 p = T_0S_.inverse() * T_0E.p;
  // A jump is another frame, not a motion: the arm has just been synchronised or got a new tool.
  if (first_ || (p - p_).norm() > kJump) return begin(T_0E, F);
  v_ += ((p.z() - p_.z()) / k_.dt - v_) * std::min(1.0, k_.dt / k_.v_filter);
  F_ += (F - F_) * std::min(1.0, k_.dt / k_.F_filter);
  p_ = p;
  z_.add(p.z());
  force_.add(F);
  amplitude_ =
      std::max(amplitude_ * (1 - std::min(1.0, k_.dt / k_.tremor_memory)), std::abs(F_ - force_.value()));

  const std::size_t lag = std::clamp<std::size_t>(samples(k_.impact_time, k_.dt), 1, past_.size());
  rise_ = F_ - past_[oldest_].F;
  rise_bound_ = k_.impact_force + kTremor * past_[oldest_].amplitude;
  past_[oldest_] = {.F = F_, .amplitude = amplitude_};
  oldest_ = (oldest_ + 1) % lag;
}

void PenStateSensor::follow_fall() {
  const double w = z_.rate() / k_.dt;
  if (w <= 0) fall_ = {.w_most = 0, .F_least = force_.value()};
  fall_.w_most = std::max(fall_.w_most, w);
  fall_.F_least = std::min(fall_.F_least, force_.value());
}

bool PenStateSensor::settled() {
  if (settled_) return true;
  timer_ = std::abs(v_) < k_.rest_speed ? timer_ + k_.dt : 0;
  settled_ = timer_ > k_.rest_time;
  return settled_;
}

double PenStateSensor::height() const { return paper_.known() ? paper_.depth(p_) - p_.z() : 0; }

bool PenStateSensor::lies_elsewhere() const {
  return height() > k_.touch_height + kSure * paper_.deviation(p_);
}

bool PenStateSensor::touches() const {
  const double w = z_.rate() / k_.dt;
  if (pressing_ > k_.rest_force_time) return true;
  if (paper_.known() && height() < k_.touch_height && v_ < k_.braked_speed) return true;
  if (lies_elsewhere()) return false;
  const bool stops = fall_.w_most > k_.lowering_speed && w < k_.stop_share * fall_.w_most &&
                     force_.value() - fall_.F_least > k_.stop_force;
  return stops || rise_ > rise_bound_;
}

PenState PenStateSensor::next() {
  // Arms sag when their brakes open, and the force is biased only after that.
  if (!settled()) return PenState::above_paper;
  follow_fall();
  const double w = z_.rate() / k_.dt;
  const bool rests = std::abs(w) < k_.rest_speed;
  timer_ = rests ? timer_ + k_.dt : 0;
  pressing_ = rests && force_.value() > k_.rest_force ? pressing_ + k_.dt : 0;
  switch (state_) {
    case PenState::lift_off:
      return PenState::above_paper;
    case PenState::above_paper:
      if (pressing_ > k_.rest_force_time) break;
      timer_ = 0;
      return v_ > k_.lowering_speed ? PenState::lowering : PenState::above_paper;
    case PenState::lowering:
      if (touches()) break;
      return w < -k_.braked_speed || timer_ > k_.rest_time ? PenState::above_paper : PenState::lowering;
    case PenState::paper_surface:
      if (height() > k_.lift_height) return PenState::lift_off;
      if (height() >= -k_.sink_depth || v_ <= k_.lowering_speed) break;
      paper_.forget();
      return PenState::lowering;
  }
  if (state_ != PenState::paper_surface && lies_elsewhere()) paper_.forget();
  paper_.add(p_, k_.dt);
  return PenState::paper_surface;
}

void PenStateSensor::step(const StepSample& sample) {
  if (!is_reading(sample)) return;
  filter(sample);
  state_ = next();
  lifted_ = lifted_ || state_ == PenState::lift_off;
}

SensorReading PenStateSensor::reading() {
  SensorReading r;
  r.state = static_cast<int>(lifted_ ? PenState::lift_off : state_);
  r.valid = !first_;
  r.value[0] = height();
  r.value[1] = v_;
  r.value[2] = F_;
  lifted_ = false;
  return r;
}

}  // namespace mrroc::vsp
