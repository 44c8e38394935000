// How long a process has been silent: what its supervisor could not hear does not count, and a slow one finds a hang.
#include "mp/silence.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;

constexpr Silence::Clock::time_point kBegun{100s};

/// Looks so often, so far apart. @return what that counts
Silence::Clock::duration looks(int n, Silence::Clock::duration apart) {
  Silence silence(kBegun);
  for (int k = 1; k <= n; ++k) silence.look(kBegun + k * apart);
  return silence.counted();
}

TEST(Silence, CountsAllTimeInWhichSomebodyListens) { EXPECT_EQ(looks(500, 20ms), 10s); }

TEST(Silence, OfATimeInWhichNobodyListensOneSecondCounts) {
  Silence silence(kBegun);
  silence.look(kBegun + 20ms);
  silence.look(kBegun + 1h);
  EXPECT_EQ(silence.counted(), 1020ms);
}

TEST(Silence, ASupervisorThatIsRunOnceASecondOrMoreSeldomFindsAHangToo) {
  EXPECT_EQ(looks(10, 1s), 10s);
  EXPECT_EQ(looks(10, 1001ms), 10s);
  EXPECT_EQ(looks(10, 7s), 10s);
}

TEST(Silence, ASignOfLifeBeginsAnew) {
  Silence silence(kBegun);
  silence.look(kBegun + 900ms);
  silence.hear(kBegun + 950ms);
  EXPECT_EQ(silence.counted(), 0s);
  EXPECT_EQ(silence.heard(), kBegun + 950ms);
  silence.look(kBegun + 960ms);
  EXPECT_EQ(silence.counted(), 10ms);
  EXPECT_EQ(silence.heard(), kBegun + 950ms) << "a look is no sign of life";
}

}  // namespace
}  // namespace mrroc::mp
