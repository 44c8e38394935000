// Accuracy of the border of a tag, and its reported quality: many pictures of one square.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "vsp/apriltag/border.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kSize = 128;

/// An upright square, corners one after the other around it.
Corners square(double edge, const Vector2& middle) {
  const double h = edge / 2;
  return {middle + Vector2(-h, -h), middle + Vector2(h, -h), middle + Vector2(h, h), middle + Vector2(-h, h)};
}

/// Pixels are averages over their area. @param brightness  at a place seen from the middle
cv::Mat drawn(const Vector2& middle, const std::function<double(double, double)>& brightness) {
  constexpr int kFine = 8;
  cv::Mat grey(kSize, kSize, CV_32F);
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      double sum = 0;
      for (int n = 0; n < kFine * kFine; ++n) {
        const int column = n % kFine, row = n / kFine;
        sum += brightness(u - 0.5 + (column + 0.5) / kFine - middle.x(),
                          v - 0.5 + (row + 0.5) / kFine - middle.y());
      }
      grey.at<float>(v, u) = static_cast<float>(sum / (kFine * kFine));
    }
  return grey;
}
cv::Mat tag(double edge, const Vector2& middle, double light = 200) {
  return drawn(
      middle, [=](double x, double y) { return std::max(std::abs(x), std::abs(y)) < edge / 2 ? 40 : light; });
}
cv::Mat taken(const cv::Mat& drawn, double blur = 0.7, double noise = 0, std::uint64_t seed = 1) {
  cv::Mat grey = drawn.clone();
  if (blur > 0) cv::GaussianBlur(grey, grey, {}, blur);
  if (noise > 0) {
    cv::Mat random(grey.size(), CV_32F);
    cv::RNG(seed).fill(random, cv::RNG::NORMAL, 0, noise);
    grey += random;
  }
  cv::Mat bytes;
  grey.convertTo(bytes, CV_8U);
  return bytes;
}
double farthest(const Border& border, const Corners& truth) {
  double most = 0;
  for (std::size_t k = 0; k < 4; ++k) most = std::max(most, (border.corners[k] - truth[k]).norm());
  return most;
}

TEST(BorderEdges, LieWhereTheyAreToAFewHundredthsOfAPixel) {
  for (const double part : {0.0, 0.25, 0.375, 0.75}) {
    const Vector2 middle(64 + part, 62 - part);
    const Corners truth = square(50, middle);
    Corners rough = truth;
    for (Vector2& c : rough) c += Vector2(0.6, -0.5);
    const auto border = locate_border(taken(tag(50, middle)), rough);
    ASSERT_TRUE(border) << part;
    EXPECT_LT(farthest(*border, truth), 0.03) << part;
  }
}

// A corner's order and the way around the square do not matter.
TEST(BorderEdges, AreTheSameWhicheverWayTheCornersGo) {
  const Vector2 middle(64.25, 63.125);
  const cv::Mat grey = taken(tag(50, middle));
  Corners corners = square(50, middle);
  const auto one = locate_border(grey, corners);
  std::reverse(corners.begin(), corners.end());
  const auto other = locate_border(grey, corners);
  ASSERT_TRUE(one && other);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((one->corners[k] - other->corners[3 - k]).norm(), 1e-3);
  EXPECT_NEAR(one->sigma, other->sigma, 1e-3);
  EXPECT_NEAR(one->blur, other->blur, 1e-3);
}

// An eighth of the edge is dark inside and light outside; what follows there is no part of the step.
TEST(BorderEdges, OfASmallTagDoNotSeeWhatLiesBesideThem) {
  for (const double edge : {26.0, 32.0, 40.0}) {
    const Vector2 middle(64.25, 63.125);
    const Corners truth = square(edge, middle);
    const cv::Mat grey = drawn(middle, [=](double x, double y) {
      const double r = std::max(std::abs(x), std::abs(y));
      if (r < 0.375 * edge) return 220.0;
      if (r < 0.5 * edge) return 40.0;
      return r < 0.625 * edge ? 220.0 : 40.0;
    });
    const auto border = locate_border(taken(grey, 0.4), truth);
    ASSERT_TRUE(border) << edge;
    EXPECT_LT(farthest(*border, truth), 0.1) << edge;
  }
}

// It is told for a corner; of the four edges it is the worst one's.
TEST(BorderEdges, ScatterAsTheyTell) {
  const Vector2 middle(64.25, 63.125);
  const Corners truth = square(50, middle);
  const cv::Mat clean = tag(50, middle);
  double squares = 0, told = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const auto border = locate_border(taken(clean, 0.7, 8, static_cast<std::uint64_t>(run + 1)), truth);
    ASSERT_TRUE(border);
    for (std::size_t k = 0; k < 4; ++k)
      squares += (border->corners[k] - truth[k]).squaredNorm() / (8 * kRuns);
    told += border->sigma * border->sigma / kRuns;
  }
  const double ratio = std::sqrt(told / squares);
  EXPECT_GT(ratio, 0.7);
  EXPECT_LT(ratio, 1.25);
}

// The pixel, the interpolation and the difference over a pixel blur a little themselves.
TEST(BorderEdges, TellTheirBlur) {
  const Vector2 middle(64.25, 63.125);
  const cv::Mat clean = tag(60, middle);
  for (const double blur : {0.5, 0.8, 1.1}) {
    const auto border = locate_border(taken(clean, blur), square(60, middle));
    ASSERT_TRUE(border) << blur;
    EXPECT_NEAR(border->blur, std::sqrt(blur * blur + 0.48), 0.05) << blur;
  }
}

TEST(BorderEdges, OneThatIsBlurredMakesTheBordersBlur) {
  const Vector2 middle(64, 64);
  const cv::Mat clean = tag(60, middle);
  const cv::Mat sharp = taken(clean, 0.5), smooth = taken(clean, 1.2);
  for (const cv::Rect& part : {cv::Rect(0, 0, 60, 128), cv::Rect(68, 0, 60, 128), cv::Rect(0, 0, 128, 60),
                               cv::Rect(0, 68, 128, 60)}) {
    cv::Mat grey = sharp.clone();
    smooth(part).copyTo(grey(part));
    const auto border = locate_border(grey, square(60, middle));
    ASSERT_TRUE(border) << part;
    EXPECT_GT(border->blur, 1.1) << part;
  }
}

// An eighth of an edge at either end says nothing.
TEST(BorderEdges, AreNotLookedAtNearTheCorners) {
  const Vector2 middle(64, 64);
  const cv::Mat grey = drawn(middle, [](double x, double y) {
    const double a = std::abs(x), b = std::abs(y);
    return std::max(a, b) < 30 && a + b < 54 ? 40.0 : 200.0;
  });
  const auto border = locate_border(taken(grey), square(60, middle));
  ASSERT_TRUE(border);
  EXPECT_LT(farthest(*border, square(60, middle)), 0.02);
  EXPECT_LT(border->sigma, 0.003);
}

// Dirt over a part of an edge bends it at first; what lies off is left out then.
TEST(BorderEdges, LeaveOutWhatLiesOff) {
  const Vector2 middle(64, 64);
  const Corners truth = square(60, middle);
  const cv::Mat grey = drawn(middle, [](double x, double y) {
    const bool bumpy = y > 5 && y < 14 && x < 0;
    return std::max(bumpy ? -x - 1.4 : std::abs(x), std::abs(y)) < 30 ? 40.0 : 200.0;
  });
  const auto border = locate_border(taken(grey), truth);
  ASSERT_TRUE(border);
  EXPECT_LT(farthest(*border, truth), 0.06);
}

}  // namespace
}  // namespace mrroc::vsp
