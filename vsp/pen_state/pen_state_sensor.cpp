#include "vsp/pen_state/pen_state_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "base/pose.hpp"
#include "vsp/sample.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kJump = 0.005;  // in one step [m]: no arm moves at 2.5 m/s

}  // namespace

PenStateSensor::PenStateSensor(const PenStateParameters& parameters) : k_(parameters) {}

void PenStateSensor::filter(const StepSample& sample) {
  const Pose T_0E = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(sample.T_0E.data()));
  // A jump is another frame, not a motion: the arm has just been synchronised or got a new tool.
  if (first_ || (T_0E.p - p_).norm() > kJump) {
    first_ = false;
    p_ = T_0E.p;
    F_ = sample.F_a[Axis::z];
    past_F_.fill(F_);
  }
  const double way = T_0E.R.col(2).dot(T_0E.p - p_);
  p_ = T_0E.p;
  depth_ += way;
  v_ += (way / k_.dt - v_) * std::min(1.0, k_.dt / k_.v_filter);
  F_ += (sample.F_a[Axis::z] - F_) * std::min(1.0, k_.dt / k_.F_filter);
}

bool PenStateSensor::settled() {
  if (settled_) return true;
  timer_ = std::abs(v_) < k_.rest_speed ? timer_ + k_.dt : 0;
  settled_ = timer_ > k_.rest_time;
  return settled_;
}

PenState PenStateSensor::touch() {
  timer_ = 0;
  paper_ = depth_;
  return PenState::paper_surface;
}

PenState PenStateSensor::next() {
  const auto lag = std::clamp<int>(static_cast<int>(std::lround(k_.impact_time / k_.dt)), 1,
                                   static_cast<int>(past_F_.size()) - 1);
  auto& slot = past_F_[static_cast<std::size_t>(n_F_ % lag)];
  const double rise = F_ - slot;
  slot = F_;
  ++n_F_;

  // Arms sag when their brakes open, and the force is biased only after that.
  if (!settled()) return PenState::above_paper;
  pressing_ = std::abs(v_) < k_.rest_speed && F_ > k_.rest_force ? pressing_ + k_.dt : 0;
  timer_ += k_.dt;
  switch (state_) {
    case PenState::above_paper:
      // A hard bounce can be taken for a lift-off, but the pen has not left the paper.
      if (pressing_ > k_.rest_force_time) return touch();
      if (v_ <= k_.lowering_speed) return PenState::above_paper;
      timer_ = 0;
      return PenState::lowering;
    case PenState::lowering:
      if (v_ < -k_.braked_speed) return PenState::above_paper;
      if (rise > k_.impact_force || pressing_ > k_.rest_force_time) return touch();
      if (std::abs(v_) > k_.rest_speed) timer_ = 0;
      return timer_ > k_.rest_time ? PenState::above_paper : PenState::lowering;
    case PenState::paper_surface: {
      if (timer_ < k_.settling_time) {
        paper_ = depth_;
        return PenState::paper_surface;
      }
      if (v_ > -k_.braked_speed) paper_ += (depth_ - paper_) * k_.dt / k_.paper_filter;
      // A jerk of the hand in the air was taken for the paper: the pen sinks through it.
      if (depth_ - paper_ > k_.sink_depth && v_ > k_.lowering_speed) {
        timer_ = 0;
        return PenState::lowering;
      }
      const bool rises = paper_ - depth_ > k_.lift_height && v_ < -k_.lift_speed;
      return rises || F_ > k_.pull_force ? PenState::lift_off : PenState::paper_surface;
    }
    case PenState::lift_off:
      break;
  }
  return PenState::above_paper;
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
  r.value[0] = paper_ - depth_;
  r.value[1] = v_;
  r.value[2] = F_;
  lifted_ = false;
  return r;
}

}  // namespace mrroc::vsp
