#include "sim/camera/object_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace mrroc::sim {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kGrasp = 1;  // time in which a hand gets going [s]

const ObjectParameters& checked(const ObjectParameters& p) {
  for (const double x :
       {p.start, p.speed, p.length, p.reach, p.turn, p.pace, p.absent_until, p.hidden_from, p.hidden_for})
    if (!(x >= 0 && x < kEndless)) throw std::invalid_argument("object: a length, speed or time is negative");
  if (!(p.acceleration > 0 && p.radius > 0 && p.tag_edge > 0 && p.board.square > 0))
    throw std::invalid_argument("object: acceleration, radius, edges and squares must be positive");
  if (!is_proper(p.T_0G)) throw std::invalid_argument("object: its pose is none");
  return p;
}

Matrix3 about_z(double angle) { return rotation_from_angle_axis(angle * Vector3::UnitZ()); }

}  // namespace

ObjectPath::ObjectPath(const ObjectParameters& parameters) : p_(checked(parameters)) {
  std::mt19937_64 random(p_.seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (auto& axis : waves_)
    for (std::size_t k = 0; k < kWaves; ++k) {
      // Slow waves go far, fast ones do not: no sudden motion.
      const double octave = std::pow(1.7, static_cast<double>(k));
      const double frequency = p_.pace * octave * (0.85 + 0.3 * uniform(random));
      axis[k] = {frequency, uniform(random), 0.57 / octave};
    }
  if (p_.kind == ObjectKind::chessboard) camera::add_board(plate_, p_.board, Pose{});
  if (p_.kind == ObjectKind::apriltag) camera::add_tag(plate_, p_.tag, p_.tag_edge, Pose{});
  if (p_.kind == ObjectKind::wrong_board) {
    camera::BoardSize wrong = p_.board;
    wrong.columns = std::max(2, wrong.columns - 2);
    wrong.rows = std::max(3, wrong.rows - 2);
    camera::add_board(plate_, wrong, Pose{});
  }
}

// Speeds up, goes on, slows down: the way after a time since the start.
double ObjectPath::travelled(double t, double length) const {
  if (t <= 0 || p_.speed <= 0 || length <= 0) return 0;
  const double top = std::min(p_.speed, std::sqrt(length * p_.acceleration));
  const double ramp = top / p_.acceleration;
  const double end = length / top + ramp;
  if (t >= end) return length;
  if (t < ramp) return p_.acceleration * t * t / 2;
  if (t <= end - ramp) return top * (t - ramp / 2);
  return length - p_.acceleration * (end - t) * (end - t) / 2;
}

std::array<double, ObjectPath::kAxes> ObjectPath::wander(double t) const {
  const double s = std::clamp(t / kGrasp, 0.0, 1.0);
  const double under_way = s * s * s * (10 + s * (6 * s - 15));
  std::array<double, kAxes> x{};
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    for (const Wave& w : waves_[axis])
      x[axis] += under_way * w.share * std::sin(2 * std::numbers::pi * (w.frequency * t + w.phase));
  return x;
}

ObjectState ObjectPath::at(double t) const {
  ObjectState state{p_.T_0G, p_.kind != ObjectKind::none && t >= p_.absent_until,
                    t >= p_.hidden_from && t < p_.hidden_from + p_.hidden_for};
  const double since = t - p_.start;
  const Vector3 ahead = about_z(p_.heading).col(0);
  switch (p_.motion) {
    case ObjectMotion::rest:
      break;
    case ObjectMotion::line:
      state.T_0G.p += travelled(since, p_.length) * ahead;
      break;
    case ObjectMotion::circle: {
      const Vector3 centre = p_.T_0G.p + p_.radius * Vector3::UnitZ().cross(ahead);
      const Matrix3 R = about_z(travelled(since, kEndless) / p_.radius);
      state.T_0G = {R * p_.T_0G.R, centre + R * (p_.T_0G.p - centre)};
      break;
    }
    case ObjectMotion::hand: {
      const auto x = wander(since);
      state.T_0G.p += p_.reach * Vector3(x[0], x[1], (x[2] + std::abs(x[2])) / 6);
      state.T_0G.R = about_z(p_.turn * x[3]) * p_.T_0G.R;
      break;
    }
  }
  return state;
}

void ObjectPath::add_to(camera::Scene& scene, const Pose& T_U0, const ObjectState& state) const {
  if (!state.present) return;
  const Pose T_UG = T_U0 * state.T_0G;
  for (camera::Body body : plate_.bodies) {
    body.T_UB = T_UG * body.T_UB;
    scene.bodies.push_back(std::move(body));
  }
  if (!state.hidden) return;
  camera::Body cover;
  cover.size = {0.42, 0.36, 0.004};
  cover.T_UB = T_UG * Pose{Matrix3::Identity(), {0, 0, 0.04}};
  cover.colour = {0.25, 0.3, 0.35};
  scene.bodies.push_back(cover);
}

}  // namespace mrroc::sim
