#include "tasks/move/figures.hpp"

#include <gtest/gtest.h>

#include "tasks/move/plots.hpp"
#include "test/tasks/move/straight_arm.hpp"

namespace mrroc::any_motion {
namespace {

Plan two_motions() {
  return plan_of_text(R"([arm1]
order = ["a", "b"]
[arm1.a]
positions = [0.2, 0, 0, 0, 0, 0]
[arm1.b]
positions = [0.2, 0.1, 0, 0, 0, 0]
)");
}

/// An arm that follows two macrosteps late, and rests with an error along z and about it.
mp::ArmTrace executed(const ArmPlan& plan, double off, double turned) {
  mp::ArmTrace trace;
  const auto add = [&](int m, const Vector6& pose) {
    mp::ArmRow& r = trace.emplace_back();
    r.m = m;
    r.pose = pose;
    r.t = 0.02 * static_cast<double>(trace.size());
  };
  for (int k = 0; k < 5; ++k) add(2, Vector6::Zero());
  for (const PlannedMotion& m : plan.motions) {
    for (std::size_t k = 0; k + 1 < m.joints.size(); ++k) add(4, m.joints[k > 2 ? k - 2 : 0].head<6>());
    Vector6 end = m.joints.back().head<6>();
    add(2, end + Vector6::Constant(0.01));  // on its way
    end[2] += off;
    end[5] += turned;
    add(2, end);
  }
  return trace;
}

TEST(MoveFigures, TheErrorOfAGoalIsThatAtTheEndOfTheRestBehindIt) {
  const Plan plan = two_motions();
  const auto errors = goal_errors(executed(plan.arms[0], 3e-4, 0.01), plan.arms[0]);
  ASSERT_EQ(errors.size(), 2U);
  for (const PoseError& e : errors) {
    EXPECT_NEAR(e.mm, 0.3, 1e-9);
    EXPECT_NEAR(e.deg, 0.01 * 180 / M_PI, 1e-9);
  }
}

TEST(MoveFigures, AnArmThatIsLateOnItsWayHasNotLeftIt) {
  const Plan plan = two_motions();
  mp::ArmTrace trace = executed(plan.arms[0], 0, 0);
  EXPECT_NEAR(path_error_mm(trace, plan.arms[0]), 0, 1e-9);
  trace[20].pose[2] += 2e-3;
  EXPECT_NEAR(path_error_mm(trace, plan.arms[0]), 2, 1e-9);
}

TEST(MoveFigures, ARunThatEndedEarlyHasTheErrorsOfWhatItDid) {
  const Plan plan = two_motions();
  EXPECT_TRUE(goal_errors({}, plan.arms[0]).empty());
  EXPECT_TRUE(std::isnan(path_error_mm({}, plan.arms[0])));
  const auto f = figures({{}, {}}, plan);
  EXPECT_EQ(std::get<std::vector<double>>(mp::figure(f, "motion_s")).size(), 1U)
      << "an arm that rests has none";
}

TEST(MoveFigures, ThePictureHasTheMotionsThatWereExecuted) {
  const Plan plan = two_motions();
  const mp::ArmTrace trace = executed(plan.arms[0], 0, 0);
  TimeChart chart = motion_chart(trace, plan.arms[0]);
  ASSERT_EQ(chart.panels.size(), 3U);
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const auto& m = plan.arms[0].motions;
  EXPECT_EQ(lines(chart.data), static_cast<long>(m[0].joints.size() + m[1].joints.size()) + 4);
  const mp::ArmTrace half(trace.begin(), trace.begin() + 10);
  EXPECT_EQ(lines(motion_chart(half, plan.arms[0]).data), 5 + 1 + 3);
  chart.to = 1;
  EXPECT_NE(time_chart_script(chart).find("$motions using 1:2"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::any_motion
