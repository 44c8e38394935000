// What is written down about a step.
#include "edp/platform/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

TEST(PlatformRecord, HasANumberForEveryColumn) {
  PlatformRig rig;
  ASSERT_TRUE(rig.synchronise());
  rig.macrostep(rig.set(rig.way().next(0.3, 0, 50)));
  rig.wait(10);
  const PlatformReading reading = rig.ground.reading();
  const PlatformStepRecord record = record_of(rig.driver, reading, rig.driver.step(reading));
  std::string line;
  record.append(line, PlatformDriver::kStep);
  const std::string header = PlatformStepRecord::header();
  EXPECT_EQ(std::ranges::count(header, ','), std::ranges::count(line, ','));
  EXPECT_EQ(header.back(), '\n');
  EXPECT_EQ(line.back(), '\n');
  EXPECT_NE(line.find(",executing,none,"), std::string::npos) << line;
  EXPECT_NEAR(record.p.x, rig.driver.wanted().p.x, 0.05);
  EXPECT_TRUE(record.enabled);
}

}  // namespace
}  // namespace mrroc::edp::test
