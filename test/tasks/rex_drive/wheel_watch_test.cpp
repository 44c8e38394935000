// How the wheels have turned lately.
#include "tasks/rex_drive/wheel_watch.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {
namespace {

/// Wheels that turn by a milliradian a step.
WheelWatch turning(std::int64_t from, std::int64_t to) {
  WheelWatch watch;
  for (std::int64_t step = from; step <= to; step += 10) {
    const double theta = 1e-3 * static_cast<double>(step);
    watch = watched(watch, wheels_at(step, {theta, -theta, theta, -theta}));
  }
  return watch;
}

TEST(WheelWatch, KnowsTheAnglesOfAStepByTheEstimateNotLongBeforeIt) {
  const WheelWatch watch = turning(100, 200);
  for (const auto& [step, found] :
       {std::pair<std::int64_t, std::int64_t>{100, 100}, {109, 100}, {110, 110}, {209, 200}}) {
    const auto theta = angles_at(watch, step);
    ASSERT_TRUE(theta) << step;
    EXPECT_EQ((*theta)[0], 1e-3 * static_cast<double>(found));
    EXPECT_EQ((*theta)[1], -1e-3 * static_cast<double>(found));
  }
  for (const std::int64_t step : {0, 99, 210}) EXPECT_FALSE(angles_at(watch, step)) << step;
  EXPECT_FALSE(angles_at({}, 100));
}

TEST(WheelWatch, KeepsTheNewestEstimatesEachOnce) {
  WheelWatch watch = turning(0, 1000);
  EXPECT_EQ(watch.size(), 25U);
  EXPECT_EQ(watch.back().step, 1000);
  EXPECT_EQ(watch.front().step, 760);
  watch = watched(watch, wheels_at(1000, {}));
  watch = watched(watch, wheels_at(500, {}));
  EXPECT_EQ(watch.size(), 25U);
  EXPECT_NE(watch.back().theta[0], 0);
}

}  // namespace
}  // namespace mrroc::rex_drive
