#include "tasks/rex_drive/drive_record.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mrroc::rex_drive {
namespace {

/// x = 0.01 per macrostep, told by truth, reply and telemetry of macrosteps 1..n.
DriveMessages messages(int n) {
  DriveMessages m;
  for (int i = 1; i <= n; ++i) {
    PlatformTruth truth;
    truth.p.x = 0.01 * i;
    m.truths.push_back(to_message(truth));
    m.truths.back().header.stamp = i;
    PlatformReply reply;
    reply.position_known = true;
    reply.step = 10 * i + 9;
    reply.estimate.step = 10 * i;
    reply.estimate.p.x = 0.01 * i + 0.002;
    reply.executing = 1;
    m.replies.push_back(to_message(reply));
    m.replies.back().header.stamp = i + 1;
    PlatformTelemetry telemetry;
    telemetry.step = 10 * i + 9;
    telemetry.reference[0].x = 0.01 * i - 0.003;
    m.telemetry.push_back(to_message(telemetry));
    m.telemetry.back().header.stamp = i + 1;
  }
  return m;
}

TEST(DriveRecord, JoinsWhatIsOfTheSameReading) {
  const DriveTable table = join(messages(20), 0.002, 10);
  ASSERT_EQ(table.size(), 20U);
  for (const DriveRow& row : table) {
    EXPECT_NEAR(tracking_error(row), 0.003, 1e-12);
    EXPECT_NEAR(estimation_error(row), 0.002, 1e-12);
  }
  EXPECT_NEAR(table[4].t, 0.1, 1e-12);
}

TEST(DriveRecord, TellsThePaceOfTheMacrostepOfTheReading) {
  DriveMessages m = messages(20);
  m.paces = {{3, 1}, {4, 0.7}, {6, 0}};
  const DriveTable table = join(m, 0.002, 10);
  EXPECT_EQ(table[2].pace, 1);
  EXPECT_EQ(table[3].pace, 0.7);
  EXPECT_EQ(table[4].pace, 1) << "a command that was not heard says nothing";
  EXPECT_EQ(table[5].pace, 0);
}

TEST(DriveRecord, LeavesOutWhatHasNoTruthOrNoTelemetry) {
  DriveMessages m = messages(20);
  m.truths.erase(m.truths.begin() + 5);
  m.telemetry.erase(m.telemetry.begin() + 9);
  EXPECT_EQ(join(m, 0.002, 10).size(), 18U);
  m.truths.clear();
  EXPECT_TRUE(join(m, 0.002, 10).empty());
}

TEST(DriveRecord, HasTheSameRowsHoweverMuchOfTheEndHasCome) {
  DriveMessages early = messages(20), late = messages(23);
  early.cut_after(18);
  late.cut_after(18);
  ASSERT_EQ(join(early, 0.002, 10).size(), 17U) << "a reply is stamped one macrostep later than its reading";
  EXPECT_EQ(join(late, 0.002, 10).size(), 17U);
}

TEST(DriveRecord, TheMapIsBackWhenItIsSeenAfterItWasLost) {
  DriveMessages m;
  for (const int valid : {0, 0, 1, 1, 0, 0, 1, 1, 0}) {
    MapReport report;
    report.pose.valid = valid != 0;
    m.poses.push_back(to_message(report));
    m.poses.back().header.stamp = static_cast<std::int64_t>(m.poses.size());
  }
  const std::vector<double> times = map_returns(m, 0.002, 10);
  ASSERT_EQ(times.size(), 1U) << "at first it was not there";
  EXPECT_NEAR(times[0], 0.14, 1e-12);
}

TEST(DriveRecord, TheMapIsBackAlsoWhenItIsBelievedAfterItHasJumpedButNotAfterOneOutlier) {
  DriveMessages m;
  struct Said {
    std::int64_t step;
    std::int32_t rejected;
  };
  for (const Said said : {Said{50, 0}, {50, 1}, {150, 1}, {150, 2}, {150, 3}, {300, 3}, {350, 3}}) {
    MapReport report;
    report.pose.valid = true;
    report.pose.step = said.step;
    report.rejected = said.rejected;
    m.poses.push_back(to_message(report));
    m.poses.back().header.stamp = static_cast<std::int64_t>(m.poses.size());
  }
  const std::vector<double> times = map_returns(m, 0.002, 10);
  ASSERT_EQ(times.size(), 1U);
  EXPECT_NEAR(times[0], 0.12, 1e-12);
}

TEST(DriveRecord, BetweenTwoTruthsThePlatformMovesEvenly) {
  DriveMessages m = messages(20);
  for (auto& reply : m.replies) reply.estimate.step += 5;
  const DriveTable table = join(m, 0.002, 10);
  ASSERT_EQ(table.size(), 19U) << "the last one has no truth behind it";
  EXPECT_NEAR(table[0].truth.p.x, 0.015, 1e-12);
}

TEST(DriveRecord, BetweenTwoTruthsPlaceHeadingAndSpeedsAreSharesOfBothOnTheShorterTurn) {
  struct Turn {
    double from, to, at_three_tenths;
  };
  for (const Turn& turn :
       {Turn{0.1, 0.6, 0.25}, Turn{0.6, 0.1, 0.45}, Turn{3.1, -3.1, 3.1 + 0.3 * (2 * std::numbers::pi - 6.2)},
        Turn{-3.1, 3.1, -3.1 - 0.3 * (2 * std::numbers::pi - 6.2)}}) {
    DriveMessages m = messages(2);
    m.replies[0].estimate.step += 3;
    PlatformTruth before, after;
    before.p = {1, -2, turn.from};
    before.v = {0.1, 0.2, -0.3};
    after.p = {2, -4, turn.to};
    after.v = {0.4, -0.1, 0.7};
    m.truths = {to_message(before), to_message(after)};
    m.truths[0].header.stamp = 1;
    m.truths[1].header.stamp = 2;
    const DriveTable table = join(m, 0.002, 10);
    ASSERT_FALSE(table.empty());
    const PlatformTruth& truth = table[0].truth;
    EXPECT_NEAR(truth.p.x, 1.3, 1e-12);
    EXPECT_NEAR(truth.p.y, -2.6, 1e-12);
    EXPECT_NEAR(truth.p.phi, turn.at_three_tenths, 1e-12) << turn.from << " to " << turn.to;
    EXPECT_NEAR(truth.v.vx, 0.19, 1e-12);
    EXPECT_NEAR(truth.v.vy, 0.11, 1e-12);
    EXPECT_NEAR(truth.v.w, 0, 1e-12);
  }
}

}  // namespace
}  // namespace mrroc::rex_drive
