// What the shell wants of a driver: one that lacks a member, or whose member gives something else, is none.
#include "edp/stepped_driver.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/effector.hpp"
#include "edp/driver.hpp"
#include "edp/platform/driver.hpp"

namespace mrroc::edp::test {
namespace {

template <class D>
constexpr bool kServes = SteppedDriver<D, ArmEffector>;

struct WithoutTake : Driver {
  void take() = delete;
};
struct WithoutStep : Driver {
  void step() = delete;
};
struct WithoutTrip : Driver {
  void trip() = delete;
};
struct WithoutDropOwner : Driver {
  void drop_owner() = delete;
};
struct WithoutStandstill : Driver {
  void standstill() = delete;
};
struct WithoutOwner : Driver {
  void owned_by_another() = delete;
};
struct WithoutProtocol : Driver {
  void protocol() = delete;
};

TEST(SteppedDriver, IsWhatHasEveryMemberThatTheShellCalls) {
  EXPECT_TRUE(kServes<Driver>);
  EXPECT_TRUE((SteppedDriver<PlatformDriver, PlatformEffector>));
  EXPECT_FALSE(kServes<WithoutTake>);
  EXPECT_FALSE(kServes<WithoutStep>);
  EXPECT_FALSE(kServes<WithoutTrip>) << "an emergency stop could not reach it";
  EXPECT_FALSE(kServes<WithoutDropOwner>);
  EXPECT_FALSE(kServes<WithoutStandstill>);
  EXPECT_FALSE(kServes<WithoutOwner>);
  EXPECT_FALSE(kServes<WithoutProtocol>);
}

struct GivesNoDrive : Driver {
  void step(const HardwareReading& /*reading*/) {}
};
struct CountsBoundaries : Driver {
  [[nodiscard]] int at_boundary() const { return 1; }
};
struct CountsInWide : Driver {
  [[nodiscard]] std::int64_t macrostep_steps() const { return 1; }
};
struct CountsReplies : Driver {
  [[nodiscard]] int reply_due() const { return 1; }
};
struct CopiesReplies : Driver {
  [[nodiscard]] EffectorReply reply() const { return {}; }
};
struct NumbersStates : Driver {
  [[nodiscard]] int state() const { return 0; }
};
struct CopiesFaults : Driver {
  [[nodiscard]] Fault fault() const { return {}; }
};

TEST(SteppedDriver, EveryMemberGivesWhatTheShellTakes) {
  EXPECT_FALSE(kServes<GivesNoDrive>);
  EXPECT_FALSE(kServes<CountsBoundaries>);
  EXPECT_FALSE(kServes<CountsInWide>);
  EXPECT_FALSE(kServes<CountsReplies>);
  EXPECT_FALSE(kServes<CopiesReplies>);
  EXPECT_FALSE(kServes<NumbersStates>);
  EXPECT_FALSE(kServes<CopiesFaults>);
}

TEST(SteppedDriver, ADriverServesItsOwnKindOfEffectorOnly) {
  EXPECT_FALSE((SteppedDriver<Driver, PlatformEffector>));
  EXPECT_FALSE((SteppedDriver<PlatformDriver, ArmEffector>));
}

}  // namespace
}  // namespace mrroc::edp::test
