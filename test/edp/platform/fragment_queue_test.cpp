// The queue of fragments against a plain model, and its rules one by one; the pace of its time.
#include "edp/platform/fragment_queue.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

#include "edp/platform/pace.hpp"
#include "edp/platform/reference.hpp"
#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr double kExact = 1e-9;
constexpr PathPoint kOrigin{{1, 2, 0.5}, 0, 0};

FragmentQueue queue_at(const PathPoint& point) {
  FragmentQueue queue;
  queue.hold_at(point.p);
  return queue;
}

TEST(FragmentQueue, EmptyItStandsWhereItIsHeld) {
  const FragmentQueue queue = queue_at(kOrigin);
  EXPECT_TRUE(queue.empty());
  for (const double ahead : {0., 3., 1e6}) {
    EXPECT_EQ(queue.at(ahead).p.x, 1);
    EXPECT_EQ(queue.at(ahead).v, 0);
  }
  EXPECT_EQ(queue.executing(), 0);
  EXPECT_EQ(queue.remaining(), 0);
  EXPECT_EQ(queue.iteration(), 0);
}

TEST(FragmentQueue, TimePassesThroughFragmentsWithoutAGap) {
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  std::vector<Fragment> all;
  for (const double v : {0.3, 0.6, 0.2, 0.}) all.push_back(way.next(v, v - 0.3, 10));
  for (const Fragment& f : all) queue.push(f);
  EXPECT_EQ(queue.remaining(), 40);
  for (int k = 0; k < 40; ++k) {
    const auto n = static_cast<std::size_t>(k / 10);
    EXPECT_EQ(queue.executing(), static_cast<std::int64_t>(n) + 1);
    EXPECT_EQ(queue.iteration(), k % 10);
    EXPECT_EQ(queue.remaining(), 40 - k);
    EXPECT_NEAR(queue.at(0).p.x, point_at(all[n], k % 10 / 10.).p.x, kExact);
    const int after = (k * 2 + 15) / 20;  // fragment in which the queue is 7.5 iterations later
    EXPECT_NEAR(
        queue.at(7.5).v,
        k + 7.5 < 40 ? point_at(all[static_cast<std::size_t>(after)], (k + 7.5 - 10 * after) / 10).v : 0,
        kExact);
    queue.advance(1);
  }
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.at(0).p.x, way.end().p.x);
}

TEST(FragmentQueue, AFragmentIsNotifiedWhenItsIterationHasCome) {
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  queue.push(way.next(0.2, 0, 10, 4));
  queue.push(way.next(0.2, 0, 10, 0));
  EXPECT_EQ(queue.accepted(), 2);
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(queue.notified(), k < 4 ? 0 : k < 10 ? 1 : 2) << k;
    queue.advance(1);
  }
}

TEST(FragmentQueue, AFragmentWithNotifyZeroIsNotifiedAtOnce) {
  FragmentQueue queue = queue_at(kOrigin);
  queue.push(Way(kOrigin).next(0.2, 0, 10, 0));
  EXPECT_EQ(queue.notified(), 1);
}

TEST(FragmentQueue, ANegativeNotifyComesBeforeTheFragmentBegins) {
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  queue.push(way.next(0.2, 0, 10, -5));
  EXPECT_EQ(queue.notified(), 1) << "nothing is before it";
  queue.push(way.next(0.2, 0, 10, -5));
  queue.push(way.next(0.2, 0, 10, -19));  // due at 1
  for (int k = 0; k < 30; ++k) {
    EXPECT_EQ(queue.notified(), k < 5 ? 1 : 3) << k << ", the third one waits for the second";
    queue.advance(1);
  }
}

TEST(FragmentQueue, WhatIsFullAsksForNothingBeforeThereIsRoom) {
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  for (std::int64_t k = 1; k <= 7; ++k) {
    queue.push(way.next(0.2, 0, 2, -kMaxFragmentSteps));
    EXPECT_EQ(queue.notified(), k);
  }
  queue.push(way.next(0.2, 0, 2, -kMaxFragmentSteps));
  ASSERT_TRUE(queue.full());
  EXPECT_EQ(queue.notified(), 7);
  queue.advance(1);
  EXPECT_EQ(queue.notified(), 7);
  queue.advance(1);
  EXPECT_EQ(queue.notified(), 8);
}

TEST(FragmentQueue, HeadingGoesOnThroughWholeTurns) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const int turns : {-3, -1, 1, 20}) {
    FragmentQueue queue = queue_at(kOrigin);
    Way way(kOrigin);
    queue.push(way.next(0.2, 0.5, 10));
    Fragment turned = way.next(0, 0, 10);
    for (PathPoint& knot : turned.knot) knot.p.phi += turns * kTurn;
    queue.push(turned);
    EXPECT_NEAR(queue.at(10.001).p.phi, queue.at(9.999).p.phi, 1e-3);
    EXPECT_NEAR(queue.end().p.phi, way.end().p.phi, kExact);
  }
}

TEST(FragmentQueue, DroppedItStandsWhereItWas) {
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  queue.push(way.next(0.5, 0, 10));
  queue.push(way.next(0.5, 0, 10));
  queue.advance(14);
  const PlanarPose p = queue.at(0).p;
  queue.drop();
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.at(0).p.x, p.x);
  EXPECT_EQ(queue.at(0).v, 0);
  EXPECT_EQ(queue.accepted(), 2) << "the numbers go on";
  queue.forget_numbers();
  EXPECT_EQ(queue.accepted() + queue.notified(), 0);
}

TEST(FragmentQueue, AgreesWithTheModelOverRandomFragmentsAndPaces) {
  std::mt19937_64 random(1);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  FragmentQueue queue = queue_at(kOrigin);
  Way way(kOrigin);
  std::vector<Fragment> all;
  std::size_t first = 0;
  double time = 0;
  std::int64_t notified = 0;
  const auto note = [&] {
    if (first < all.size() && time >= all[first].notify - 1e-6) notified = all[first].number;
  };
  for (int k = 0; k < 100'000; ++k) {
    if (pick(20) == 0 && all.size() - first < FragmentQueue::kCapacity) {
      const int steps = 1 + pick(30);
      if (first == all.size()) time = 0;
      all.push_back(way.next(pick(3) * 0.1, pick(3) * 0.1, steps, pick(steps)));
      queue.push(all.back());
      note();
    }
    const double passes = pick(5) / 4.;
    time += passes;
    queue.advance(passes);
    for (note(); first < all.size() && time >= all[first].steps; note()) time -= all[first++].steps;
    ASSERT_EQ(queue.empty(), first == all.size());
    ASSERT_EQ(queue.full(), all.size() - first == FragmentQueue::kCapacity);
    ASSERT_EQ(queue.notified(), notified);
    ASSERT_EQ(queue.accepted(), static_cast<std::int64_t>(all.size()));
    ASSERT_EQ(queue.executing(), first == all.size() ? 0 : all[first].number);
    if (queue.empty()) continue;
    ASSERT_EQ(queue.iteration(), static_cast<int>(time));
    ASSERT_NEAR(queue.at(0).p.x, point_at(all[first], time / all[first].steps).p.x, 1e-6);
  }
}

TEST(Pace, ReachesItsTargetAtItsRate) {
  Pace pace;
  pace.set(1);
  pace.go_to(0.25, 0.1);
  for (int k = 0; k < 7; ++k) {
    EXPECT_NEAR(pace.now(), 1 - 0.1 * k, kExact);
    pace.advance();
  }
  pace.advance();
  EXPECT_EQ(pace.now(), 0.25);
}

TEST(Pace, TimeThatPassesIsTheSumOverTheIterations) {
  for (const double from : {0., 0.33, 1.})
    for (const double to : {0., 0.7, 1.}) {
      Pace pace;
      pace.set(from);
      pace.go_to(to, 0.07);
      const Pace begin = pace;
      double sum = 0;
      for (int k = 1; k <= 40; ++k) {
        sum += pace.passes(1);
        pace.advance();
        EXPECT_NEAR(begin.passes(k), sum, kExact);
        EXPECT_NEAR(begin.after(k), pace.now(), kExact);
      }
    }
}

TEST(Pace, AtFullPaceTimePassesExactly) {
  Pace pace;
  pace.set(1);
  pace.go_to(1);
  EXPECT_EQ(pace.passes(1), 1);
  EXPECT_EQ(pace.passes(320), 320);
}

TEST(Reference, SlowsDownAsThePaceWill) {
  FragmentQueue queue = queue_at(kOrigin);
  PathPoint fast = kOrigin;
  fast.v = 0.8;
  queue.push(Way(fast).next(0.8, 0, 200));
  Pace pace;
  pace.set(1);
  pace.go_to(0, Pace::kStop);
  const Reference r = reference_ahead(queue, pace, 0.05);
  EXPECT_NEAR(r[0].v, 0.8, kExact);
  EXPECT_NEAR(r[4].v, 0.8 / 3, kExact);  // 10 iterations of 15
  EXPECT_NEAR(r[6].v, 0, kExact);
  EXPECT_NEAR(std::hypot(r[20].p.x - 1, r[20].p.y - 2), 0.8 * 0.3 / 2, 1e-6);
}

TEST(Reference, IsDrawnToWithinItsDistanceOfTheEstimate) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<> uniform(-4, 4);
  for (int k = 0; k < 1'000; ++k) {
    Reference r{};
    r.fill({{uniform(random), uniform(random), 3 * uniform(random)}, 0.3, 0.1});
    r[5].p.x += 0.1;
    const PlanarPose p{uniform(random) / 4, uniform(random) / 4, uniform(random)};
    const Reference near = drawn_near(r, p);
    const double before = std::hypot(r[0].p.x - p.x, r[0].p.y - p.y);
    const double after = std::hypot(near[0].p.x - p.x, near[0].p.y - p.y);
    EXPECT_NEAR(after, std::min(before, kMostAway), 1e-9);
    const double turned = wrap_angle(r[0].p.phi - p.phi);
    EXPECT_NEAR(wrap_angle(near[0].p.phi - p.phi), std::clamp(turned, -kMostTurnedAway, kMostTurnedAway),
                1e-9);
    EXPECT_NEAR(near[5].p.x - near[4].p.x, 0.1, 1e-9) << "it is moved as a whole";
    EXPECT_EQ(near[7].v, 0.3);
  }
}

}  // namespace
}  // namespace mrroc::edp::test
