// Location of a face from the edges of its stickers: a painted face, ten pixels for a millimetre, seen
// straight on.
#include "vsp/cube_face/face_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp {
namespace {

constexpr int kSize = 600;
constexpr double kScale = 10'000;  // [pixel/m]

CameraModel camera() {
  CameraModel c;
  c.width = c.height = kSize;
  c.fx = c.fy = kScale;
  c.cx = c.cy = 0.5 * (kSize - 1);
  return c;
}
Pose straight(double x = 0, double y = 0) { return {rotation_from_angle_axis({M_PI, 0, 0}), {x, y, 1}}; }

/// @param grey  of a sticker at a place of the face [m]
cv::Mat painted(const std::function<int(int sticker, double x, double y)>& grey, int plastic = 5) {
  cv::Mat picture(kSize, kSize, CV_8U, cv::Scalar(plastic));
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u)
      for (int k = 0; k < kStickers; ++k) {
        const double x = (u - camera().cx) / kScale, y = (camera().cy - v) / kScale;
        const Vector3 m = kCubeFace.middle(k);
        if (std::max(std::abs(x - m.x()), std::abs(y - m.y())) < kCubeFace.sticker / 2)
          picture.at<unsigned char>(v, u) = static_cast<unsigned char>(grey(k, x - m.x(), y - m.y()));
      }
  cv::GaussianBlur(picture, picture, {}, 0.7);
  return picture;
}
cv::Mat plain(int grey = 200, int plastic = 5) {
  return painted([grey](int, double, double) { return grey; }, plastic);
}
std::optional<FoundFace> found(const cv::Mat& picture, const Pose& place = straight(),
                               const CubeFaceParameters& k = {}) {
  return find_face(picture, camera(), place, kCubeFace, k);
}

TEST(FaceSearch, FindsTheFaceFromAPlaceThatIsALittleOff) {
  const cv::Mat picture = plain();
  for (const auto& [x, y, turn] :
       {std::tuple(0.0, 0.0, 0.0), {0.003, -0.002, 0.02}, {-0.004, 0.003, -0.03}}) {
    const Pose place{rotation_from_angle_axis({0, 0, turn}) * straight().R, {x, y, 1}};
    const auto face = found(picture, place);
    ASSERT_TRUE(face) << x;
    EXPECT_LT(face->T_CG.p.head<2>().norm(), 5e-5) << x;
    EXPECT_NEAR(face->T_CG.p.z(), 1, 2e-3) << x;
    EXPECT_LT(angle_axis_from_rotation(face->T_CG.R * straight().R.transpose()).norm(), 0.01) << x;
    EXPECT_TRUE(std::ranges::all_of(face->whole, [](bool w) { return w; }));
    EXPECT_LT(face->rms_px, 0.3);
  }
}

// 162 points of edges tell x, each to 0.4 pixels; the place is not known that well.
TEST(FaceSearch, CovarianceIsThatOfTheEdgesPoints) {
  const auto face = found(plain());
  ASSERT_TRUE(face);
  const double sigma = 0.4 / (kScale * std::sqrt(162.0));
  // A little more, as a face that is turned about the other axis looks as if it had moved.
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(std::sqrt(face->covariance(k, k)), 1.05 * sigma) << k;
    EXPECT_LT(std::sqrt(face->covariance(k, k)), 1.4 * sigma) << k;
  }
  EXPECT_GT(face->covariance(2, 2), 100 * face->covariance(0, 0));
}

// Six tenths of every edge, of nine points.
TEST(FaceSearch, AStickerOfWhichAnEdgeIsHiddenIsNotWhole) {
  const auto covered = [](int sticker, int points) {
    return found(painted([=](int k, double x, double y) {
      // Points lie between -0.8 and 0.8 of half a side.
      const double at = (y / (0.8 * kCubeFace.sticker / 2) + 1) * 4;
      return k == sticker && x > 0.9 * kCubeFace.sticker / 2 && at < points - 0.5 ? 5 : 200;
    }));
  };
  for (const int sticker : {0, 4, 8}) {
    const auto little = covered(sticker, 3), much = covered(sticker, 4);
    ASSERT_TRUE(little && much);
    for (int k = 0; k < kStickers; ++k) {
      EXPECT_TRUE(little->whole[static_cast<std::size_t>(k)]) << sticker << ' ' << k;
      EXPECT_EQ(much->whole[static_cast<std::size_t>(k)], k != sticker) << sticker << ' ' << k;
    }
  }
}

TEST(FaceSearch, FiveStickersMustBeWhole) {
  const auto without = [](int n) {
    return found(painted([n](int k, double, double) { return k % 2 == 0 && k / 2 < n ? 5 : 200; }));
  };
  const auto five = without(4);
  ASSERT_TRUE(five);
  EXPECT_EQ(std::ranges::count(five->whole, true), 5);
  EXPECT_FALSE(without(5));
}

// Two standard deviations of what is known of it beforehand.
TEST(FaceSearch, AFaceThatIsFarFromItsPlaceIsAnotherOne) {
  const cv::Mat picture = plain();
  const CubeFaceParameters k{.place_error = 0.002};
  for (const double sign : {1., -1.}) {
    EXPECT_TRUE(found(picture, straight(sign * 0.003), k));
    EXPECT_TRUE(found(picture, straight(0, sign * 0.003), k));
    EXPECT_FALSE(found(picture, straight(sign * 0.0043), k));
    EXPECT_FALSE(found(picture, straight(0, sign * 0.0043), k));
  }
  EXPECT_FALSE(found(picture, {rotation_from_angle_axis({0, 0, 0.13}) * straight().R, {0, 0, 1}}));
}

TEST(FaceSearch, AnEdgeIsAChangeOfTheContrastAndOfThreeTenths) {
  const CubeFaceParameters k{.contrast = 20};
  EXPECT_TRUE(found(plain(45, 15), straight(), k));
  EXPECT_FALSE(found(plain(37, 15), straight(), k));
  EXPECT_FALSE(found(plain(10, 40), straight(), k)) << "stickers are brighter than the plastic";
  EXPECT_TRUE(found(plain(200, 110)));
  EXPECT_FALSE(found(plain(200, 135)));
}

TEST(FaceSearch, NothingIsNoFace) {
  EXPECT_FALSE(found(cv::Mat(kSize, kSize, CV_8U, cv::Scalar(100))));
  EXPECT_FALSE(found(plain(), {rotation_from_angle_axis({0, 0, M_PI / 4}) * straight().R, {0, 0, 1}}));
}

TEST(FaceSearch, TheErrorIsThatOfTheEdgesAndMustBeSmall) {
  // Stickers whose edges are wavy by up to half a pixel or so.
  const cv::Mat wavy = painted([](int, double x, double y) {
    const double wave = 6e-5 * std::sin(x * 9e2) * std::sin(y * 9e2);
    return std::max(std::abs(x), std::abs(y)) > kCubeFace.sticker / 2 - 6e-5 - wave ? 5 : 200;
  });
  const auto rough = found(wavy, straight(), {.rms_px = 10});
  ASSERT_TRUE(rough);
  const double px = rough->rms_px;
  EXPECT_GT(px, found(plain())->rms_px);
  EXPECT_TRUE(found(wavy, straight(), {.rms_px = px})) << "the very error";
  EXPECT_FALSE(found(wavy, straight(), {.rms_px = 0.99 * px}));
}

}  // namespace
}  // namespace mrroc::vsp
