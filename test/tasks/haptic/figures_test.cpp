#include "tasks/haptic/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mrroc::haptic {
namespace {

/// 8 s around a circle through the air, the slave some macrosteps behind, then 4 s of pressing.
HapticRecord record_of(const Law& law, double lag, double error) {
  HapticRecord record;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * law.macrostep;
    const auto at = [&](double time) {
      const double angle = std::min(time, 8.0);
      return Vector3(0.03 * std::sin(angle), 0.03 * std::cos(angle), 0);
    };
    HapticRow row{.t = t, .x_m = at(t), .x_s = law.motion_scale * at(t - lag * law.macrostep)};
    if (t > 8.5) {
      row.F_s = {10, 0, 0};
      row.F_m = law.force_scale * (1 + error) * row.F_s;
    }
    record.push_back(row);
  }
  return record;
}

TEST(HapticFigures, MeasureTheLagBeyondTheChannelsDelay) {
  for (const double lag : {0.0, 2.5, 4.0, 10.0}) {
    Law law;
    law.motion_scale = 2;
    EXPECT_NEAR(following(record_of(law, lag, 0), law).lag, lag, 0.05);
    law.channel.delay = 0.02;
    EXPECT_NEAR(following(record_of(law, lag + 5, 0), law).lag, lag, 0.05);
  }
}

TEST(HapticFigures, MeasureTheDistanceInTheAir) {
  const Law law;
  EXPECT_NEAR(following(record_of(law, 4, 0), law).rms, 0.03 * 4 * law.macrostep, 1e-5);
}

TEST(HapticFigures, MeasureHowMuchOfTheForceIsFelt) {
  Law law;
  law.force_scale = 0.5;
  EXPECT_NEAR(reflection_error(record_of(law, 0, 0.03), law), 3, 1e-6);
}

TEST(HapticFigures, AreNotMeasuredOfARunThatDidNothing) {
  for (const HapticRecord& record : {HapticRecord{}, HapticRecord(1000)}) {
    EXPECT_TRUE(std::isnan(following(record, {}).lag));
    EXPECT_TRUE(std::isnan(reflection_error(record, {})));
  }
}

}  // namespace
}  // namespace mrroc::haptic
