#include "sim/hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "sim/hand_script.hpp"

namespace mrroc::sim {
namespace {

constexpr double kFade = 0.3;           // duration of taking the pen and of letting it go [s]
constexpr double kWanderTime = 0.5;     // correlation time of the pressure [s]
constexpr double kTremorDamping = 0.1;  // ratio: how narrow the band of the tremor is

// Position of a trembling muscle along one axis: white noise through a narrow band, unit variance.
struct Tremor {
  double position{}, velocity{};

  void step(double dt, double frequency, double noise) {
    const double w = 2 * std::numbers::pi * frequency;
    velocity += -dt * w * (w * position + 2 * kTremorDamping * velocity) +
                std::sqrt(dt * 4 * kTremorDamping * w * w * w) * noise;
    position += dt * velocity;
  }
};

}  // namespace

struct Hand::Impl {
  Impl(const HandParameters& parameters, const PaperParameters& paper, std::uint64_t seed)
      : p(parameters), R_0P(paper.T_0P.R), T_P0(paper.T_0P.inverse()), random(seed), script(parameters) {}

  void lead() {
    pushing = false;
    pushes.setZero();
  }

  // The hand takes hold of the tool, or lets it go.
  void change_grip(double dt, bool holds) { grip = std::clamp(grip + (holds ? dt : -dt) / kFade, 0.0, 1.0); }

  void tremble(double dt) {
    for (Tremor& t : tremor) t.step(dt, p.tremor_frequency, normal(random));
    wander += -dt / kWanderTime * wander + std::sqrt(2 * dt / kWanderTime) * normal(random);
  }

  // Force on the pen of a hand whose muscles want that force, in the sheet [N].
  Vector3 through_grip(double dt, const Vector3& muscles, const Vector3& at, const Vector3& moving) {
    Vector3 force = p.grip_stiffness * (hand - at) + p.grip_damping * (hand_velocity - moving);
    hand_velocity += dt / p.mass * (muscles - force);
    hand += dt * hand_velocity;
    return force;
  }

  HandParameters p;
  Matrix3 R_0P;
  Pose T_P0;
  std::mt19937_64 random;
  std::normal_distribution<double> normal{};
  std::array<Tremor, 3> tremor{};
  double wander{};  // of the pressure, unit variance
  HandScript script;
  Vector3 pushes{Vector3::Zero()};                                // with that force, in the sheet [N]
  bool pushing{};                                                 // it pushes, and leads nowhere
  double grip{};                                                  // 0 the pen is free, 1 held
  Vector3 hand{Vector3::Zero()}, hand_velocity{Vector3::Zero()};  // of a hand with a mass, in the sheet
};

Hand::Hand(const HandParameters& parameters, const PaperParameters& paper, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(parameters, paper, seed)) {}
Hand::~Hand() = default;
Hand::Hand(Hand&&) noexcept = default;
Hand& Hand::operator=(Hand&&) noexcept = default;

void Hand::lead_along(const std::vector<Polyline>& strokes) {
  impl_->lead();
  impl_->script.lead_along(strokes);
}
void Hand::lead_to(const Eigen::Vector2d& point, double height) {
  impl_->lead();
  impl_->script.lead_to(point, height);
}
void Hand::follow(const HandTrack& track) {
  impl_->lead();
  impl_->script.follow(track);
}
void Hand::push(const Vector3& force) {
  impl_->script.stop();
  impl_->pushes = force;
  impl_->pushing = true;
}
void Hand::release() {
  impl_->script.stop();
  impl_->pushing = false;
}
void Hand::pause(bool paused) { impl_->script.pause(paused); }
HandStatus Hand::status() const { return impl_->script.status(); }

Vector3 Hand::step(double dt, const Vector3& tip, const Vector3& velocity, bool on_paper) {
  Impl& h = *impl_;
  if (h.pushing || !h.pushes.isZero(0)) {
    h.change_grip(dt, h.pushing);
    if (!h.pushing && h.grip <= 0) h.pushes.setZero();
    return h.grip * (h.R_0P * h.pushes);
  }
  const bool holds = h.script.status().phase != HandPhase::idle;
  if (!holds && h.grip <= 0) return Vector3::Zero();

  const Vector3 at = h.T_P0 * tip;
  const Vector3 moving = h.R_0P.transpose() * velocity;
  if (h.grip <= 0) {
    h.script.grasp(at);
    h.hand = at;
    h.hand_velocity = moving;
  }
  h.change_grip(dt, holds);
  h.tremble(dt);
  h.script.step(dt, at, on_paper, h.p.press_wander * h.wander);

  Vector3 shake, shaking;
  for (int k = 0; k < 3; ++k) {
    shake[k] = h.p.tremor * h.tremor[static_cast<std::size_t>(k)].position;
    shaking[k] = h.p.tremor * h.tremor[static_cast<std::size_t>(k)].velocity;
  }
  const Vector3 led = h.script.velocity();
  const bool has_mass = h.p.mass > 0;
  const Vector3 muscles = h.p.stiffness * (h.script.position() + shake - (has_mass ? h.hand : at)) +
                          h.p.damping * (led + shaking - (has_mass ? h.hand_velocity : moving)) +
                          h.script.learnt() * h.p.drag * led +
                          h.script.learnt() * h.p.inertia * h.script.acceleration();
  return h.grip * (h.R_0P * (has_mass ? h.through_grip(dt, muscles, at, moving) : muscles));
}

}  // namespace mrroc::sim
