#include "tasks/haptic/config.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/config.hpp"

namespace mrroc::haptic {
namespace {

TEST(HapticConfig, ReadsTheChannelWithTheSeedOfTheRun) {
  const Parameters k = read_parameters(
      Config::parse("seed = 7\n[task]\ndelay = 0.1\njitter = 0.02\nloss = 0.1\npassivity = false\n", "test"));
  EXPECT_EQ(k.law.channel.delay, 0.1);
  EXPECT_EQ(k.law.channel.jitter, 0.02);
  EXPECT_EQ(k.law.channel.loss, 0.1);
  EXPECT_EQ(k.law.channel.seed, 7U);
  EXPECT_FALSE(k.law.passivity.control);
}

TEST(HapticConfig, RefusesWhatIsOutOfRange) {
  for (const std::string line :
       {"delay = 0.3", "loss = 0.9", "jitter = -1", "motion_scale = 0", "force_scale = 100",
        "master_mobility = 1", "return_rate = 0", "start_energy = 0.1"})
    EXPECT_THROW(read_parameters(Config::parse("[task]\n" + line, "test")), FaultError) << line;
  EXPECT_THROW(read_operator(Config::parse("[operator]\npush = 100", "test"), {}), FaultError);
}

}  // namespace
}  // namespace mrroc::haptic
