// The collision check knows what touches what.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/cube.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"

namespace mrroc::rubik {
namespace {

constexpr auto kP = Hand::postument;
constexpr auto kT = Hand::track;

class CellCollision : public testing::Test {
 protected:
  /// Both hands at the cube in the track arm's hand, the postument drawn back. @param turn  of it about its z
  [[nodiscard]] CellState state(double back, double turn = 0) const {
    CellState s{cell.meeting().joints, {kOpenJaws, sim::kCubeEdge}, {kT, Face::D, Face::B}, false, false};
    move(s, kP, {rotation_from_angle_axis({0, 0, turn}), {0, 0, -back}});
    return s;
  }
  /// @param by  in E
  void move(CellState& s, Hand hand, const Pose& by) const {
    AxisVector& q = s.joints[index(hand)];
    q = *cell.inverse(hand, cell.forward(hand, q) * by, q);
  }

  CubePlanCell cell{usual_cell(), viewing_place()};
};

TEST_F(CellCollision, IsFreeWhereTheHandsMeet) {
  for (int quarter = -1; quarter <= 1; ++quarter) {
    EXPECT_TRUE(cell.is_free(state(0.1, quarter * std::numbers::pi / 2))) << cell.touching();
    EXPECT_TRUE(cell.is_free(state(0.01, quarter * std::numbers::pi / 2))) << cell.touching();
    CellState s = state(0, quarter * std::numbers::pi / 2);
    s.touched = true;
    EXPECT_TRUE(cell.is_free(s)) << cell.touching();
  }
}

TEST_F(CellCollision, SeesTheCubeTouchedByTheOtherHand) {
  EXPECT_FALSE(cell.is_free(state(0)));
  EXPECT_TRUE(cell.touching().find("cube") != std::string::npos) << cell.touching();
  // Jaws that are too narrow come upon the sides of the cube.
  CellState s = state(0.01);
  s.jaws[index(kP)] = 0.05;
  EXPECT_FALSE(cell.is_free(s));
}

TEST_F(CellCollision, SeesFingersOfBothHandsTouchingAndPalmsPassingFingers) {
  CellState s = state(0);
  s.touched = true;
  move(s, kP, {Matrix3::Identity(), {0, 0, 0.006}});
  EXPECT_FALSE(cell.is_free(s)) << "fingers are 4 mm apart";
}

TEST_F(CellCollision, SeesLinksOfTheArmsTouching) {
  // The track arm's hand where the postument's forearm is.
  CellState s = state(0.1);
  AxisVector near = s.joints[1];
  near[0] = 0.9;
  const Matrix3 R = cell.forward(kT, near).R;
  const auto joints = cell.inverse(kT, {R, {0.2, 1.8, 1.5}}, near);
  ASSERT_TRUE(joints);
  s.joints[1] = *joints;
  EXPECT_FALSE(cell.is_free(s));
  EXPECT_NE(cell.touching().find("upper_arm"), std::string::npos) << cell.touching();
}

TEST_F(CellCollision, SeesTheTable) {
  CellState s = state(0.1);
  s.joints[0] =
      *cell.inverse(kP, Pose{Eigen::DiagonalMatrix<double, 3>(1, -1, -1), {0.9, 2.1, 0.92}}, s.joints[0]);
  EXPECT_FALSE(cell.is_free(s)) << "the hand is in its table";
  EXPECT_NE(cell.touching().find("table"), std::string::npos) << cell.touching();
}

TEST_F(CellCollision, SeesWhatStandsBeforeTheCamera) {
  CellState s = state(0.1);
  EXPECT_TRUE(cell.is_free(s));
  // The empty hand of the postument before the face.
  const Viewing view = viewing_place();
  const Vector3 before = view.T_UG * Vector3(0, 0, 0.15);
  const Pose T_UE{cell.forward(kP, s.joints[0]).R, before};
  const auto joints = cell.inverse(kP, T_UE, s.joints[0]);
  ASSERT_TRUE(joints);
  s.joints[0] = *joints;
  ASSERT_TRUE(cell.is_free(s)) << cell.touching();
  s.looked_at = true;
  EXPECT_FALSE(cell.is_free(s));
}

}  // namespace
}  // namespace mrroc::rubik
