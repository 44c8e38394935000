#include "tasks/visual_servo/servo_record.hpp"

#include <gtest/gtest.h>

#include "base/link/memory_bus.hpp"
#include "tasks/visual_servo/program.hpp"

namespace mrroc::visual_servo {
namespace {

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
  return r;
}

TEST(ServoRecord, JoinsReportsWithTheTruthOfTheirStep) {
  const Pose T_EGd{Matrix3::Identity(), {0, 0, 0.9}};
  const auto table = join({report(100), report(110, kIdle), report(140)},
                          {truth(80, 0), truth(100, 0.1), truth(120, 0.3), truth(140, 0.3)}, T_EGd, 0.002);
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0].t, 0.2);
  EXPECT_NEAR(table[0].true_e.p.x(), 0.1, 1e-12);
  EXPECT_NEAR(table[0].true_e.p.z(), 1 - 0.9 - 0.05, 1e-12);
  EXPECT_NEAR(table[0].v.x(), 0.2 / 0.04, 1e-9);
  EXPECT_EQ(table[0].e.p.x(), 0.25);
  EXPECT_EQ(table[1].behaviour, 0);
  EXPECT_NEAR(table[1].true_e.p.x(), 0.2, 1e-12) << "halfway";
  EXPECT_NEAR(table[2].true_e.p.x(), 0.3, 1e-12);
  EXPECT_EQ(table[2].v, Vector3(0, 0, 0));
}

TEST(ServoRecord, NumbersBehavioursAsThePaperDoes) {
  const auto table = join(
      {report(0, kIdle), report(21, 1), report(42, 2), report(63, 3), report(84, kGiveUp.m)}, {}, {}, 0.002);
  std::vector<int> numbers;
  for (const ServoRow& row : table) numbers.push_back(row.behaviour);
  EXPECT_EQ(numbers, (std::vector{0, 1, 2, 3, 0}));
}

TEST(ServoRecord, WithoutATruthTheObjectIsNotThere) {
  const auto table =
      join({report(50), report(110), report(500)}, {truth(100, 0, false), truth(120, 0)}, {}, 0.002);
  EXPECT_FALSE(table[0].object_there);
  EXPECT_FALSE(table[1].object_there);
  EXPECT_EQ(table[1].T_0E.p.y(), 7) << "then it is where it was measured";
  EXPECT_TRUE(table[2].object_there) << "the last truth stands";
}

TEST(ServoRecord, CollectsEveryMessageOnceAndWaitsForOneThatIsMissing) {
  link::MemoryHub hub;
  const auto mp_bus = hub.open(), ecp_bus = hub.open();
  const link::Membership membership{.session = "t", .name = "mp", .roster = {"mp"}};
  link::Process mp(*mp_bus, membership);
  ServoRecord record(mp, "arm1");
  link::Outbox<servo_report_t> out(*ecp_bus, mp.route("arm1.servo"), membership.session_id);
  for (const std::int64_t stamp : {5, 6, 8, 7, 9}) {
    out.publish(report(stamp), stamp);
    mp.poll();
    record.collect();
  }
  ASSERT_EQ(record.reports().size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(record.reports()[k].step, static_cast<std::int64_t>(5 + k));
}

}  // namespace
}  // namespace mrroc::visual_servo
