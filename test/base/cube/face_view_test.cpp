#include "base/cube/face_view.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <set>

#include "base/cube/facelets.hpp"

namespace mrroc::cube {
namespace {

Matrix3 clockwise(int quarters) { return rotation_from_angle_axis({0, 0, -quarters * std::numbers::pi / 2}); }

/// Middle of a facelet in C, in thirds of the edge.
Vector3 place_of(int facelet) {
  const int k = facelet % kStickers;
  const int row = k / 3;
  return facelet_frame(static_cast<Face>(facelet / kStickers)) * Vector3(k % 3 - 1, 1 - row, 1.5);
}

TEST(FaceView, FaceletsOfOnePieceAreNeighbours) {
  for (const auto& corner : kCornerFacelets)
    for (const int a : corner)
      for (const int b : corner)
        if (a != b) {
          EXPECT_NEAR((place_of(a) - place_of(b)).norm(), std::sqrt(0.5), 1e-9) << a << ' ' << b;
        }
  for (const auto& edge : kEdgeFacelets)
    EXPECT_NEAR((place_of(edge[0]) - place_of(edge[1])).norm(), std::sqrt(0.5), 1e-9) << int{edge[0]};
}

TEST(FaceView, TellsFaceAndQuarterTurnsOfAnyOrientation) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> number(-0.3, 0.3);
  for (int f = 0; f < kFaces; ++f)
    for (int quarters = 0; quarters < 4; ++quarters) {
      const ShownFace shown{static_cast<Face>(f), quarters};
      const Vector3 tilt(number(random), number(random), number(random));
      const Matrix3 R_GC =
          rotation_from_angle_axis(tilt) * clockwise(quarters) * facelet_frame(shown.face).transpose();
      EXPECT_EQ(shown_face(R_GC), shown) << f << ' ' << quarters;
    }
}

TEST(FaceView, StickersAreWhereTheCubeHasThem) {
  for (int f = 0; f < kFaces; ++f)
    for (int quarters = 0; quarters < 4; ++quarters) {
      const ShownFace shown{static_cast<Face>(f), quarters};
      const Matrix3 R_GC = clockwise(quarters) * facelet_frame(shown.face).transpose();
      std::set<int> all;
      for (int k = 0; k < kStickers; ++k) {
        const int row = k / 3;
        const Vector3 in_picture(k % 3 - 1, 1 - row, 1.5);
        EXPECT_LT((R_GC * place_of(facelet(shown, k)) - in_picture).norm(), 1e-9) << f << quarters << k;
        all.insert(facelet(shown, k));
      }
      EXPECT_EQ(all.size(), kStickers);
    }
}

TEST(FaceView, WithOneQuarterTheUpperRowIsSeenAtTheRight) {
  EXPECT_EQ(facelet({Face::F, 1}, 2), 18);
  EXPECT_EQ(facelet({Face::F, 1}, 8), 20);
}

TEST(FaceView, OfAFaceThatWasNotSeenHasNoStickerToRelyOn) {
  CubeFaceReading reading;
  const FaceView unseen = view_of(Matrix3::Identity(), reading);
  for (const StickerReading& s : unseen.stickers) EXPECT_EQ(s.flaw, StickerFlaw::hidden);
  reading.seen = true;
  reading.stickers[3].flaw = StickerFlaw::glaring;
  const FaceView seen = view_of(Matrix3::Identity(), reading);
  EXPECT_EQ(seen.shown, shown_face(Matrix3::Identity()));
  EXPECT_EQ(seen.stickers[0].flaw, StickerFlaw::none);
  EXPECT_EQ(seen.stickers[3].flaw, StickerFlaw::glaring);
}

}  // namespace
}  // namespace mrroc::cube
