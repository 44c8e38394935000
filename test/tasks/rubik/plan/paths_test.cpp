// Ways past an obstacle in joint space.
#include "tasks/rubik/plan/paths.hpp"

#include <gtest/gtest.h>

namespace mrroc::rubik {
namespace {

constexpr double kGear = 100;  // of all joints
constexpr double kArm = 2;     // of joint 5, which alone moves E [m/rad]
const SpeedLimits kLimits{{AxisVector::Constant(6, 50), AxisVector::Constant(6, 200)}, 0.5, 1};

/// Arms that move E with joint 5 only. An obstacle stands at joint 0 from 0.4 to 0.6, up to a height in joint 1.
class Obstacle : public PlanCell {
 public:
  explicit Obstacle(double height) : height_(height) {
    for (SpeedLimits& l : limits_) l = kLimits;
  }
  [[nodiscard]] const Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const Viewing* viewing() const override { return nullptr; }
  [[nodiscard]] const SpeedLimits& limits(Hand hand) const override { return limits_[index(hand)]; }
  [[nodiscard]] AxisVector motors(Hand, const AxisVector& joints) const override { return kGear * joints; }
  [[nodiscard]] AxisVector joints(Hand, const AxisVector& motors) const override { return motors / kGear; }
  [[nodiscard]] Pose forward(Hand, const AxisVector& joints) const override {
    return {Matrix3::Identity(), {kArm * joints[5], 0, 0}};
  }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand, const Pose&, const AxisVector&) const override {
    return {};
  }
  [[nodiscard]] double joint_limit_margin(Hand, const AxisVector& joints) const override {
    return 1.5 - joints.cwiseAbs().maxCoeff();
  }
  [[nodiscard]] double manipulability(Hand, const AxisVector&) const override { return 1; }
  [[nodiscard]] bool is_free(const CellState& state) const override {
    ++checks;
    const AxisVector& q = state.joints[index(Hand::track)];
    return q[0] < 0.4 || q[0] > 0.6 || q[1] > height_;
  }
  mutable int checks{};

 private:
  double height_;
  Meeting meeting_;
  std::array<SpeedLimits, 2> limits_;
};

AxisVector joints(double first, double second) {
  AxisVector q = AxisVector::Zero(6);
  q[0] = first;
  q[1] = second;
  return q;
}

TEST(Paths, GoStraightWhereNothingIsInTheWay) {
  const Obstacle cell(0.3);
  const auto path = Paths(cell).find(Hand::track, joints(0, 0.5), joints(1, 0.5), {});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->size(), 2u);
}

TEST(Paths, GoRoundWhatIsInTheWayAndComeToTheEnd) {
  const Obstacle cell(0.3);
  const Paths paths(cell);
  EXPECT_FALSE(paths.is_free(Hand::track, joints(0, 0), joints(1, 0), {}));
  const auto path = paths.find(Hand::track, joints(0, 0), joints(1, 0), {});
  ASSERT_TRUE(path);
  EXPECT_GE(path->size(), 3u);
  EXPECT_EQ(path->front(), joints(0, 0));
  EXPECT_EQ(path->back(), joints(1, 0));
  for (std::size_t k = 1; k < path->size(); ++k)
    EXPECT_TRUE(paths.is_free(Hand::track, (*path)[k - 1], (*path)[k], {}));
  EXPECT_EQ(paths.find(Hand::track, joints(0, 0), joints(1, 0), {}), path) << "not the same again";
}

TEST(Paths, GoNowhereThroughAWallOrBeyondTheLimits) {
  const Obstacle wall(1e9);
  EXPECT_FALSE(Paths(wall).find(Hand::track, joints(0, 0), joints(1, 0), {}));
  const Obstacle cell(0.3);
  EXPECT_FALSE(Paths(cell).find(Hand::track, joints(0.7, 0), joints(1.6, 0), {}));
}

TEST(Paths, MissNoObstacleThatIsThinnerThanThePathIsLong) {
  // 1 cm between states that are checked: at joint 0, 1.4 m from the hand, 140 states for one radian.
  const Obstacle cell(0.3);
  EXPECT_TRUE(Paths(cell).is_free(Hand::track, joints(0, 0.5), joints(1, 0.5), {}));
  EXPECT_GE(cell.checks, 100);
}

TEST(Paths, TakeTheTimeOfTheMotorThatIsUsedMostAndOneRamp) {
  const Obstacle cell(0.3);
  EXPECT_NEAR(seconds_along(cell, Hand::track, {joints(0, 0), joints(1, 0.5)}), 2 + 0.26, 1e-9);
  EXPECT_NEAR(seconds_along(cell, Hand::track, {joints(0, 0), joints(0.5, 0.25), joints(1, 0.5)}), 2 + 0.26,
              1e-9);
  EXPECT_EQ(seconds_along(cell, Hand::track, {joints(0, 0), joints(0, 0)}), 0);
  EXPECT_EQ(seconds_along(cell, Hand::track, {joints(0, 0)}), 0);
}

TEST(Paths, AreSlowerWhereTheHandWouldBeTooFast) {
  const Obstacle cell(0.3);
  AxisVector moved = joints(0.5, 0);
  moved[5] = 1;
  const auto path = path_through(cell, Hand::track, {joints(0, 0), joints(0.5, 0), moved, joints(0.5, 0)});
  ASSERT_EQ(path.size(), 4u);
  EXPECT_EQ(path[1].speed, 1);
  EXPECT_NEAR(path[2].speed, 0.5, 1e-9) << "2 m in 4 s instead of 2";
  EXPECT_NEAR(path[3].speed, 0.5, 1e-9);
  EXPECT_EQ(path[2].motors, kGear * moved);
  EXPECT_NEAR(seconds_along({path[1], path[2]}, kLimits.motors), 4 + 0.125, 0.02);
}

/// Both arms are on one rail: joint 0 of one must not come near that of the other one.
class Rail final : public Obstacle {
 public:
  Rail() : Obstacle(0) {}
  [[nodiscard]] bool is_free(const CellState& state) const override {
    return std::abs(state.joints[0][0] - state.joints[1][0]) > 0.1;
  }
};

TEST(Paths, OfBothArmsAreFreeOnlyIfNeitherNeedsTheOtherToBeInTime) {
  const Rail cell;
  const Paths paths(cell);
  const auto motion = [&](Hand hand, double from, double to) {
    FreeMotion m{.hand = hand, .points = path_through(cell, hand, {joints(from, 0), joints(to, 0)})};
    m.seconds = seconds_along(m.points, kLimits.motors);
    return m;
  };
  const FreeMotion first = motion(Hand::postument, 0, 1);
  EXPECT_TRUE(paths.are_free(first, motion(Hand::track, -0.5, 0.5), 0, {})) << "it follows";
  EXPECT_FALSE(paths.are_free(first, motion(Hand::track, 0.5, -0.5), 0, {})) << "they meet";
  // 0.15 apart all the time; but at 0.5 rad/s the lag is 0.1.
  const FreeMotion close_behind = motion(Hand::track, -0.15, 0.85);
  EXPECT_FALSE(paths.are_free(first, close_behind, 0, {}));
  EXPECT_TRUE(paths.are_free(first, close_behind, 0.5, {}));
  EXPECT_FALSE(paths.are_free(first, motion(Hand::track, -0.5, 0.95), 5, {})) << "where it ends";
}

}  // namespace
}  // namespace mrroc::rubik
