// A pair along one axis with servos that lag, a hand that is a spring with a damper, and a wall that only pushes: law (28) and the
// coupling of the task are the real ones. What predictions are held against, and what hundreds of cases run on.
#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>
#include <vector>

#include "base/latency.hpp"
#include "edp/control_law.hpp"
#include "edp/pair_stability.hpp"
#include "tasks/haptic/coupling.hpp"
#include "tasks/haptic/haptic.hpp"

namespace mrroc::haptic::test {

/// An arm along one axis under law (28), with a servo of second order.
class LightArm {
 public:
  LightArm(const edp::LagServo& servo, double dt) : servo_(servo), dt_(dt) {}

  void place(double x, double reading) {
    r_ = x_ = x;
    reading_ = reading;
  }
  /// One step. @param force  that the arm exerts at a place and a speed [N]
  template <class Force>
  void step(const AxisCommand& row, Force force) {
    v_ = edp::axis_velocity(row, reading_, v_, dt_);
    constexpr int kSubsteps = 20;
    const double h = dt_ / kSubsteps;
    double sum = 0;
    for (int k = 0; k < kSubsteps; ++k) {
      const double before = force(x_, w_), r = r_ + v_ * h / 2;
      const double x = x_ + w_ * h / 2, w = w_ + pull(r_, x_, w_) * h / 2;
      x_ += w * h;
      w_ += pull(r, x, w) * h;
      r_ += v_ * h;
      sum += (before + force(x_, w_)) / 2;
    }
    reading_ = sum / kSubsteps;
  }
  [[nodiscard]] double x() const { return x_; }
  [[nodiscard]] double velocity() const { return w_; }
  [[nodiscard]] double reading() const { return reading_; }

 private:
  [[nodiscard]] double pull(double r, double x, double w) const {
    const double omega = 2 * std::numbers::pi * servo_.bandwidth;
    return omega * omega * (r - x) + 2 * servo_.damping * omega * (servo_.feed_forward * v_ - w);
  }

  edp::LagServo servo_;
  double dt_;
  double r_{}, x_{}, w_{}, v_{}, reading_{};
};

/// What surrounds a pair.
struct Surroundings {
  double hand_stiffness{1000};  ///< [N/m]
  double hand_damping{30};      ///< [N s/m]
  double wall{1e4};             ///< stiffness [N/m]
  double wall_damping{};        ///< per stiffness [s]
  double wall_at{};             ///< where the slave touches it [m]
  double noise{};               ///< standard deviation of the slave's force [N]
};

/// The pair.
class LightPair {
 public:
  static constexpr double kDt = 0.002;  ///< [s]

  LightPair(const Law& law, const Surroundings& around, const edp::LagServo& servo = {})
      : law_(law), around_(around), master_(servo, kDt), slave_(servo, kDt), coupling_(coupled(law)) {
    orders_.assign(static_cast<std::size_t>(latency::kOrderToMotion), {});
    reports_.assign(static_cast<std::size_t>(latency::kMotionToReport), {});
  }

  /// Puts it where it presses on the wall with that force, which everybody has heard of already.
  /// @return where the hand has to want to be for that [m]
  double press(double force) {
    const double x_s = around_.wall_at + force / around_.wall;
    const double place = x_s + law_.slave.mobility * force / law_.return_rate,
                 x_m = place / law_.motion_scale;
    const double felt_force = law_.force_scale * force;
    master_.place(x_m, -felt_force);
    slave_.place(x_s, force);
    const Vector3 X = Vector3::UnitX();
    coupling_.x_m = x_m * X;
    coupling_.place = coupling_.asked = place * X;
    coupling_.there.send({.stamp = 0, .value = x_m * X});
    coupling_.back.send({.stamp = 0, .value = force * X});
    coupling_.v_d = law_.return_rate * (place - x_s) * X;
    coupling_.F_d = -felt_force * X;
    for (Decision& order : orders_) order = {coupling_.F_d.x(), coupling_.v_d.x()};
    for (Sides& report : reports_) report = {x_m * X, x_s * X, force * X};
    return x_m + felt_force / around_.hand_stiffness;
  }

  /// One macrostep. @param hand  where the hand wants to be [m] @param moving  and with what speed [m/s]
  /// @param noise  of the slave's reading [N]
  void macrostep(double hand, double moving = 0, double noise = 0) {
    coupling_ = couple(std::move(coupling_), law_, reports_.back(), i_++);
    orders_.push_front({coupling_.F_d.x(), coupling_.v_d.x()});
    const Decision order = orders_.back();
    orders_.pop_back();
    for (int step = 1; step <= kPacing.n_s; ++step) {
      const double x_m = master_.x(), x_s = slave_.x();
      master_.step(c(order.F_d, law_.master.inertia, law_.master.mobility),
                   [&](double x, double w) { return hand_force(x, w, hand, moving); });
      slave_.step(g(order.v_d, law_.slave.inertia, law_.slave.mobility),
                  [&](double x, double w) { return wall_force(x, w); });
      given_by_hand_ -= master_.reading() * (master_.x() - x_m);
      given_by_wall_ -= slave_.reading() * (slave_.x() - x_s);
      if (step != kPacing.n_Q) continue;
      reports_.pop_back();
      const Vector3 X = Vector3::UnitX();
      reports_.push_front({master_.x() * X, slave_.x() * X, (slave_.reading() + noise) * X});
    }
  }

  [[nodiscard]] const Coupling& coupling() const { return coupling_; }
  [[nodiscard]] const LightArm& master() const { return master_; }
  [[nodiscard]] const LightArm& slave() const { return slave_; }
  /// @return force on the hand [N], in the sense of the slave's
  [[nodiscard]] double felt_by_hand() const { return -master_.reading(); }
  /// @return energies that hand and wall have given to the arms [J]
  [[nodiscard]] double given_by_hand() const { return given_by_hand_; }
  [[nodiscard]] double given_by_wall() const { return given_by_wall_; }

 private:
  struct Decision {
    double F_d{}, v_d{};
  };
  /// That the master exerts on the hand.
  [[nodiscard]] double hand_force(double x, double w, double hand, double moving) const {
    return around_.hand_stiffness * (x - hand) + around_.hand_damping * (w - moving);
  }
  /// That the slave exerts on the wall.
  [[nodiscard]] double wall_force(double x, double w) const {
    const double depth = x - around_.wall_at;
    return depth > 0 ? std::max(0.0, around_.wall * (depth + around_.wall_damping * w)) : 0;
  }

  Law law_;
  Surroundings around_;
  LightArm master_, slave_;
  Coupling coupling_;
  std::deque<Decision> orders_;  // newest first
  std::deque<Sides> reports_;    // newest first
  std::int64_t i_{1000};
  double given_by_hand_{}, given_by_wall_{};
};

/// @return what the predictor has to know of a pair
inline edp::PairLoop pair_loop(const Law& law, const Surroundings& around, const edp::LagServo& servo) {
  edp::PairLoop p;
  p.master = {.inertia = law.master.inertia, .mobility = law.master.mobility, .servo = servo};
  p.slave = {.inertia = law.slave.inertia,
             .mobility = law.slave.mobility,
             .contact_damping = around.wall_damping,
             .servo = servo};
  p.hand_stiffness = around.hand_stiffness;
  p.hand_damping = around.hand_damping;
  p.motion_scale = law.motion_scale;
  p.force_scale = law.force_scale;
  p.return_rate = law.return_rate;
  p.smoothing = law.smoothing;
  p.delay = law.channel.delay;
  p.n_s = kPacing.n_s;
  return p;
}

/// @return whether a small push at a wall of that stiffness grows, or has grown until the contact breaks
inline bool grows(Law law, Surroundings around, const edp::LagServo& servo, double wall) {
  constexpr double kForce = 10, kPush = 0.02, kLeft = 0.05;  // [N], shares of it
  const int macrosteps =
      law.channel.delay > 0 ? 15'000 : 5'000;  // with delay it swings slowly, and grows slowly
  law.passivity.control = law.grows_gently = false;
  around.wall = wall;
  LightPair pair(law, around, servo);
  const double hand = pair.press(kForce);
  const double pushed = hand + kPush * kForce * law.force_scale / around.hand_stiffness;
  double early = 0, late = 0;
  for (int i = 0; i < macrosteps; ++i) {
    pair.macrostep(i < 250 ? pushed : hand);
    const double off = pair.slave().reading() - kForce;
    if (i >= macrosteps / 2 && i < 3 * macrosteps / 4) early += off * off;
    if (i >= 3 * macrosteps / 4) late += off * off;
  }
  return late > std::max(early, 1e-12 * macrosteps) ||
         late > macrosteps / 4. * kLeft * kLeft * kForce * kForce;
}

}  // namespace mrroc::haptic::test
