// A platform that does not get to where it is to be.
#include "edp/platform/follow_watch.hpp"

#include <gtest/gtest.h>

namespace mrroc::edp::test {
namespace {

Reference at(double x) {
  Reference r{};
  for (PathPoint& point : r) point.p.x = x;
  return r;
}

TEST(FollowWatch, APlatformThatIsHeldBackForASecondIsFound) {
  for (const double sign : {1.0, -1.0}) {
    FollowWatch watch;
    for (int k = 1; k < FollowWatch::kLong; ++k)
      ASSERT_FALSE(watch.step(at(sign * (kMostAway + 0.001)), {})) << k;
    const auto fault = watch.step(at(sign * (kMostAway + 0.001)), {});
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->code, FaultCode::estimate_lost);
    EXPECT_NEAR(fault->value, kMostAway + 0.001, 1e-12);
    EXPECT_EQ(fault->limit, kMostAway);
  }
}

TEST(FollowWatch, CountsInSuccessionAndWhileItIsDrivenOnly) {
  FollowWatch watch;
  const Reference far = at(1), near = at(kMostAway);
  for (int k = 0; k < 10 * FollowWatch::kLong; ++k)
    ASSERT_FALSE(watch.step(k % FollowWatch::kLong == FollowWatch::kLong - 1 ? near : far, {})) << k;
  for (int k = 0; k < 10 * FollowWatch::kLong; ++k) {
    if (k % (FollowWatch::kLong - 1) == 0) watch.forget();
    ASSERT_FALSE(watch.step(far, {})) << k;
  }
}

}  // namespace
}  // namespace mrroc::edp::test
