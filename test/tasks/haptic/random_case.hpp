// Random cases of a pair with a bad channel: what the hand does, what stands in the way, and what comes of it.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "test/tasks/haptic/light_pair.hpp"

namespace mrroc::haptic::test {

/// One case.
struct RandomCase {
  Law law;
  Surroundings around;
  edp::LagServo servo;
  double depth{};   ///< the hand wants to be so far in the wall [m]
  double time{};    ///< in which it goes there [s]
  double swing{};   ///< it then goes to and fro by so much [m], until the middle of the case
  double period{};  ///< in that time [s]
  std::uint64_t seed{};

  /// Sets what the task sets before it starts.
  void settle() {
    law.grows_gently = law.passivity.control && !edp::pair_settles(pair_loop(law, around, servo), around.wall,
                                                                   lateness(law.channel, law.macrostep));
  }
};

template <class Random>
RandomCase random_case(Random& random) {
  const auto even = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const auto between = [&](double low, double high) { return low * std::pow(high / low, even(0, 1)); };
  RandomCase c;
  c.law.channel = {.delay = even(0, 0.2), .jitter = even(0, 0.05), .loss = even(0, 0.1), .seed = random()};
  c.law.motion_scale = between(0.5, 2);
  c.law.force_scale = between(0.5, 2);
  c.around = {.hand_stiffness = between(200, 2500),
              .hand_damping = even(5, 40),
              .wall = between(500, 5e4),
              .wall_damping = 0.002,
              .wall_at = 0.02,
              .noise = 0.05};
  c.depth = between(0.005, 0.05);
  c.time = between(0.2, 3);
  c.swing = even(0, 0.03);
  c.period = between(0.3, 3);
  c.seed = random();
  c.settle();
  return c;
}

/// What came of it.
struct CaseResult {
  double least_energy{};     ///< of both observers [J]
  double least_given{};      ///< that hand and wall together have given to the arms [J]
  double most_force{};       ///< of the slave [N]
  double early{}, late{};    ///< standard deviations of its force while the hand rests [N]
  double felt{}, exerted{};  ///< means at the end [N]
  /// @return whether it swings more and more while the hand rests
  [[nodiscard]] bool grows() const { return late > std::max(1.2 * early, 0.5); }
};

/// What is left of numbers over time when a line has been taken away: a force that creeps does not swing.
class Swing {
 public:
  void add(double t, double x) {
    ++n_;
    t_ += t;
    x_ += x;
    tt_ += t * t;
    tx_ += t * x;
    xx_ += x * x;
  }
  [[nodiscard]] double mean() const { return x_ / n_; }
  [[nodiscard]] double deviation() const {
    const double stt = tt_ - t_ * t_ / n_, stx = tx_ - t_ * x_ / n_, sxx = xx_ - x_ * x_ / n_;
    return std::sqrt(std::max(0.0, (sxx - stx * stx / stt) / n_));
  }

 private:
  double n_{}, t_{}, x_{}, tt_{}, tx_{}, xx_{};
};

/// 16 s: the hand goes into the wall, to and fro, and rests from the middle on.
inline CaseResult run_case(const RandomCase& c) {
  constexpr double kSeconds = 16;
  const double dt = c.law.macrostep;
  LightPair pair(c.law, c.around, c.servo);
  std::mt19937_64 random(c.seed);
  std::normal_distribution<> normal;
  const double wall = c.around.wall_at / c.law.motion_scale;
  const auto hand = [&](double t) {
    const double u = std::clamp(t / c.time, 0.0, 1.0);
    const double to_and_fro =
        t < kSeconds / 2 ? c.swing / 2 * (std::cos(2 * std::numbers::pi * t / c.period) - 1) : 0;
    return u * u * (3 - 2 * u) * (wall + c.depth) + u * to_and_fro;
  };
  CaseResult r;
  Swing early, late;
  double felt = 0, felt_n = 0;
  const int macrosteps = static_cast<int>(kSeconds / dt);
  double before = 0;
  for (int i = 0; i < macrosteps; ++i) {
    const double t = i * dt, h = hand(t);
    pair.macrostep(h, std::abs(h - before) < 0.002 ? (h - before) / dt : 0, c.around.noise * normal(random));
    before = h;
    const Coupling& k = pair.coupling();
    r.least_energy = std::min({r.least_energy, k.master.observed(), k.slave.observed()});
    r.least_given = std::min(r.least_given, pair.given_by_hand() + pair.given_by_wall());
    const double force = pair.slave().reading();
    r.most_force = std::max(r.most_force, force);
    if (t > 0.625 * kSeconds && t < 0.8125 * kSeconds) early.add(t, force);
    if (t >= 0.8125 * kSeconds) {
      late.add(t, force);
      felt += pair.felt_by_hand();
      ++felt_n;
    }
  }
  r.early = early.deviation();
  r.late = late.deviation();
  r.exerted = late.mean();
  r.felt = felt / felt_n;
  return r;
}

}  // namespace mrroc::haptic::test
