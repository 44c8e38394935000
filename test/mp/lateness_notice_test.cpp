// Frequency of the notices that a host is too slow.
#include "mp/lateness_notice.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;

TEST(LatenessNotice, TellsWhatIsNewAndNotMoreOftenThanEveryTenSeconds) {
  LatenessNotice notice;
  LatenessNotice::Clock::time_point now(1h);
  EXPECT_FALSE(notice.look(now, 0)) << "nothing is late";
  EXPECT_EQ(notice.look(now, 3),
            "late periods: 3 more, 3 in all; this host is too slow or too busy for --clock wall");
  EXPECT_FALSE(notice.look(now += 9s, 5)) << "too soon";
  EXPECT_EQ(notice.look(now += 1s, 5),
            "late periods: 2 more, 5 in all; this host is too slow or too busy for --clock wall");
  EXPECT_FALSE(notice.look(now += 1h, 5)) << "no news";
}

}  // namespace
}  // namespace mrroc::mp
