// Ways past an obstacle in joint space.
#include "tasks/rubik/plan/paths.hpp"

#include <gtest/gtest.h>

namespace mrroc::rubik {
namespace {

/// Arms whose E does not matter. An obstacle stands at joint 0 from 0.4 to 0.6, up to a height in joint 1.
class Obstacle final : public PlanCell {
 public:
  explicit Obstacle(double height) : height_(height) {
    for (JointLimits& l : limits_) l = {AxisVector::Constant(6, 0.5), AxisVector::Constant(6, 2)};
  }
  [[nodiscard]] const Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const Viewing* viewing() const override { return nullptr; }
  [[nodiscard]] const JointLimits& limits(Hand hand) const override { return limits_[index(hand)]; }
  [[nodiscard]] Pose forward(Hand, const AxisVector&) const override { return {}; }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand, const Pose&, const AxisVector&) const override {
    return {};
  }
  [[nodiscard]] double reserve(Hand, const AxisVector& joints) const override {
    return 1.5 - joints.cwiseAbs().maxCoeff();
  }
  [[nodiscard]] double dexterity(Hand, const AxisVector&) const override { return 1; }
  [[nodiscard]] bool is_free(const CellState& state) const override {
    ++checks;
    const AxisVector& q = state.joints[index(Hand::track)];
    return q[0] < 0.4 || q[0] > 0.6 || q[1] > height_;
  }
  mutable int checks{};

 private:
  double height_;
  Meeting meeting_;
  std::array<JointLimits, 2> limits_;
};

AxisVector joints(double first, double second) {
  AxisVector q = AxisVector::Zero(6);
  q[0] = first;
  q[1] = second;
  return q;
}

TEST(Paths, GoStraightWhereNothingIsInTheWay) {
  const Obstacle cell(0.3);
  const auto way = Paths(cell).find(Hand::track, joints(0, 0.5), joints(1, 0.5), {});
  ASSERT_TRUE(way);
  EXPECT_EQ(way->size(), 2u);
}

TEST(Paths, GoRoundWhatIsInTheWayAndComeToTheEnd) {
  const Obstacle cell(0.3);
  const Paths paths(cell);
  EXPECT_FALSE(paths.is_free(Hand::track, joints(0, 0), joints(1, 0), {}));
  const auto way = paths.find(Hand::track, joints(0, 0), joints(1, 0), {});
  ASSERT_TRUE(way);
  EXPECT_GE(way->size(), 3u);
  EXPECT_EQ(way->front(), joints(0, 0));
  EXPECT_EQ(way->back(), joints(1, 0));
  for (std::size_t k = 1; k < way->size(); ++k)
    EXPECT_TRUE(paths.is_free(Hand::track, (*way)[k - 1], (*way)[k], {}));
  EXPECT_EQ(paths.find(Hand::track, joints(0, 0), joints(1, 0), {}), way) << "not the same again";
}

TEST(Paths, GoNowhereThroughAWallOrBeyondTheLimits) {
  const Obstacle wall(1e9);
  EXPECT_FALSE(Paths(wall).find(Hand::track, joints(0, 0), joints(1, 0), {}));
  const Obstacle cell(0.3);
  EXPECT_FALSE(Paths(cell).find(Hand::track, joints(0.7, 0), joints(1.6, 0), {}));
}

TEST(Paths, MissNoObstacleThatIsThinnerThanTheWayIsLong) {
  // 1 cm between states that are checked: at joint 0, 1.4 m from the hand, 140 states for one radian.
  const Obstacle cell(0.3);
  EXPECT_TRUE(Paths(cell).is_free(Hand::track, joints(0, 0.5), joints(1, 0.5), {}));
  EXPECT_GE(cell.checks, 100);
}

TEST(Paths, TakeTheTimeOfTheSlowestJointOnEachLineAndOneRamp) {
  const JointLimits limits{AxisVector::Constant(6, 0.5), AxisVector::Constant(6, 2)};
  EXPECT_DOUBLE_EQ(seconds_along({joints(0, 0), joints(1, 0.5)}, limits), 2 + 0.25);
  EXPECT_DOUBLE_EQ(seconds_along({joints(0, 0), joints(1, 0), joints(1, 0.5)}, limits), 3 + 0.25);
  EXPECT_DOUBLE_EQ(seconds_along({joints(0, 0), joints(0, 0)}, limits), 0);
}

}  // namespace
}  // namespace mrroc::rubik
