#include "base/msg/convert_cube_face.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace mrroc {
namespace {

CubeFaceReading any_reading(std::mt19937& random) {
  const auto number = [&random] { return std::uniform_real_distribution<>(-9, 9)(random); };
  CubeFaceReading r;
  r.frame = 12;
  r.step = static_cast<std::int64_t>(random());
  r.seen = random() % 2 != 0;
  r.valid = random() % 2 != 0;
  r.place = static_cast<int>(random() % 5) - 1;
  for (double& x : r.T_CG.R.reshaped()) x = number();
  for (double& x : r.T_CG.p) x = number();
  for (double& x : r.covariance.reshaped()) x = number();
  r.reprojection_px = number();
  for (StickerReading& s : r.stickers) {
    for (double& x : s.rgb) x = number();
    s.deviation = number();
    s.confidence = number();
    s.colour = static_cast<StickerColour>(random() % kStickerColours);
    s.flaw = static_cast<StickerFlaw>(random() % 5);
  }
  return r;
}

TEST(CubeFaceMessage, BringsEveryFieldBack) {
  std::mt19937 random(4);
  for (int k = 0; k < 20; ++k) {
    const CubeFaceReading sent = any_reading(random);
    cube_face_reading_t m = to_message(sent);
    m.header.stamp = sent.frame;
    EXPECT_TRUE(is_proper(m));
    const CubeFaceReading got = from_message(m);
    EXPECT_EQ(got.frame, sent.frame);
    EXPECT_EQ(got.step, sent.step);
    EXPECT_EQ(got.seen, sent.seen);
    EXPECT_EQ(got.valid, sent.valid);
    EXPECT_EQ(got.place, sent.place);
    EXPECT_EQ(got.T_CG.R, sent.T_CG.R);
    EXPECT_EQ(got.T_CG.p, sent.T_CG.p);
    EXPECT_EQ(got.covariance, sent.covariance);
    EXPECT_EQ(got.reprojection_px, sent.reprojection_px);
    for (std::size_t s = 0; s < kStickers; ++s) {
      EXPECT_EQ(got.stickers[s].rgb, sent.stickers[s].rgb);
      EXPECT_EQ(got.stickers[s].deviation, sent.stickers[s].deviation);
      EXPECT_EQ(got.stickers[s].confidence, sent.stickers[s].confidence);
      EXPECT_EQ(got.stickers[s].colour, sent.stickers[s].colour);
      EXPECT_EQ(got.stickers[s].flaw, sent.stickers[s].flaw);
    }
  }
}

TEST(CubeFaceMessage, IsNotProperWithNumbersThatNobodyCanUse) {
  const cube_face_reading_t good = to_message(CubeFaceReading{});
  cube_face_reading_t m = good;
  m.rgb[20] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_proper(m));
  m = good;
  m.T_CG[3] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_proper(m));
  m = good;
  m.colour[8] = kStickerColours;
  EXPECT_FALSE(is_proper(m));
  m = good;
  m.flaw[0] = -1;
  EXPECT_FALSE(is_proper(m));
}

}  // namespace
}  // namespace mrroc
