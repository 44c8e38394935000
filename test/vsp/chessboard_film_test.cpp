// The chessboard through films in which it moves, is hidden, and has doubles beside it.
#include <gtest/gtest.h>

#include <random>

#include "test/vsp/film_contract.hpp"
#include "vsp/chessboard/chain.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::vsp {
namespace {

constexpr Board kSmall{.columns = 5, .rows = 4};

TEST(ChessboardFilm, WhatIsSeenIsTheBoardWhereItIsAndOneThatHasForgottenReadsAsANewOne) {
  const test::PlaneCamera eye(test::film_camera(), 1);
  const auto board = test::chessboard_texture(kSmall.columns, kSmall.rows, kSmall.square, kSmall.margin);
  test::FilmCount count;
  for (unsigned run = 0; run < 8; ++run) {
    ChessboardParameters k;
    k.rms_px = run % 4 == 3 ? 0.08 : 0.5;
    std::mt19937 random(run);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const double z = uniform(0.5, 1.1), azimuth = uniform(0, 6.3), drift = uniform(-0.02, 0.02);
    const auto shot_of = [&](int step) {
      test::Shot shot;
      shot.where = std::to_string(run) + " " + std::to_string(step);
      shot.hidden = step == 7;
      shot.other = step % 5 == 4 ? 0.22 : 0;
      shot.T_CG = test::facing(z, 0.3, azimuth, 0.1 * step, drift * step);
      shot.image = eye.render(shot.T_CG,
                              [&](double a, double b) {
                                if (shot.hidden) return 120.0F;
                                return shot.other > 0 && a > shot.other - 0.11 ? board(a - shot.other, b)
                                                                               : board(a, b);
                              },
                              {.noise = 1.0 + run % 4, .seed = 100 * run + static_cast<unsigned>(step)});
      return shot;
    };
    test::expect_film([&] { return ChessboardSensor(test::film_camera(), kSmall, k); }, 12, shot_of, k.rms_px,
                      count);
  }
  EXPECT_GT(count.seen, 20);
  EXPECT_GT(count.ambiguous, 3);
  EXPECT_GT(count.not_seen, 5);
}

TEST(ChessboardFilm, WithoutQuadranglesThereIsNoLattice) { EXPECT_TRUE(chessboard::lattices({}).empty()); }

}  // namespace
}  // namespace mrroc::vsp
