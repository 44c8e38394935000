// The record of a visual servo: it joins reports with the truth, and passes over a report that never comes.
#include "tasks/visual_servo/servo_record.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "base/link/memory_bus.hpp"
#include "tasks/visual_servo/program.hpp"

namespace mrroc::visual_servo {
namespace {

constexpr ecp::Pacing kPacing{.n_s = 20, .n_Q = 19};

object_truth_t truth(std::int64_t step, double x, bool present = true) {
  object_truth_t m{};
  m.header.stamp = step / 20;
  m.step = step;
  m.present = present;
  for (const int k : {0, 5, 10}) m.T_0G[k] = m.T_0E[k] = 1;
  m.T_0G[3] = x;
  m.T_0G[11] = 1;
  m.T_0E[11] = 0.5 * x;
  return m;
}

servo_report_t report(std::int64_t step, int m = 1) {
  servo_report_t r{};
  r.step = step;
  r.m = m;
  r.seen[0] = m != kIdle;
  r.e[0] = 0.25;
  r.T_0E[1] = 7;
  r.T_dc[2] = 0.008;
  return r;
}

TEST(ServoRecord, JoinsReportsWithTheTruthOfTheirStep) {
  const Pose T_EGd{Matrix3::Identity(), {0, 0, 0.9}};
  const auto table = join({report(100), report(110, kIdle), report(140)},
                          {truth(80, 0), truth(100, 0.1), truth(120, 0.3), truth(140, 0.3)}, T_EGd, kPacing);
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0].t, 0.2);
  EXPECT_NEAR(table[0].true_e.p.x(), 0.1, 1e-12);
  EXPECT_NEAR(table[0].true_e.p.z(), 1 - 0.9 - 0.05, 1e-12);
  EXPECT_NEAR(table[0].v.x(), 0.2 / 0.04, 1e-9);
  EXPECT_EQ(table[0].e.p.x(), 0.25);
  EXPECT_NEAR(table[0].set_step, 0.0004, 1e-12) << "a twentieth of the control step's";
  EXPECT_EQ(table[1].behaviour, 0);
  EXPECT_NEAR(table[1].true_e.p.x(), 0.2, 1e-12) << "halfway";
  EXPECT_NEAR(table[2].true_e.p.x(), 0.3, 1e-12);
  EXPECT_EQ(table[2].v, Vector3(0, 0, 0));
}

TEST(ServoRecord, TheToolsCameraKnowsTheErrorAsItsPlaceIsBelieved) {
  const Pose D{Matrix3::Identity(), {0, 3e-3, 0}};
  const auto table = join({report(100)}, {truth(100, 0.1), truth(120, 0.1)}, {}, kPacing, D);
  EXPECT_NEAR((table.at(0).known_e.p - table[0].true_e.p - D.p).norm(), 0, 1e-12);
}

TEST(ServoRecord, NumbersBehavioursAsThePaperDoes) {
  const auto table =
      join({report(0, kIdle), report(21, 1), report(42, 2), report(63, 3), report(84, kGiveUp.m)}, {}, {},
           kPacing);
  std::vector<int> numbers;
  for (const ServoRow& row : table) numbers.push_back(row.behaviour);
  EXPECT_EQ(numbers, (std::vector{0, 1, 2, 3, 0}));
}

TEST(ServoRecord, WithoutATruthTheObjectIsNotThere) {
  const auto table =
      join({report(50), report(110), report(500)}, {truth(100, 0, false), truth(120, 0)}, {}, kPacing);
  EXPECT_FALSE(table[0].object_there);
  EXPECT_FALSE(table[1].object_there);
  EXPECT_EQ(table[1].T_0E.p.y(), 7) << "then it is where it was measured";
  EXPECT_TRUE(table[2].object_there) << "the last truth stands";
}

/// A record of MP's that hears what an ECP reports.
class RecordedReports {
 public:
  void take(std::int64_t stamp) {
    out_.publish(report(stamp), stamp);
    mp_.poll();
    record_.collect();
  }
  [[nodiscard]] const auto& collected() const { return record_.reports(); }

 private:
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> mp_bus_{hub_.open()}, ecp_bus_{hub_.open()};
  link::NodeContext context_{.session = "t", .name = "mp", .roster = {"mp"}};
  link::Process mp_{*mp_bus_, context_};
  ServoRecord record_{mp_, "arm1"};
  link::Outbox<servo_report_t> out_{*ecp_bus_, mp_.route("arm1.servo"), context_.session_id};
};

TEST(ServoRecord, CollectsEveryMessageOnceAndWaitsForOneThatIsMissing) {
  RecordedReports reports;
  for (const std::int64_t stamp : {5, 6, 8, 7, 9}) reports.take(stamp);
  ASSERT_EQ(reports.collected().size(), 5u);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(reports.collected()[k].step, static_cast<std::int64_t>(5 + k));
}

TEST(ServoRecord, TellsWhichCamerasSawAndWhatWasRefused) {
  servo_report_t r = report(100);
  r.seen[0] = 0;
  r.seen[1] = 1;
  r.refused = 1;
  const auto table = join({report(79), r}, {}, {}, kPacing);
  EXPECT_TRUE(table[0].sac_seen);
  EXPECT_FALSE(table[0].eih_seen);
  EXPECT_FALSE(table[0].refused);
  EXPECT_FALSE(table[1].sac_seen);
  EXPECT_TRUE(table[1].eih_seen);
  EXPECT_TRUE(table[1].refused);
  EXPECT_EQ(table[1].k, 1);
}

TEST(ServoRecord, AnObjectThatCreepsIsAtRest) {
  const auto speed = [](double metres_per_second) {
    const double way = metres_per_second * 20 * 0.002;
    return join({report(100)}, {truth(100, 0), truth(120, way)}, {}, kPacing).at(0).v.norm();
  };
  EXPECT_EQ(speed(0.9e-4), 0);
  EXPECT_NEAR(speed(1.1e-4), 1.1e-4, 1e-12);
}

TEST(ServoRecord, BetweenTwoTruthsOneOfWhichSaysThatItIsAwayItIsAway) {
  EXPECT_FALSE(join({report(110)}, {truth(100, 0), truth(120, 0, false)}, {}, kPacing)[0].object_there);
  EXPECT_FALSE(join({report(110)}, {truth(100, 0, false), truth(120, 0)}, {}, kPacing)[0].object_there);
  EXPECT_TRUE(join({report(110)}, {truth(100, 0), truth(120, 0)}, {}, kPacing)[0].object_there);
}

// A message that does not come is passed over when eight later ones are there.
TEST(ServoRecord, AMessageThatNeverComesIsNotWaitedForForEver) {
  RecordedReports reports;
  std::vector<std::size_t> collected;
  for (const std::int64_t stamp : {5, 7, 8, 9, 10, 11, 12, 13, 14, 15}) {  // 6 is lost
    reports.take(stamp);
    collected.push_back(reports.collected().size());
  }
  EXPECT_EQ(collected, (std::vector<std::size_t>{1, 1, 1, 1, 1, 1, 1, 1, 9, 10}));
}

}  // namespace
}  // namespace mrroc::visual_servo
