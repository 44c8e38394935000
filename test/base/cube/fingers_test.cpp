// Fingers that cover one layer or two, and how a hand with them holds a cube.
#include "base/cube/fingers.hpp"

#include <gtest/gtest.h>

#include <array>

namespace mrroc::cube {
namespace {

constexpr std::array kBoth{Fingers::one_layer, Fingers::two_layers};

TEST(Fingers, TheFaceThatIsNamedPointsAwayFromThePalm) {
  for (int k = 0; k < kFaces; ++k) {
    const auto face = static_cast<Face>(k);
    EXPECT_TRUE(is_proper(cube_with(face)));
    EXPECT_LT((cube_with(face).R * normal(face) - Vector3::UnitZ()).norm(), 1e-12) << k;
    EXPECT_EQ(cube_with(face).p, Vector3::Zero()) << "the core stays in the middle";
  }
}

TEST(Fingers, ThePalmLiesOnTheCube) {
  for (const Fingers fingers : kBoth)
    for (int k = 0; k < kFaces; ++k) {
      const Pose T_EC = cube_in_hand(fingers, static_cast<Face>(k));
      const double back = T_EC.p.z() - kEdge / 2;  // of the face that lies on the palm
      EXPECT_NEAR(-back, gripper_with(fingers).palm, 1.1e-3);
      EXPECT_LE(-back, gripper_with(fingers).palm + 1e-12);
    }
}

TEST(Fingers, OfTwoLayersAreLongerAndHaveANarrowerPalm) {
  const GripperShape one = gripper_with(Fingers::one_layer), two = gripper_with(Fingers::two_layers);
  EXPECT_GT(two.pad_depth, one.pad_depth);
  EXPECT_LT(two.palm_width, one.palm_width);
  EXPECT_GT(two.palm, one.palm);
  EXPECT_LT(two.pad_depth / 2, two.palm) << "the pads do not reach into the palm";
}

}  // namespace
}  // namespace mrroc::cube
