// The simple tracker of Rex in closed loops.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "robots/rex/kinematic_tracker.hpp"
#include "robots/rex/parameters.hpp"
#include "test/robots/rex/course.hpp"

namespace mrroc::rex::test {
namespace {

constexpr double kSlowLap = 20.4;

TEST(KinematicTracker, FollowsAFigureEightAsWellAsAKinematicLawCan) {
  KinematicTracker tracker;
  const Tracked t = track(tracker, figure_eight(kSlowLap), {});
  EXPECT_LT(t.rms, 0.10);
  EXPECT_LT(t.max, 0.20);
  EXPECT_LE(t.largest_torque, kMaxTorque);
}

TEST(KinematicTracker, TurnsOnTheSpotAndComesToRest) {
  KinematicTracker tracker;
  const Tracked t = track(tracker, pivot(), {});
  EXPECT_LT(t.max, 0.20);
  const PerWheel torque = t.results.back().torque;
  for (const double each : torque) EXPECT_LT(std::abs(each), kMaxTorque / 2);
}

TEST(KinematicTracker, BeginsWithoutWhatWasBefore) {
  KinematicTracker used;
  std::ignore = track(used, pivot(), {});
  KinematicTracker fresh;
  const Tracked a = track(used, pivot(), {});
  const Tracked b = track(fresh, pivot(), {});
  EXPECT_EQ(a.rms, b.rms);
}

}  // namespace
}  // namespace mrroc::rex::test
