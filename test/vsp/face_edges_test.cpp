// Accuracy and selection of a face's sticker edges: a face painted to parts of a pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "vsp/cube_face/face_search.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kSize = 260;
constexpr double kDistance = 0.5;      // [m]
constexpr double kScale = 4000;        // [pixel/m]
constexpr double kPixel = 1 / kScale;  // [m]
constexpr double kHalf = kCubeFace.sticker / 2;

CameraModel camera() {
  CameraModel c;
  c.width = c.height = kSize;
  c.fx = c.fy = kScale * kDistance;
  c.cx = c.cy = 0.5 * (kSize - 1);
  return c;
}
/// Turned in the picture, so that edges lie everywhere between pixels.
Pose straight(double x = 0, double y = 0, double turn = 0.04) {
  return {rotation_from_angle_axis({0, 0, turn}) * rotation_from_angle_axis({M_PI, 0, 0}), {x, y, kDistance}};
}

/// Brightness of the face's sticker k at a place seen from its middle [m].
using Paint = std::function<double(int k, double x, double y)>;
double plain(int /*sticker*/, double x, double y) {
  return std::max(std::abs(x), std::abs(y)) < kHalf ? 200 : 10;
}

/// @param T_CG  facing the camera: only turned in the picture
cv::Mat painted(const Pose& T_CG, const Paint& paint = plain) {
  constexpr int kFine = 3;
  const Pose T_GC = T_CG.inverse();
  cv::Mat picture(kSize, kSize, CV_32F, cv::Scalar(0));
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      double sum = 0;
      for (int n = 0; n < kFine * kFine; ++n) {
        const int across = n % kFine, down = n / kFine;
        const double x = (u - 0.5 + (across + 0.5) / kFine - camera().cx) / camera().fx;
        const double y = (v - 0.5 + (down + 0.5) / kFine - camera().cy) / camera().fy;
        const Vector3 p = T_GC * Vector3(T_CG.p.z() * Vector3(x, y, 1));
        const double third = kCubeFace.edge / 3;
        if (std::max(std::abs(p.x()), std::abs(p.y())) >= 1.5 * third) {
          sum += 10;
          continue;
        }
        const int column = static_cast<int>((p.x() + 1.5 * third) / third);
        const int row = static_cast<int>((1.5 * third - p.y()) / third);
        const int k = 3 * row + column;
        sum += paint(k, p.x() - kCubeFace.middle(k).x(), p.y() - kCubeFace.middle(k).y());
      }
      picture.at<float>(v, u) = static_cast<float>(sum / (kFine * kFine));
    }
  cv::GaussianBlur(picture, picture, {}, 0.7);
  cv::Mat bytes;
  picture.convertTo(bytes, CV_8U);
  return bytes;
}
std::optional<FoundFace> found(const cv::Mat& picture, const Pose& place = straight(),
                               const CubeFaceParameters& k = {}) {
  return find_face(picture, camera(), place, kCubeFace, k);
}
void expect_near(const Pose& found, const Pose& truth, double pixels) {
  EXPECT_LT((found.p - truth.p).head<2>().norm(), pixels * kPixel);
  const double corner = 0.5 * kCubeFace.edge;
  EXPECT_LT(std::abs(found.p.z() - truth.p.z()) / kDistance * corner, pixels * kPixel);
  EXPECT_LT(std::abs(angle_axis_from_rotation(found.R * truth.R.transpose()).z()) * corner, pixels * kPixel);
  EXPECT_TRUE(is_proper(found));
}

// A thousand points, each to a few hundredths.
TEST(FaceEdges, TellThePlaceToAFewHundredthsOfAPixel) {
  for (const auto& [x, y, turn, z] : {std::tuple(0.0, 0.0, 0.04, 0.0),
                                      {0.3, -0.4, -0.04, 0.0},
                                      {0.25, 0.15, 0.03, 0.004},
                                      {-0.4, 0.1, -0.05, -0.004}}) {
    Pose truth = straight(x * kPixel, y * kPixel, turn);
    truth.p.z() += z;
    const auto face = found(painted(truth), straight(0.001, -0.0015, 0));
    ASSERT_TRUE(face) << x;
    expect_near(face->T_CG, truth, 0.1);
    EXPECT_LT(face->rms_px, 0.2) << x;
  }
}

TEST(FaceEdges, ThatLieOffDoNotMoveTheFace) {
  const Pose truth = straight(0.3 * kPixel, 0.2 * kPixel, 0.02);
  const auto face = found(painted(
      truth, [](int k, double x, double y) { return plain(k, x - (k == 0 || k == 5 ? 3 * kPixel : 0), y); }));
  ASSERT_TRUE(face);
  expect_near(face->T_CG, truth, 0.1);
  for (int k = 0; k < kStickers; ++k)
    EXPECT_EQ(face->whole[static_cast<std::size_t>(k)], k != 0 && k != 5) << k;
}

TEST(FaceEdges, SupportThePoseWithinThirteenTenthsOfAPixel) {
  const auto whole = [](double pixels, int side) {
    const auto face = found(painted(straight(), [=](int k, double x, double y) {
      if (k == 3) {
        const double towards = std::array{x, -x, y, -y}[static_cast<std::size_t>(side)];
        if (towards > kHalf - pixels * kPixel && pixels > 0) return 10.0;
        if (pixels < 0 && towards > 0 && towards < kHalf - pixels * kPixel &&
            std::max(std::abs(x), std::abs(y)) == towards && std::min(std::abs(x), std::abs(y)) < kHalf)
          return 200.0;
      }
      return plain(k, x, y);
    }));
    return face.value().whole[3];
  };
  for (int side = 0; side < 4; ++side) {
    EXPECT_TRUE(whole(1.1, side)) << side;
    EXPECT_FALSE(whole(1.6, side)) << side;
    EXPECT_TRUE(whole(-1.1, side)) << side;
    EXPECT_FALSE(whole(-1.6, side)) << side;
  }
}

// A place that is known badly is searched up to the next sticker and not beyond it.
TEST(FaceEdges, AreSearchedAsFarAsThePlaceMayBeOff) {
  const double third = kCubeFace.edge / 3;
  const cv::Mat picture = painted(straight());
  const CubeFaceParameters badly{.place_error = 0.05, .angle_error = 0.1};
  for (const double sign : {1.0, -1.0}) {
    const auto far = found(picture, straight(sign * 0.3 * third, 0), badly);
    ASSERT_TRUE(far);
    expect_near(far->T_CG, straight(), 0.1);
  }
  // The place is exact, but not the turn: the corners lie 7 pixels off.
  const CubeFaceParameters turned{.place_error = 0.0005, .angle_error = 0.05};
  for (const double turn : {0.06, -0.06}) {
    const auto face = found(picture, straight(0, 0, 0.04 + turn), turned);
    ASSERT_TRUE(face) << turn;
    expect_near(face->T_CG, straight(), 0.1);
  }
}

// In a wider picture there is something where this one has nothing.
TEST(FaceEdges, BeyondThePictureThereAreNone) {
  const cv::Mat wide = painted(straight());
  constexpr int kFace = static_cast<int>(0.5 * kCubeFace.edge * kScale);
  const int first = kSize / 2 - kFace;
  for (const auto& [part, missing] :
       {std::pair(cv::Rect(first + 14, 0, kSize - first - 14, kSize), std::array{0, 3, 6}),
        std::pair(cv::Rect(0, 0, kSize - first - 14, kSize), std::array{2, 5, 8}),
        std::pair(cv::Rect(0, first + 14, kSize, kSize - first - 14), std::array{0, 1, 2}),
        std::pair(cv::Rect(0, 0, kSize, kSize - first - 14), std::array{6, 7, 8})}) {
    CameraModel c = camera();
    c.width = part.width;
    c.height = part.height;
    c.cx -= part.x;
    c.cy -= part.y;
    const auto face = find_face(wide(part), c, straight(), kCubeFace, {});
    ASSERT_TRUE(face) << part;
    expect_near(face->T_CG, straight(), 0.15);
    for (int k = 0; k < kStickers; ++k)
      EXPECT_EQ(face->whole[static_cast<std::size_t>(k)], std::ranges::find(missing, k) == missing.end())
          << part << k;
  }
}

TEST(FaceEdges, TheErrorIsThatOfThePointsThatSupportThePose) {
  // The middle sticker is smaller on all sides: its 36 points are off by a pixel.
  const auto face = found(painted(straight(), [](int k, double x, double y) {
    return k == 4 && std::max(std::abs(x), std::abs(y)) > kHalf - kPixel ? 10.0 : plain(k, x, y);
  }));
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->rms_px, std::sqrt(1.0 / kStickers), 0.05);
}

}  // namespace
}  // namespace mrroc::vsp
