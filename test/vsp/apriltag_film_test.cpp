// The tag through films in which it moves, is hidden, and has doubles and other tags beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "test/vsp/film_contract.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"

namespace mrroc::vsp {
namespace {

TEST(AprilTagFilm, WhatIsSeenIsTheTagWhereItIsAndOneThatHasForgottenReadsAsANewOne) {
  const test::PlaneCamera eye(test::film_camera(), 2);
  const auto tag = test::tag_texture(kTag.id, kTag.edge, kTag.margin);
  const auto wrong = test::tag_texture(7, kTag.edge, kTag.margin);
  test::FilmCount count;
  for (unsigned run = 0; run < 8; ++run) {
    AprilTagParameters k;
    k.rms_px = run % 4 == 3 ? 0.05 : 0.3;
    std::mt19937 random(run);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const double z = uniform(0.22, 0.35), azimuth = uniform(0, 6.3), drift = uniform(-0.012, 0.004);
    const auto shot_of = [&](int step) {
      test::Shot shot;
      shot.where = std::to_string(run) + " " + std::to_string(step);
      shot.hidden = step == 7;
      shot.other = step % 3 == 2 && step != 5 ? 0.135 : 0;
      shot.T_CG = test::facing(z, 0.5, azimuth, 0.1 * step, drift * step);
      const double beside = step % 3 == 2 ? 0.135 : 9;  // a double, or another tag
      shot.image = eye.render(shot.T_CG,
                              [&](double a, double b) {
                                if (shot.hidden) return 120.0F;
                                if (a > beside - 0.065)
                                  return step == 5 ? wrong(a - beside, b) : tag(a - beside, b);
                                return tag(a, b);
                              },
                              {.blur = 0.3 + 0.1 * (run % 6),
                               .noise = 1.0 + run % 4,
                               .seed = 100 * run + static_cast<unsigned>(step)});
      return shot;
    };
    test::expect_film([&] { return AprilTagSensor(test::film_camera(), kTag, k); }, 12, shot_of, k.rms_px,
                      count);
  }
  EXPECT_GT(count.seen, 20);
  EXPECT_GT(count.ambiguous, 3);
  EXPECT_GT(count.not_seen, 5);
}

}  // namespace
}  // namespace mrroc::vsp
