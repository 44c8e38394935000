// Readings of sensors with clocks of their own.
#include "base/link/clocked_inbox.hpp"

#include <gtest/gtest.h>

#include "base/msg/convert_platform.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

constexpr SensorClock kClock{.period = 40, .latency = 60};

class ClockedInboxTest : public ::testing::Test {
 protected:
  void begin(ClockKind clock) {
    NodeContext m{.session = "s", .session_id = 1, .name = "ecp", .roster = {"mp", "ecp"}};
    m.clock = clock;
    process_.emplace(bus_, m);
    readings_.emplace(*process_, "rex.odometry", kClock);
    out_ = process_->outbox<odometry_reading_t>("rex.odometry");
  }
  void send(std::int64_t n) {
    OdometryReading r;
    r.step_before = 40 * n - 40;
    r.step = 40 * n;
    out_->publish(to_message(r), n);
  }

  test::DirectBus bus_;
  std::optional<Process> process_;
  std::optional<ClockedInbox<odometry_reading_t>> readings_;
  std::unique_ptr<Outbox<odometry_reading_t>> out_;
};

TEST(SensorClock, AReadingIsVisibleItsLatencyAfterItWasTaken) {
  EXPECT_EQ(kClock.newest(0), -1);
  EXPECT_EQ(kClock.newest(59), -1);
  EXPECT_EQ(kClock.newest(60), 0);
  EXPECT_EQ(kClock.newest(99), 0);
  EXPECT_EQ(kClock.newest(100), 1);
  EXPECT_EQ((SensorClock{.period = 20, .latency = 0}).newest(19), 0);
  EXPECT_EQ((SensorClock{.period = 20, .latency = 0}).newest(20), 1);
}

TEST_F(ClockedInboxTest, InLockStepTheVisibleReadingIsTakenAndNoNewerOne) {
  begin(ClockKind::step);
  EXPECT_TRUE(readings_->here(59)) << "none is visible";
  EXPECT_FALSE(readings_->at(59));
  EXPECT_FALSE(readings_->here(60));
  send(0);
  send(1);
  EXPECT_TRUE(readings_->here(60));
  ASSERT_TRUE(readings_->at(99));
  EXPECT_EQ(readings_->at(99)->step, 0);
  EXPECT_EQ(readings_->at(100)->step, 40);
  EXPECT_FALSE(readings_->here(140));
}

TEST_F(ClockedInboxTest, ByTheWallClockTheNewestIsTaken) {
  begin(ClockKind::wall);
  EXPECT_FALSE(readings_->at(500));
  send(0);
  send(3);
  ASSERT_TRUE(readings_->at(60));
  EXPECT_EQ(readings_->at(60)->step, 120);
}

TEST_F(ClockedInboxTest, WhatIsNotProperIsAFault) {
  begin(ClockKind::step);
  OdometryReading r;
  r.step = 40;
  r.valid = true;  // without a rotation
  out_->publish(to_message(r), 0);
  try {
    (void)readings_->at(60);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::malformed_message);
  }
}

}  // namespace
}  // namespace mrroc::link
