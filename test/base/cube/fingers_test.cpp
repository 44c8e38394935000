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

TEST(Fingers, ThePadsLieOnTheLayersThatTheyCoverAndOnNoOther) {
  constexpr double kLayer = kEdge / 3;
  for (const Fingers fingers : kBoth) {
    const GripperShape g = gripper_with(fingers);
    const double layers = fingers == Fingers::one_layer ? 1 : 2;
    const double near = kEdge / 2 - (depth(fingers) + g.pad_depth / 2);  // from the face at the palm [m]
    const double far = kEdge / 2 - (depth(fingers) - g.pad_depth / 2);
    EXPECT_GE(near, 0) << "within the cube";
    EXPECT_LE(far, layers * kLayer) << "the next layer can turn";
    EXPECT_GT(g.pad_depth, 0.75 * layers * kLayer) << "the layers are held, not their edge";
    EXPECT_LE(g.pad_depth / 2, g.palm) << "the pads do not reach into the palm";
  }
}

TEST(Fingers, APadAndThePalmLieWithinAFace) {
  for (const Fingers fingers : kBoth) {
    const GripperShape g = gripper_with(fingers);
    EXPECT_LT(g.pad_width, kEdge);
    EXPECT_GT(g.pad_width, 2 * kEdge / 3) << "all three columns are touched";
    EXPECT_LT(g.palm_width, kEdge);
    EXPECT_GT(g.palm_width, 0);
    EXPECT_GT(g.pad_thickness, 0);
    EXPECT_GT(g.palm, 0);
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
