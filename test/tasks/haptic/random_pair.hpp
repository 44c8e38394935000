// Random pairs whose largest wall is measured in the time domain.
#pragma once
#include <cmath>
#include <random>

#include "test/edp/contact_simulation.hpp"
#include "test/tasks/haptic/light_pair.hpp"

namespace mrroc::haptic::test {

/// Gains, hand and servos of a pair.
struct RandomPair {
  Law law;
  Surroundings around;
  edp::LagServo servo;

  [[nodiscard]] edp::PairLoop loop() const { return pair_loop(law, around, servo); }
  /// @param near  where it is looked for: between half and twice that @return smallest stiffness of a wall on which it swings [N/m]
  [[nodiscard]] double measured_limit(double near) const {
    return edp::test::first_limit(near / 2, near * 2, 0.02,
                                  [&](double wall) { return grows(law, around, servo, wall); });
  }
};

/// @return a pair whose limit is predicted between 50 and 5e6 N/m; every third without delay, the others with up to 200 ms each way
template <class Random>
RandomPair random_pair(Random& random) {
  const auto even = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const auto between = [&](double low, double high) { return low * std::pow(high / low, even(0, 1)); };
  for (;;) {
    RandomPair p;
    p.law.master = {.inertia = between(2, 15), .mobility = between(1e-3, 6e-3)};
    p.law.slave = {.inertia = between(1, 10), .mobility = between(1e-3, 6e-3)};
    p.law.return_rate = between(4, 25);
    p.law.smoothing = between(0.005, 0.05);
    p.law.motion_scale = between(0.5, 2);
    p.law.force_scale = between(0.3, 2);
    p.law.channel.delay = even(0, 3) < 1 ? 0 : even(0, 0.2);
    p.around = {.hand_stiffness = between(200, 3000),
                .hand_damping = between(5, 60),
                .wall_damping = even(0, 2) < 1 ? 0 : between(1e-4, 2e-3)};
    p.servo = {.bandwidth = between(10, 50),
               .order = 2,
               .damping = between(0.6, 1.2),
               .feed_forward = between(0.3, 1)};
    const double limit = edp::pair_stiffness_limit(p.loop());
    if (limit > 50 && limit < 5e6) return p;
  }
}

}  // namespace mrroc::haptic::test
