#include "sim/hand_script.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace mrroc::sim {
namespace {

using std::numbers::pi;

constexpr double kMetre = 1e-3;      // of a millimetre
constexpr double kStop = 0.3;        // duration of stopping and going on [s]
constexpr double kSmoothing = 40;    // bandwidth of the height [rad/s]
constexpr double kDown = -0.1;       // lowering aims below any paper [m]
constexpr double kNear = 4e-4;       // the pen is where it was led to [m]
constexpr double kCornerRest = 0.1;  // shortest rest at a corner [s]
constexpr double kAboveRest = 0.3;   // shortest rest above the paper [s]
constexpr double kTimeout = 1.5;     // longest rest, and longest wait for a lifted pen [s]
constexpr double kLifted = 0.7;      // share of the lift from which on the pen counts as lifted
constexpr double kPressing = 0.003;  // fastest change of the depth to which the hand presses [m/s]
constexpr double kGentle = 0.6;      // share of the lowering speed when it goes down only to travel
constexpr double kLeastPress = 0.2;  // share of the pressure that remains however it wanders

}  // namespace

void HandScript::lead_along(const std::vector<Polyline>& strokes) {
  std::vector<std::vector<Polyline>> pieces;
  for (Polyline stroke : strokes) {
    if (stroke.empty()) continue;
    for (auto& point : stroke) point *= kMetre;
    pieces.push_back(cut_at_corners(stroke, p_.corner * pi / 180));
  }
  begin(std::move(pieces));
  if (strokes_.empty()) return finish();
  travel_to(strokes_.front().front().front(), p_.lift);
}

void HandScript::lead_to(const Eigen::Vector2d& point, double height) {
  begin({});
  travel_to(kMetre * point, height);
}

void HandScript::follow(const HandTrack& track) {
  begin({});
  track_ = track;
  const Vector3 first = track_.at(0).position;
  travel_to(first.head<2>(), first.z());
}

void HandScript::begin(std::vector<std::vector<Polyline>> strokes) {
  strokes_ = std::move(strokes);
  track_ = {};
  stroke_ = piece_ = 0;
  drawn_ = total_ = 0;
  for (const auto& stroke : strokes_)
    for (const auto& piece : stroke) total_ += HandPath(piece, {p_.speed, p_.acceleration}).length();
  phase_ = HandPhase::leading;
  paused_ = false;
}

void HandScript::grasp(const Vector3& tip) {
  const Eigen::Vector2d goal = path_.at(path_.length());
  place_ = tip.head<2>();
  target_ = height_ = tip.z();
  climb_ = 0;
  if (stage_ == Stage::travel) travel_to(goal, level_);
}

void HandScript::stop() {
  enter(Stage::hold);
  phase_ = HandPhase::idle;
}

void HandScript::finish() {
  enter(Stage::hold);
  phase_ = HandPhase::done;
}

void HandScript::enter(Stage stage) {
  stage_ = stage;
  since_ = 0;
  speed_.setZero();
}

void HandScript::travel_to(const Eigen::Vector2d& point, double level) {
  enter(Stage::travel);
  path_ = HandPath({place_, point}, {p_.travel_speed, p_.acceleration});
  s_ = 0;
  from_ = std::max(target_, level);
  level_ = level;
}

void HandScript::begin_piece() {
  enter(Stage::draw);
  path_ = HandPath(strokes_[stroke_][piece_], {p_.speed, p_.acceleration});
  s_ = 0;
}

void HandScript::end_piece() {
  drawn_ += path_.length();
  if (++piece_ < strokes_[stroke_].size()) return begin_piece();
  enter(Stage::lift);
}

void HandScript::end_stroke() {
  piece_ = 0;
  if (++stroke_ == strokes_.size()) return finish();
  travel_to(strokes_[stroke_].front().front(), p_.lift);
}

bool HandScript::along_path(double dt) {
  const Eigen::Vector2d before = place_;
  s_ = std::min(s_ + pace_ * dt * path_.speed_at(s_), path_.length());
  place_ = path_.at(s_);
  speed_ = (place_ - before) / dt;
  return s_ >= path_.length();
}

void HandScript::advance(double dt, const Vector3& tip, bool on_paper) {
  const bool near = (tip.head<2>() - place_).norm() < kNear;
  const auto rested = [&](double least) { return (near && since_ > least) || since_ > kTimeout; };
  switch (stage_) {
    case Stage::travel:  // a pen that is on the paper is lifted first
      if (tip.z() < kLifted * level_ && since_ < kTimeout) break;
      if (along_path(dt)) enter(Stage::above);
      break;
    case Stage::above:
      if (!rested(kAboveRest)) break;
      if (!track_.empty()) return enter(Stage::follow);
      if (strokes_.empty()) return finish();
      enter(Stage::lower);
      break;
    case Stage::lower:
      if (on_paper) enter(Stage::dwell);
      break;
    case Stage::dwell:
      if (since_ > p_.dwell) begin_piece();
      break;
    case Stage::draw:
      if (along_path(dt)) enter(Stage::corner);
      break;
    case Stage::corner:
      if (rested(kCornerRest)) end_piece();
      break;
    case Stage::lift:
      if ((target_ >= p_.lift && tip.z() > kLifted * p_.lift) || since_ > kTimeout) end_stroke();
      break;
    case Stage::follow:
      along_track();
      break;
    case Stage::hold:
      break;
  }
}

void HandScript::along_track() {
  s_ = since_;
  const TrackMotion now = track_.at(s_);
  place_ = now.position.head<2>();
  speed_ = pace_ * now.velocity.head<2>();
  target_ = height_ = now.position.z();
  climb_ = pace_ * now.velocity.z();
  if (s_ >= track_.duration()) finish();
}

double HandScript::height_goal(double wander) const {
  switch (stage_) {
    case Stage::travel: {
      const double u = path_.length() > 0 ? s_ / path_.length() : 1;
      const double wave = std::sin(pi * u);
      return from_ + u * (level_ - from_) + p_.uneven * wave * wave;
    }
    case Stage::above:
      return level_;
    case Stage::lower:
      return kDown;
    case Stage::dwell:  // the arm does not press yet
      return -p_.press / p_.stiffness;
    case Stage::draw:
    case Stage::corner:
      return -(p_.press * std::max(kLeastPress, 1 + wander) - p_.arm_press) / p_.stiffness;
    case Stage::lift:
      return p_.lift;
    case Stage::follow:
    case Stage::hold:
      break;
  }
  return target_;
}

void HandScript::move_height(double dt, double goal) {
  const bool on_paper = stage_ == Stage::dwell || stage_ == Stage::draw || stage_ == Stage::corner;
  // Down in the air it goes gently: the arm feels a hand that brakes hard as it feels the paper.
  const double down = stage_ == Stage::lower ? p_.lowering_speed : kGentle * p_.lowering_speed;
  const double fastest = on_paper ? kPressing : goal < target_ ? down : p_.lifting_speed;
  const double most = pace_ * dt * fastest;
  target_ += std::clamp(goal - target_, -most, most);
  climb_ += dt * kSmoothing * (kSmoothing * (target_ - height_) - 2 * climb_);
  height_ += dt * climb_;
}

void HandScript::step(double dt, const Vector3& tip, bool on_paper, double wander) {
  pace_ = std::clamp(pace_ + (paused_ ? -dt : dt) / kStop, 0.0, 1.0);
  since_ += pace_ * dt;
  const Eigen::Vector2d speed_before = speed_;
  advance(dt, tip, on_paper);
  change_ = (speed_ - speed_before) / dt;
  if (change_.norm() > p_.acceleration) change_ *= p_.acceleration / change_.norm();
  if (stage_ != Stage::follow) move_height(dt, height_goal(wander));
}

HandStatus HandScript::status() const {
  const bool drawing = stage_ == Stage::draw || stage_ == Stage::corner;
  const double done = drawn_ + (drawing ? s_ : 0);
  const double led = stage_ == Stage::follow ? s_ / track_.duration() : 0;
  const std::size_t last = strokes_.empty() ? 0 : strokes_.size() - 1;
  return {.phase = phase_,
          .paused = paused_,
          .on_paper = drawing || stage_ == Stage::dwell,
          .stroke = static_cast<std::int32_t>(std::min(stroke_, last)),
          .strokes = static_cast<std::int32_t>(strokes_.size()),
          .fraction = phase_ == HandPhase::done ? 1
                      : total_ > 0              ? done / total_
                                                : led};
}

}  // namespace mrroc::sim
