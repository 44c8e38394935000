// The pace of a fragment's time, and the reference that is made of it.
#include "edp/platform/pace.hpp"

#include <gtest/gtest.h>

#include <random>

#include "edp/platform/reference.hpp"

namespace mrroc::edp::test {
namespace {

TEST(Pace, GoesToItsTargetAtItsRateAndStaysThere) {
  Pace pace;
  EXPECT_EQ(pace.now(), 0);
  pace.go_to(1);
  EXPECT_NEAR(pace.after(3), 0.3, 1e-12);
  EXPECT_EQ(pace.after(0), 0);
  EXPECT_EQ(pace.after(100), 1);
  for (int k = 1; k <= 12; ++k) {
    pace.advance();
    EXPECT_NEAR(pace.now(), std::min(1.0, 0.1 * k), 1e-12);
  }
  pace.go_to(0.5, Pace::kStop);
  EXPECT_NEAR(pace.after(4), 1 - 4. / 15, 1e-12);
  EXPECT_EQ(pace.after(11), 0.5);
  pace.set(0.25);
  EXPECT_EQ(pace.now(), 0.25);
  EXPECT_EQ(pace.after(50), 0.25) << "and keeps it";
}

TEST(Pace, ItsRateChangesTheSpeedByNoMoreThanTyresCanGive) {
  for (const double v : {0., 0.3, 0.59, -0.59}) EXPECT_EQ(Pace::rate(v, Pace::kStop), Pace::kStop) << v;
  for (const double v : {0., 0.3, -0.39}) EXPECT_EQ(Pace::rate(v, kPaceChange), kPaceChange) << v;
  for (const double most : {Pace::kStop, kPaceChange})
    for (const double v : {0.7, 1.3, 1.5, -1.3})
      EXPECT_NEAR(Pace::rate(v, most) * std::abs(v) / kPlatformPeriod, kPaceAcceleration, 1e-12) << v;
}

TEST(Pace, TimeThatPassesIsItsIntegral) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> any(0, 1);
  for (int run = 0; run < 200; ++run) {
    Pace pace;
    pace.set(any(random));
    pace.go_to(run % 5 == 0 ? pace.now() : any(random), 0.02 + any(random));
    const double n = 20 * any(random);
    constexpr int kPieces = 4000;
    double integral = 0;
    for (int k = 0; k < kPieces; ++k) integral += pace.after((k + 0.5) * n / kPieces) * n / kPieces;
    EXPECT_NEAR(pace.passes(n), integral, 1e-5) << run;
  }
}

Fragment straight(std::int64_t number, double from, double v, int steps) {
  Fragment f;
  f.number = number;
  f.steps = steps;
  for (std::size_t k = 0; k < kFragmentKnots; ++k) {
    f.knot[k].p.x = from + v * steps * kPlatformPeriod * static_cast<double>(k) / (kFragmentKnots - 1);
    f.knot[k].v = v;
    f.knot[k].w = 0.5;
  }
  return f;
}

TEST(ReferenceAhead, IsTheWayAtThePaceThatIsToCome) {
  FragmentQueue queue;
  queue.push(straight(1, 0, 0.5, 200));
  Pace pace;
  pace.set(0.4);
  pace.go_to(1);
  const double period = 2.5 * kPlatformPeriod;
  const Reference reference = reference_ahead(queue, pace, period);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double ahead = 2.5 * static_cast<double>(k);
    EXPECT_NEAR(reference[k].p.x, 0.5 * kPlatformPeriod * pace.passes(ahead), 1e-9) << k;
    EXPECT_NEAR(reference[k].v, 0.5 * pace.after(ahead), 1e-9) << k;
    EXPECT_NEAR(reference[k].w, 0.5 * pace.after(ahead), 1e-9) << k;
  }
}

TEST(ReferenceDrawnNear, IsMovedAsAWholeToItsDistance) {
  Reference far{};
  for (std::size_t k = 0; k < far.size(); ++k)
    far[k] = {{3 + 0.1 * static_cast<double>(k), 4, 0.2}, 0.3, 0.4};
  const Reference near = drawn_near(far, {0, 0, 0.1});
  // From 5 m to 0.25 m, along the way between.
  for (std::size_t k = 0; k < far.size(); ++k) {
    EXPECT_NEAR(near[k].p.x, 0.15 + 0.1 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(near[k].p.y, 0.2, 1e-12);
    EXPECT_NEAR(near[k].p.phi, 0.2, 1e-12);
    EXPECT_EQ(near[k].v, 0.3);
    EXPECT_EQ(near[k].w, 0.4);
  }
  Reference close{};
  close[0].p = {0.15, 0.199, 0};
  EXPECT_EQ(drawn_near(close, {0, 0, 0})[0].p.x, 0.15) << "it is near";
  EXPECT_EQ(drawn_near(close, {0, 0, 0})[0].p.y, 0.199);
}

TEST(ReferenceDrawnNear, IsTurnedByTheShortestWayToItsAngle) {
  const auto heading = [](double wanted, double is) {
    Reference r{};
    for (auto& point : r) point.p.phi = wanted;
    r.back().p.phi = wanted + 1;
    const Reference near = drawn_near(r, {0, 0, is});
    EXPECT_NEAR(near.back().p.phi - near.front().p.phi, 1, 1e-12);
    return near.front().p.phi;
  };
  EXPECT_NEAR(heading(0.4, 0), 0.4, 1e-12);
  EXPECT_NEAR(heading(-0.4, 0), -0.4, 1e-12);
  EXPECT_NEAR(heading(0.9, 0), 0.5, 1e-12);
  EXPECT_NEAR(heading(-0.9, 0), -0.5, 1e-12);
  EXPECT_NEAR(heading(2 * M_PI + 0.9, 0), 2 * M_PI + 0.5, 1e-9) << "its turns stay";
  EXPECT_NEAR(heading(3, -3), 3, 1e-12) << "they are 0.28 apart";
}

}  // namespace
}  // namespace mrroc::edp::test
