#include "mp/trace_recorder.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/latency.hpp"

namespace mrroc::mp {
namespace {

/// A chain of agents as docs/timing.md tells of it, without links: what was decided when, and what the reports bring.
struct History {
  explicit History(unsigned seed) : random(seed) {
    for (int k = 0; k < 60; ++k) decided.push_back(std::uniform_int_distribution(0, 3)(random));
  }
  /// @return report that the coordinator reads in macrostep i, of a transparent or an independent agent
  [[nodiscard]] Report report(std::int64_t i, bool own_numbers) const {
    Report r;
    r.ready = true;
    // Decided by the agent one macrostep ago.
    if (own_numbers && i >= 1) r.m = decided[static_cast<std::size_t>(i - 1)];
    r.T_0E[0] = static_cast<double>(i);
    return r;
  }
  std::mt19937 random;
  std::vector<int> decided;  // m in macrostep k
};

TEST(TraceRecorder, ARowHasTheBehaviourThatOrderedTheMotionItsReadingIsOf) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const History told(seed);
    TraceRecorder recorder(1, TraceNumbers::coordinator, 0.002, 10);
    std::vector<ArmTrace> traces(1);
    for (std::int64_t i = 1; i < 60; ++i) {
      // The orders that are used in macrostep i were decided in i - 1.
      recorder.note(i, told.decided[static_cast<std::size_t>(i - 1)], std::vector{told.report(i, false)});
      recorder.add_rows(traces);
      const int executed = i >= latency::kLoop ? told.decided[static_cast<std::size_t>(i - 4)] : 0;
      ASSERT_EQ(traces[0].back().m, executed) << "seed " << seed << ", macrostep " << i;
      EXPECT_EQ(recorder.executed(0), executed);
    }
  }
}

TEST(TraceRecorder, ARowHasTheBehaviourInWhichTheAgentCommandedTheMotion) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const History told(seed);
    TraceRecorder recorder(1, TraceNumbers::agents, 0.002, 10);
    std::vector<ArmTrace> traces(1);
    for (std::int64_t i = 1; i < 60; ++i) {
      recorder.note(i, 77, std::vector{told.report(i, true)});
      recorder.add_rows(traces);
      // Reported in i about the motion in i - 2, which was commanded in i - 3.
      const int executed = i >= 3 ? told.decided[static_cast<std::size_t>(i - 3)] : 0;
      ASSERT_EQ(traces[0].back().m, executed) << "seed " << seed << ", macrostep " << i;
    }
  }
}

TEST(TraceRecorder, ARowIsOfTheStepInWhichItsReadingWasTaken) {
  TraceRecorder recorder(1, TraceNumbers::agents, 0.002, 8);
  std::vector<ArmTrace> traces(1);
  Report r;
  r.ready = true;
  r.F_a[Axis::z] = 3;
  r.gripper = 0.05;
  r.blocked = true;
  recorder.note(12, 0, std::vector{r});
  recorder.add_rows(traces);
  ASSERT_EQ(traces[0].size(), 1U);
  EXPECT_EQ(traces[0][0].i, 12);
  EXPECT_DOUBLE_EQ(traces[0][0].t, (10 * 8 + 7) * 0.002);
  EXPECT_EQ(traces[0][0].F[Axis::z], 3);
  EXPECT_EQ(traces[0][0].gap, 0.05);
  EXPECT_TRUE(traces[0][0].blocked);
}

TEST(TraceRecorder, AnArmThatIsNotReadyHasNoRow) {
  TraceRecorder recorder(2, TraceNumbers::agents, 0.002, 10);
  std::vector<ArmTrace> traces(2);
  Report ready;
  ready.ready = true;
  recorder.note(1, 0, std::vector{Report{}, ready});
  recorder.add_rows(traces);
  EXPECT_TRUE(traces[0].empty());
  EXPECT_EQ(traces[1].size(), 1U);
}

}  // namespace
}  // namespace mrroc::mp
