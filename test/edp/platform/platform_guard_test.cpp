// What is refused of fragments, with axis, value and limit; which positions and readings of odometry are used.
#include "edp/platform/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

const double kNan = std::nan("");
const double kInf = std::numeric_limits<double>::infinity();
constexpr PathPoint kOrigin{{0, 0, 0}, 0, 0};

struct Expected {
  int axis;
  double value;
  double limit;
};

/// Joins a fragment of the session whose fragments are in the queue.
ValidationError check_next(const Fragment& fragment, const FragmentQueue& queue) {
  return check_join(fragment, queue.accepted() + 1, queue);
}

void expect(const ValidationError& wrong, const Expected& expected) {
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->code, FaultCode::bad_fragment) << wrong->text.view();
  EXPECT_EQ(wrong->axis, expected.axis) << wrong->text.view();
  if (std::isfinite(expected.value)) {
    EXPECT_NEAR(wrong->value, expected.value, 1e-9) << wrong->text.view();
  }
  EXPECT_EQ(wrong->limit, expected.limit) << wrong->text.view();
}

class FragmentGuard : public testing::Test {
 protected:
  FakePlatform platform;
  Fragment good = Way(kOrigin).next(0.5, 0.5, 100, 40);

  [[nodiscard]] ValidationError check(const Fragment& f) const { return check_fragment(f, platform.q); }
};

TEST_F(FragmentGuard, WhatThePlatformCanDoIsAccepted) {
  EXPECT_FALSE(check(good));
  EXPECT_FALSE(check(Way({{0, 0, 0}, 1, 0}).next(1, 0, kMaxFragmentSteps, kMaxFragmentSteps - 1)));
  EXPECT_FALSE(check(Way({{0, 0, 0}, 0.8, 2}).next(0.8, 2, 60))) << "a corner of 0.4 m at 0.8 m/s";
  EXPECT_FALSE(check(Way({{0, 0, 0}, 0, 0}).next(0, 2.5, 20))) << "a turn on the spot";
  EXPECT_FALSE(check(Way({{0, 0, 0}, -1, 0}).next(-1, 0, 1))) << "the shortest one, backwards";
}

TEST_F(FragmentGuard, StepsAndNotifyAreWithinTheirBounds) {
  for (const std::int32_t steps :
       {0, -1, 321, std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()}) {
    Fragment f = good;
    f.steps = steps;
    expect(check(f), {-1, static_cast<double>(steps), 320});
  }
  for (const std::int32_t notify : {100, 101, std::numeric_limits<std::int32_t>::max()}) {
    Fragment f = good;
    f.notify = notify;
    expect(check(f), {-1, static_cast<double>(notify), 99});
  }
  for (const std::int32_t notify : {-321, std::numeric_limits<std::int32_t>::min()}) {
    Fragment f = good;
    f.notify = notify;
    expect(check(f), {-1, static_cast<double>(notify), -320});
  }
  for (const std::int32_t notify : {-320, -1, 0, 99}) {
    Fragment f = good;
    f.notify = notify;
    EXPECT_FALSE(check(f)) << notify;
  }
}

TEST_F(FragmentGuard, EveryNumberOfEveryKnotIsFinite) {
  for (const std::size_t k : {std::size_t{0}, std::size_t{17}, kFragmentKnots - 1})
    for (int axis = 0; axis < 5; ++axis)
      for (const double bad : {kNan, kInf, -kInf}) {
        Fragment f = good;
        PathPoint& knot = f.knot[k];
        const std::array<double*, 5> numbers{&knot.p.x, &knot.p.y, &knot.p.phi, &knot.v, &knot.w};
        *numbers[static_cast<std::size_t>(axis)] = bad;
        expect(check(f), {axis, kNan, 0});
      }
}

TEST_F(FragmentGuard, SpeedsAtTheKnotsAreThePlatforms) {
  expect(check(Way({{0, 0, 0}, 1.001, 0}).next(1.001, 0, 100)), {3, 1.001, 1});
  expect(check(Way({{0, 0, 0}, -1.001, 0}).next(0, 0, 100)), {3, -1.001, 1});
  expect(check(Way({{0, 0, 0}, 0, 2.6}).next(0, 2.6, 100)), {4, 2.6, 2.5});
  expect(check(Way({{0, 0, 0}, 0.95, 2.2}).next(0.95, 2.2, 100)), {4, 0.95 * 2.2, 2});
}

TEST_F(FragmentGuard, SpeedsBetweenTheKnotsAreLimitedToo) {
  Fragment f = good;
  f.knot[20].p.x += 0.3;  // the numbers of the knot itself are good
  ValidationError wrong = check(f);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->axis, 3);
  EXPECT_GT(wrong->value, 1);
  f = good;
  f.knot[20].p.phi += 6.3;
  wrong = check(f);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->axis, 4);
}

TEST_F(FragmentGuard, HugeNumbersAreRefused) {
  Fragment f = good;
  for (PathPoint& knot : f.knot) knot.p.x = 1e300;
  expect(check(f), {0, kNan, 1e5});
  f = good;
  for (PathPoint& knot : f.knot) knot.p.phi += 1e6;
  expect(check(f), {2, kNan, 1000});
}

TEST(JoinGuard, NumbersFollowOneAnother) {
  FragmentQueue queue;
  Fragment f = Way(kOrigin).next(0.2, 0, 10);
  EXPECT_FALSE(check_next(f, queue));
  queue.push(f);
  for (const std::int64_t number : {0, 1, 3, -7}) {
    f.number = number;
    expect(check_next(f, queue), {-1, static_cast<double>(number), 2});
  }
}

TEST(JoinGuard, ThereIsRoomForEight) {
  FragmentQueue queue;
  Way way(kOrigin);
  for (int k = 0; k < 8; ++k) {
    const Fragment f = way.next(0.2, 0, 10);
    EXPECT_FALSE(check_next(f, queue));
    queue.push(f);
  }
  expect(check_next(way.next(0.2, 0, 10), queue), {-1, 9, 8});
}

/// Moves the beginning of a fragment along one axis.
void shift(Fragment& f, int axis, double by) {
  PathPoint& knot = f.knot.front();
  const std::array<double*, 5> numbers{&knot.p.x, &knot.p.y, &knot.p.phi, &knot.v, &knot.w};
  *numbers[static_cast<std::size_t>(axis)] += by;
}

TEST(JoinGuard, AFragmentBeginsWhereTheOneBeforeEnds) {
  FragmentQueue queue;
  Way way(kOrigin);
  queue.push(way.next(0.5, 0.3, 50));
  const Fragment next = way.next(0.5, 0.3, 50);
  const std::array<double, 5> limits{0.02, 0.02, 0.03, 0.1, 0.2};
  for (int axis = 0; axis < 5; ++axis)
    for (const double side : {-1., 1.}) {
      const double limit = limits[static_cast<std::size_t>(axis)];
      Fragment f = next;
      shift(f, axis, side * limit * 0.99);
      EXPECT_FALSE(check_next(f, queue));
      shift(f, axis, side * limit * 0.02);
      expect(check_next(f, queue), {axis, side * limit * 1.01, limit});
    }
}

TEST(JoinGuard, FromRestItMayBeginFartherAway) {
  FragmentQueue queue;
  queue.hold_at({1, 1, 3.1});
  Fragment f = Way({{1.09, 0.91, -3.1}, 0, 0}).next(0.5, 0, 50);
  EXPECT_FALSE(check_next(f, queue)) << "headings differ by the shortest turn";
  shift(f, 0, 0.02);
  expect(check_next(f, queue), {0, 0.11, 0.10});
}

TEST(CommandGuard, PlatformsHaveNoGet) {
  PlatformCommand c;
  for (const Instruction i : {Instruction::get, Instruction::set_get, static_cast<Instruction>(99)}) {
    c.instruction = i;
    ASSERT_TRUE(check_instruction(c));
    EXPECT_EQ(check_instruction(c)->code, FaultCode::unknown_enum);
  }
  c.instruction = Instruction::set;
  EXPECT_FALSE(check_instruction(c));
}

MapPose good_map() { return {100, true, {1, 2, 3}, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}}; }

TEST(MapGuard, PositionsAreOfThePastAndHaveACovariance) {
  EXPECT_TRUE(is_usable(good_map(), 100));
  EXPECT_FALSE(is_usable(good_map(), 99)) << "it was not measured yet";
  for (double bad : {kNan, kInf, 1e6}) {
    MapPose m = good_map();
    m.p.x = bad;
    EXPECT_FALSE(is_usable(m, 100));
  }
  MapPose m = good_map();
  m.p.phi = kNan;
  EXPECT_FALSE(is_usable(m, 100));
  m = good_map();
  m.covariance[4] = -1e-4;
  EXPECT_FALSE(is_usable(m, 100));
  m = good_map();
  m.covariance[1] = 5e-5;
  EXPECT_FALSE(is_usable(m, 100)) << "not symmetric";
  m = good_map();
  m.step = -1;
  EXPECT_FALSE(is_usable(m, 100));
}

OdometryReading good_odometry() {
  OdometryReading r;
  r.step_before = 40;
  r.step = 80;
  r.valid = true;
  const double c = std::cos(0.1);
  const double s = std::sin(0.1);
  r.A = {c, -s, 0, 0.05, s, c, 0, 0.01, 0, 0, 1, 0};
  for (std::size_t k = 0; k < 6; ++k) r.covariance[k * 7] = 1e-6;
  return r;
}

TEST(OdometryGuard, MotionsAreShortAndProper) {
  EXPECT_TRUE(is_usable(good_odometry(), 80));
  EXPECT_FALSE(is_usable(good_odometry(), 79));
  OdometryReading r = good_odometry();
  r.A[3] = 1.01;
  EXPECT_FALSE(is_usable(r, 80)) << "too far";
  r = good_odometry();
  r.A[0] = -r.A[0];
  EXPECT_FALSE(is_usable(r, 80)) << "no rotation";
  r = good_odometry();
  r.A[7] = kNan;
  EXPECT_FALSE(is_usable(r, 80));
  r = good_odometry();
  r.step_before = 80;
  EXPECT_FALSE(is_usable(r, 80)) << "no time between";
  r = good_odometry();
  r.covariance[35] = 0;
  EXPECT_FALSE(is_usable(r, 80));
}

TEST(PaceGuard, APaceIsBetweenStandingAndAsPlanned) {
  for (const double pace : {0., 0.5, 1.}) EXPECT_TRUE(is_pace(pace));
  for (const double pace : {-0.01, 1.01, kNan, kInf}) EXPECT_FALSE(is_pace(pace));
}

}  // namespace
}  // namespace mrroc::edp::test
