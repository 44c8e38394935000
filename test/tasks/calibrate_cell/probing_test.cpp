#include "tasks/calibrate_cell/probing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tasks/calibrate_cell/fit.hpp"

namespace mrroc::calibrate_cell {
namespace {

/// An arm that touches balls which stand elsewhere than it believes.
class Probing : public testing::Test {
 protected:
  Probing() {
    plan_.balls = {{1, 0.2, 0.8}, {1.1, -0.1, 1}, {1, -0.2, 0.7}};
    for (const Vector3& ball : plan_.balls) real_.push_back(ball + Vector3(0.008, -0.012, 0.009));
    T_ready_.R.col(0) = Vector3::UnitZ();
    T_ready_.R.col(1) = -Vector3::UnitY();
    T_ready_.R.col(2) = Vector3::UnitX();
    T_ready_.p = {0.85, 0, 0.8};
  }

  [[nodiscard]] double clearance(const Vector3& tip, std::size_t ball) const {
    return (tip - real_[ball]).norm() - plan_.ball_radius - plan_.tip_radius;
  }
  /// @return E where the tip touches ball n, on its way from the pose
  [[nodiscard]] Pose touched(Pose T, const Vector3& along, std::size_t ball) const {
    const Vector3 q = real_[ball] - middle_of_tip(plan_, T);
    const double radius = plan_.ball_radius + plan_.tip_radius;
    const double across = q.squaredNorm() - q.dot(along) * q.dot(along);
    T.p += (q.dot(along) - std::sqrt(radius * radius - across)) * along;
    return T;
  }
  /// Walks the way in small steps. @return least clearance of the tip from all balls
  [[nodiscard]] double least_clearance(const std::vector<Pose>& way) const {
    double least = 1;
    for (std::size_t k = 0; k + 1 < way.size(); ++k)
      for (int part = 0; part <= 100; ++part) {
        const Vector3 tip = middle_of_tip(plan_, way[k]) + 0.01 * part * (way[k + 1].p - way[k].p);
        for (std::size_t ball = 0; ball < real_.size(); ++ball) least = std::min(least, clearance(tip, ball));
      }
    return least;
  }

  ProbePlan plan_;
  std::vector<Vector3> real_;
  Pose T_ready_;
};

TEST_F(Probing, FindsBallsThatStandElsewhereAndTouchesNothingOnItsWay) {
  std::vector<Touch> done;
  Pose T = T_ready_;
  for (std::size_t n = 0; n < touches(plan_); ++n) {
    SCOPED_TRACE(n);
    const auto way = way_to_touch(plan_, done, T, T_ready_);
    EXPECT_TRUE(way.front().p == T.p);
    EXPECT_GT(least_clearance({way.begin() + 1, way.end()}), 0.002);
    const Vector3 along = in_base(direction(n), T_ready_.R);
    const std::size_t ball = n / kTouchesPerBall;
    T = touched(way.back(), along, ball);
    EXPECT_LT((T.p - way.back().p).norm(), longest_way(plan_, n)) << "it would have given up";
    EXPECT_GT((T.p - way.back().p).dot(along), 0) << "it comes from outside";
    done.push_back({middle_of_tip(plan_, T), along});
    ASSERT_TRUE(std::isfinite(T.p.sum()));
  }
  for (std::size_t ball = 0; ball < real_.size(); ++ball)
    EXPECT_LT((believed(plan_, done, ball) - real_[ball]).norm(), 1e-9);
  EXPECT_GT(least_clearance(way_back(plan_, done, T, T_ready_)), -1e-9);
  EXPECT_TRUE(way_back(plan_, done, T, T_ready_).back().p == T_ready_.p);
}

TEST_F(Probing, BelievesTheNextBallAsFarAwayAsTheLastOne) {
  std::vector<Touch> done;
  EXPECT_TRUE(believed(plan_, done, 2) == plan_.balls[2]);
  for (std::size_t n = 0; n < kTouchesPerBall; ++n) {
    const Vector3 along = in_base(direction(n), T_ready_.R);
    done.push_back({real_[0] - (plan_.ball_radius + plan_.tip_radius) * along, along});
  }
  EXPECT_LT((believed(plan_, done, 1) - real_[1]).norm(), 1e-9);
}

TEST_F(Probing, ASecondTouchBeginsNearerThanTheFirst) {
  EXPECT_GT(longest_way(plan_, 0), longest_way(plan_, kDirections.size()));
  EXPECT_EQ(direction(0).axis, Axis::z);
  EXPECT_EQ(direction(kDirections.size()).axis, Axis::z);
}

}  // namespace
}  // namespace mrroc::calibrate_cell
