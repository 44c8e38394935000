// What every tracker of a platform keeps: equal inputs give equal bits, results are finite whatever comes in, no step
// allocates, torques stay within the limit.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <tuple>

#include "robots/rex/model.hpp"
#include "robots/rex/rex.hpp"
#include "test/heap.hpp"
#include "test/robots/rex/course.hpp"

namespace mrroc::rex::test {
namespace {

struct Input {
  edp::EstimatorResult x;
  Slip slip;
  PerWheel load{};
  std::array<PathPoint, kHorizonPoints> reference{};
};

Input random_input(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Input in;
  in.x.estimate.p = {uniform(random), uniform(random), 3.1 * uniform(random)};
  in.x.estimate.v = {uniform(random), 0.2 * uniform(random), uniform(random)};
  for (double& speed : in.x.estimate.theta_dot) speed = 8 * uniform(random);
  in.x.mass = 40 + 5 * uniform(random);
  in.slip = {0.6 + 0.3 * uniform(random), 0.6 + 0.3 * uniform(random), 0.3 * uniform(random)};
  in.load = standing_load(in.x.mass, in.x.centre);
  const PathPoint p{
      {uniform(random), uniform(random), 10 * uniform(random)}, uniform(random), uniform(random)};
  in.reference.fill(p);
  return in;
}

/// An input of which one number is wrong.
Input damaged_input(std::mt19937& random) {
  Input in = random_input(random);
  const std::array wrong{std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 1e15, 0.0};
  const double value = wrong[std::uniform_int_distribution<std::size_t>(0, wrong.size() - 1)(random)];
  const std::array numbers{
      &in.x.estimate.p.x,   &in.x.estimate.p.phi, &in.x.estimate.v.w, &in.x.estimate.theta_dot[2],
      &in.x.mass,           &in.x.centre.y,       &in.slip.mu_x,      &in.load[1],
      &in.reference[7].p.y, &in.reference[20].v,  &in.reference[0].w};
  *numbers[std::uniform_int_distribution<std::size_t>(0, numbers.size() - 1)(random)] = value;
  return in;
}

bool within_limits(const edp::TrackerResult& r) {
  for (const double torque : r.torque)
    if (!(std::abs(torque) <= platform().properties().max_torque)) return false;
  return true;
}

class Tracker : public ::testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<edp::Tracker> make() { return platform().tracker(GetParam()); }
  static edp::TrackerResult step(edp::Tracker& tracker, const Input& in) {
    return tracker.step(in.x, in.slip, in.load, in.reference);
  }
  std::mt19937 random_{7};
};

/// @param numbers  of nothing but doubles
template <class Numbers>
auto bits_of(const Numbers& numbers) {
  return std::bit_cast<std::array<std::uint64_t, sizeof(Numbers) / sizeof(double)>>(numbers);
}

TEST_P(Tracker, EqualInputsGiveEqualBits) {
  const auto a = make();
  const auto b = make();
  std::ignore = track(*b, pivot(), {});
  const Tracked first = track(*a, figure_eight(20.4), {});
  const Tracked second = track(*b, figure_eight(20.4), {});
  ASSERT_EQ(first.results.size(), second.results.size());
  for (std::size_t i = 0; i < first.results.size(); ++i) {
    ASSERT_EQ(bits_of(first.results[i].torque), bits_of(second.results[i].torque)) << i;
    ASSERT_EQ(bits_of(first.results[i].horizon), bits_of(second.results[i].horizon)) << i;
  }
}

TEST_P(Tracker, TorquesAreFiniteAndWithinTheLimitWhateverComesIn) {
  const auto tracker = make();
  tracker->begin(random_input(random_).x);
  for (int i = 0; i < 2000; ++i) {
    const edp::TrackerResult r = step(*tracker, i % 3 == 0 ? damaged_input(random_) : random_input(random_));
    ASSERT_TRUE(within_limits(r)) << i;
    ASSERT_LE(r.health.iterations, 100);
    if (i % 50 == 0) tracker->begin(damaged_input(random_).x);
  }
  // Nothing of that is left after two steps.
  const Input good = random_input(random_);
  for (int i = 0; i < 2; ++i) std::ignore = step(*tracker, good);
  EXPECT_FALSE(step(*tracker, good).health.solver_failed);
}

TEST_P(Tracker, WhatIsNotFiniteIsToldAsAFailureAndForgotten) {
  const auto tracker = make();
  const Course course = figure_eight(20.4);
  Plant plant({});
  tracker->begin(perfect(plant, {}));
  Input in{perfect(plant, {}), {}, standing_load(kMass, {}), horizon(course, 0)};
  EXPECT_FALSE(step(*tracker, in).health.solver_failed);
  Input wrong = in;
  wrong.x.estimate.p.x = std::nan("");
  wrong.x.estimate.theta_dot.fill(std::nan(""));
  EXPECT_TRUE(step(*tracker, wrong).health.solver_failed);
  EXPECT_FALSE(step(*tracker, in).health.solver_failed);
}

TEST_P(Tracker, NoStepAllocates) {
  const auto tracker = make();
  const Input in = random_input(random_);
  const Input wrong = damaged_input(random_);
  long count = 0;
  {
    const mrroc::test::AllocationCounter heap;
    tracker->begin(in.x);
    for (int i = 0; i < 5; ++i) std::ignore = step(*tracker, in);
    std::ignore = step(*tracker, wrong);
    count = heap.count();
  }
  EXPECT_EQ(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Rex, Tracker,
                         ::testing::ValuesIn(platform().trackers().begin(), platform().trackers().end()),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace mrroc::rex::test
