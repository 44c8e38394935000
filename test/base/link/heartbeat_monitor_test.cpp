// Time of silence: time in which the supervisor could not hear does not count, and a slow supervisor finds a
// hang.
#include "base/link/heartbeat_monitor.hpp"

#include <gtest/gtest.h>

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;

constexpr HeartbeatMonitor::Clock::time_point kBegun{100s};

/// Looks so often, so far apart. @return what that counts
HeartbeatMonitor::Clock::duration looks(int n, HeartbeatMonitor::Clock::duration apart) {
  HeartbeatMonitor monitor(kBegun);
  for (int k = 1; k <= n; ++k) monitor.look(kBegun + k * apart);
  return monitor.counted();
}

TEST(HeartbeatMonitor, CountsAllTimeInWhichSomebodyListens) { EXPECT_EQ(looks(500, 20ms), 10s); }

TEST(HeartbeatMonitor, OfATimeInWhichNobodyListensOneSecondCounts) {
  HeartbeatMonitor monitor(kBegun);
  monitor.look(kBegun + 20ms);
  monitor.look(kBegun + 1h);
  EXPECT_EQ(monitor.counted(), 1020ms);
}

TEST(HeartbeatMonitor, ASupervisorThatIsRunOnceASecondOrMoreSeldomFindsAHangToo) {
  EXPECT_EQ(looks(10, 1s), 10s);
  EXPECT_EQ(looks(10, 1001ms), 10s);
  EXPECT_EQ(looks(10, 7s), 10s);
}

TEST(HeartbeatMonitor, TheBoundIsTheListenersToChoose) {
  HeartbeatMonitor monitor(kBegun, 100ms);
  EXPECT_EQ(monitor.look(kBegun + 30ms), 30ms);
  EXPECT_EQ(monitor.look(kBegun + 45s), 100ms) << "the listener was suspended";
  EXPECT_EQ(monitor.counted(), 130ms);
}

TEST(HeartbeatMonitor, ASignOfLifeBeginsAnew) {
  HeartbeatMonitor monitor(kBegun);
  monitor.look(kBegun + 900ms);
  monitor.hear(kBegun + 950ms);
  EXPECT_EQ(monitor.counted(), 0s);
  EXPECT_EQ(monitor.heard(), kBegun + 950ms);
  monitor.look(kBegun + 960ms);
  EXPECT_EQ(monitor.counted(), 10ms);
  EXPECT_EQ(monitor.heard(), kBegun + 950ms) << "a look is no sign of life";
}

}  // namespace
}  // namespace mrroc::link
