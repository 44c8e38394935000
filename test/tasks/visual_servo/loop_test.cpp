// The whole loop in lock-step, with cameras that are as inexact as real ones.
#include <gtest/gtest.h>

#include "test/tasks/visual_servo/synthetic_cell.hpp"

namespace mrroc::visual_servo::test {
namespace {

constexpr std::array kMethods{Aggregation::mean, Aggregation::switching, Aggregation::weights};

/// E is so far from its goal when the task begins [m].
constexpr double kWay = 0.33;

/// An arm that sees the object with the SAC at first, 0.33 m from its goal, and hides it from the SAC in the end: fig. 28.
CellParameters as_in_fig_28(Aggregation method = Aggregation::mean, unsigned seed = 1) {
  CellParameters p;
  p.k.aggregation = method;
  p.seed = seed;
  const Pose goal = p.object(0) * p.k.T_EGd.inverse();
  const Vector3 way = Vector3(-0.6, 0.3, 0.74).normalized() * kWay;
  p.T_0E = {goal.R * rotation_from_angle_axis({0.05, -0.1, 0.3}), goal.p + way};
  p.hidden = [goal](Camera camera, double, const Pose& T_0E, const Pose&) {
    return camera == Camera::sac && (T_0E.p - goal.p).norm() < 0.02;
  };
  return p;
}

/// Farthest beyond the goal, of the way.
double overshoot(const SyntheticCell& cell, const Vector3& goal) {
  const Vector3 way = goal - cell.rows.front().T_0E.p;
  double beyond = 0;
  for (const auto& row : cell.rows)
    beyond = std::max(beyond, (row.T_0E.p - goal).dot(way) / way.squaredNorm());
  return beyond;
}

TEST(ServoLoop, ReachesTheGoalAsFastAsThePaperWithEveryAggregation) {
  for (const Aggregation method : kMethods)
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const CellParameters p = as_in_fig_28(method, seed);
      SyntheticCell cell(p);
      ASSERT_EQ(cell.run(), Outcome::terminated);
      EXPECT_NEAR(cell.rows.front().true_mm, 1e3 * kWay, 1);
      ASSERT_GE(cell.steps_to(2), 0);
      EXPECT_LE(cell.steps_to(2), 80);
      EXPECT_LE(overshoot(cell, p.object(0) * p.k.T_EGd.inverse() * Vector3::Zero()), 0.1);
      EXPECT_LE(cell.worst_mm(25), 1);
    }
}

TEST(ServoLoop, GoesThroughTheBehavioursOfFig28) {
  SyntheticCell cell(as_in_fig_28());
  ASSERT_EQ(cell.run(), Outcome::terminated);
  std::vector<int> order;
  for (const auto& row : cell.rows)
    if (order.empty() || order.back() != row.m) order.push_back(row.m);
  EXPECT_EQ(order, (std::vector{kIdle, 1, 3, 2}));
}

TEST(ServoLoop, MovesSmoothlyFromStepToStep) {
  const CellParameters p = as_in_fig_28();
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  const double step = p.k.pacing.macrostep_s();
  for (std::size_t k = 1; k < cell.rows.size(); ++k)
    EXPECT_LE((cell.rows[k].T_dc.p - cell.rows[k - 1].T_dc.p).norm(),
              p.k.regulator.acceleration * step * step + 1e-4)
        << k;
}

TEST(ServoLoop, FollowsAnObjectOnALine) {
  for (const Aggregation method : kMethods) {
    CellParameters p = as_in_fig_28(method);
    p.hidden = [](auto&&...) { return false; };
    p.object = [](double t) { return object_at(1, -0.3 + 0.1 * t, 0.05); };
    p.k.duration = 150;
    SyntheticCell cell(p);
    ASSERT_EQ(cell.run(), Outcome::terminated);
    EXPECT_LE(cell.worst_mm(50), 10) << static_cast<int>(method);
  }
}

TEST(ServoLoop, WithoutFeedForwardItLagsBehind) {
  CellParameters p = as_in_fig_28();
  p.object = [](double t) { return object_at(1, -0.3 + 0.1 * t, 0.05); };
  p.k.duration = 150;
  p.k.feed_forward = false;
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  EXPECT_GT(cell.worst_mm(50), 15);
}

TEST(ServoLoop, FollowsAnObjectOnACircle) {
  CellParameters p = as_in_fig_28();
  p.object = [](double t) { return object_at(1 + 0.08 * std::cos(t), 0.08 * std::sin(t), 0.05); };
  p.hidden = [](auto&&...) { return false; };
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  EXPECT_LE(cell.worst_mm(100), 15);
}

TEST(ServoLoop, StopsWhileTheObjectIsHiddenForLongerThanItIsRememberedAndGoesOn) {
  CellParameters p = as_in_fig_28();
  p.hidden = [](Camera, double t, auto&&...) { return t > 1 && t < 2.5; };
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  Vector3 stood = Vector3::Zero();
  for (const auto& row : cell.rows) {
    EXPECT_EQ(row.m == kIdle || row.m == kFromMemory, !row.sac && !row.eih);
    if (row.t > 1.9 && row.t < 2.5) {
      EXPECT_EQ(row.m, kIdle);
      if (stood != Vector3::Zero()) {
        EXPECT_LT((row.T_0E.p - stood).norm(), 1e-3) << row.t;
      }
      stood = row.T_0E.p;
    }
  }
  EXPECT_LE(cell.worst_mm(25), 1.5);
}

// A camera that is out of its place sees the object later, or an arm hides it earlier, than believed.
TEST(ServoLoop, GoesOnFromOneCamerasViewToTheOthersAcrossAGap) {
  CellParameters p = as_in_fig_28();
  const Vector3 goal = p.object(0) * p.k.T_EGd.inverse() * Vector3::Zero();
  p.hidden = [goal](Camera camera, double, const Pose& T_0E, const Pose&) {
    const double to_go = (T_0E.p - goal).norm();
    return camera == Camera::sac ? to_go < 0.09 : to_go > 0.06;
  };
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  std::set<int> had;
  for (const auto& row : cell.rows) had.insert(row.m);
  EXPECT_TRUE(had.contains(kFromMemory));
  EXPECT_LE(cell.worst_mm(25), 1);
}

TEST(ServoLoop, WaitsForAnObjectThatIsAbsentAtFirst) {
  CellParameters p = as_in_fig_28();
  p.hidden = [](Camera, double t, auto&&...) { return t < 3; };
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  for (const auto& row : cell.rows)
    if (row.t < 3) {
      EXPECT_EQ((row.T_0E.p - p.T_0E.p).norm(), 0);
    }
  EXPECT_LE(cell.worst_mm(25), 1.5);
}

TEST(ServoLoop, NeverMovesWithoutAnObjectAndGivesUp) {
  CellParameters p = as_in_fig_28();
  p.hidden = [](auto&&...) { return true; };
  p.k.timeout = 60;
  SyntheticCell cell(p);
  EXPECT_EQ(cell.run(), Outcome::aborted) << "it tells until it is stopped";
  for (const auto& row : cell.rows) EXPECT_EQ((row.T_0E.p - p.T_0E.p).norm(), 0);
  EXPECT_EQ(cell.rows[59].m, kIdle);
  EXPECT_EQ(cell.rows[60].m, kGiveUp.m);
}

TEST(ServoLoop, BearsReadingsThatAreLateOrLost) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    CellParameters p = as_in_fig_28(Aggregation::weights, seed);
    p.lost = [seed](Camera camera, std::int64_t frame) {
      return (static_cast<std::uint64_t>(frame) * 2654435761u + index(camera) + seed * 7) % 10 < 3;
    };
    for (auto& camera : p.k.camera) camera.latency = 40;
    SyntheticCell cell(p);
    ASSERT_EQ(cell.run(), Outcome::terminated);
    EXPECT_LE(cell.worst_mm(25), 1.5);
    ASSERT_GE(cell.steps_to(2), 0);
    EXPECT_LE(cell.steps_to(2), 90);
  }
}

TEST(ServoLoop, WorksWithOneCameraAlone) {
  for (const std::size_t without : {std::size_t{0}, std::size_t{1}}) {
    CellParameters p = as_in_fig_28();
    p.hidden = [](auto&&...) { return false; };
    p.k.camera[without].used = false;
    if (without == 0) {
      p.T_0E = p.object(0) * p.k.T_EGd.inverse();
      p.T_0E.p += Vector3(-0.05, 0.02, 0.15);
    }
    SyntheticCell cell(p);
    ASSERT_EQ(cell.run(), Outcome::terminated);
    EXPECT_LE(cell.worst_mm(25), without == 0 ? 1 : 3);
    for (const auto& row : cell.rows) EXPECT_NE(row.m, 3);
  }
}

TEST(ServoLoop, AveragesOverNoise) {
  const auto spread = [](double quiet) {
    CellParameters p = as_in_fig_28();
    p.position_noise = {3e-3, 1e-3};
    p.angle_noise = {20e-3, 8e-3};  // as of a small tag
    p.k.regulator.quiet = quiet;
    SyntheticCell cell(p);
    EXPECT_EQ(cell.run(), Outcome::terminated);
    double sum = 0;
    for (std::size_t k = cell.rows.size() - 100; k < cell.rows.size(); ++k) sum += cell.rows[k].true_mm;
    return sum / 100;
  };
  EXPECT_LT(spread(0.25), 0.7 * spread(1));
  EXPECT_LT(spread(0.25), 1);
}

TEST(ServoLoop, IsTheSameEveryTime) {
  SyntheticCell a(as_in_fig_28()), b(as_in_fig_28());
  ASSERT_EQ(a.run(), Outcome::terminated);
  ASSERT_EQ(b.run(), Outcome::terminated);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t k = 0; k < a.rows.size(); ++k) EXPECT_EQ(a.rows[k].T_0E.p, b.rows[k].T_0E.p);
}

}  // namespace
}  // namespace mrroc::visual_servo::test
