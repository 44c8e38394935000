// Grasps as rotations: palm and jaw say how the core stands in a hand.
#include "base/cube/grasp.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace mrroc::cube {
namespace {

std::vector<Grasp> all_grasps(Hand hand) {
  std::vector<Grasp> all;
  for (int palm = 0; palm < kFaces; ++palm)
    for (int jaw = 0; jaw < kFaces; ++jaw)
      if (const Grasp g{hand, static_cast<Face>(palm), static_cast<Face>(jaw)}; is_valid(g)) all.push_back(g);
  return all;
}

TEST(Hands, StandInTheOrderOfTheirIndices) {
  for (std::size_t k = 0; k < kHands.size(); ++k) {
    EXPECT_EQ(index(kHands[k]), k);
    EXPECT_NE(other(kHands[k]), kHands[k]);
  }
}

TEST(Grasp, Has24OrientationsInEachHand) {
  for (const Hand hand : kHands) EXPECT_EQ(all_grasps(hand).size(), 24u);
}

TEST(Grasp, IsARotationThatTellsPalmAndJaw) {
  for (const Hand hand : kHands)
    for (const Grasp& g : all_grasps(hand)) {
      const Pose T_EC = cube_in_hand(g);
      EXPECT_TRUE(is_proper(T_EC));
      EXPECT_LT((T_EC.R * normal(g.palm) - Vector3(0, 0, -1)).norm(), 1e-12) << to_string(g);
      EXPECT_LT((T_EC.R * normal(g.jaw) - Vector3(0, 1, 0)).norm(), 1e-12) << to_string(g);
      EXPECT_DOUBLE_EQ(T_EC.p.z(), depth(hand));
      EXPECT_EQ(grasp_from(hand, T_EC.R), g);
    }
}

TEST(Grasp, SurvivesErrorsOfSomeDegrees) {
  for (const Grasp& g : all_grasps(Hand::track)) {
    const Matrix3 error = rotation_from_angle_axis({0.1, -0.15, 0.2});
    EXPECT_EQ(grasp_from(Hand::track, error * cube_in_hand(g).R), g);
  }
}

TEST(Grasp, TurnedHandHoldsTheCoreWhereItWas) {
  for (const Grasp& g : all_grasps(Hand::postument))
    for (int quarters = -2; quarters <= 2; ++quarters) {
      const Matrix3 R_UE = rotation_from_angle_axis({0.3, 0.8, -0.4});
      const Matrix3 turn = rotation_from_angle_axis({0, 0, quarters * std::numbers::pi / 2});
      const Matrix3 R_UC = R_UE * cube_in_hand(g).R;
      const Grasp t = turned(g, quarters);
      EXPECT_LT((R_UE * turn * cube_in_hand(t).R - R_UC).norm(), 1e-9) << to_string(g) << ' ' << quarters;
      EXPECT_EQ(t.palm, g.palm);
    }
}

TEST(Grasp, FacesOfTheFrameOfTheCore) {
  EXPECT_EQ(cross(Face::R, Face::B), Face::U);
  for (int f = 0; f < kFaces; ++f) {
    const auto face = static_cast<Face>(f);
    EXPECT_EQ(face_along(normal(face)), face);
    EXPECT_EQ(normal(opposite(face)), -normal(face));
  }
}

}  // namespace
}  // namespace mrroc::cube
