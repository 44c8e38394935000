// The border of a tag to a fraction of a pixel: a dark square on a light ground whose corners are known.
#include "vsp/apriltag/border.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>

namespace mrroc::vsp {
namespace {

constexpr int kSize = 160;

/// Corners of a square in the order of a tag's: one after the other around it.
Corners square(double edge, double turn, const Vector2& middle) {
  Corners c;
  for (std::size_t k = 0; k < 4; ++k) {
    const double angle = turn + static_cast<double>(k) * M_PI / 2;
    c[k] = middle + edge / std::sqrt(2.) * Vector2(std::cos(angle), std::sin(angle));
  }
  return c;
}

bool is_inside(const Corners& c, const Vector2& p) {
  int left = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2 along = c[(k + 1) % 4] - c[k], to = p - c[k];
    left += along.x() * to.y() - along.y() * to.x() > 0 ? 1 : -1;
  }
  return std::abs(left) == 4;
}

/// @param light  brightness outside, by place
cv::Mat picture(const Corners& c, const std::function<double(const Vector2&)>& light, double dark = 30,
                double blur = 0.6, double noise = 0) {
  constexpr int kFine = 8;
  cv::Mat grey(kSize, kSize, CV_32F);
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      double sum = 0;
      for (int a = 0; a < kFine; ++a)
        for (int b = 0; b < kFine; ++b) {
          const Vector2 p(u - 0.5 + (a + 0.5) / kFine, v - 0.5 + (b + 0.5) / kFine);
          sum += is_inside(c, p) ? dark : light(p);
        }
      grey.at<float>(v, u) = static_cast<float>(sum / (kFine * kFine));
    }
  if (blur > 0) cv::GaussianBlur(grey, grey, {}, blur);
  std::mt19937 random(1);
  std::normal_distribution<> n(0, noise > 0 ? noise : 1);
  if (noise > 0)
    for (int v = 0; v < kSize; ++v)
      for (int u = 0; u < kSize; ++u) grey.at<float>(v, u) += static_cast<float>(n(random));
  cv::Mat result;
  grey.convertTo(result, CV_8U);
  return result;
}
double bright(const Vector2&) { return 200; }

Corners off(const Corners& c, double by) {
  Corners rough = c;
  for (std::size_t k = 0; k < 4; ++k) rough[k] += by * Vector2(k % 2 ? 1 : -0.6, k < 2 ? -1 : 0.8);
  return rough;
}

TEST(Border, CornersAreFoundToAFractionOfAPixel) {
  for (const double edge : {45., 80.})
    for (const double turn : {0.1, 0.785398, 1.2}) {
      const Corners truth = square(edge, turn, {80.3, 78.6});
      const auto border = locate_border(picture(truth, bright), off(truth, 0.8));
      ASSERT_TRUE(border) << edge << ' ' << turn;
      for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((border->corners[k] - truth[k]).norm(), 0.1) << edge;
      EXPECT_LT(border->sigma, 0.05);
    }
}

TEST(Border, NoiseMakesItLessCertainAndTellsSo) {
  const Corners truth = square(60, 0.4, {80, 80});
  const auto clean = locate_border(picture(truth, bright), truth);
  const auto noisy = locate_border(picture(truth, bright, 30, 0.6, 10), truth);
  ASSERT_TRUE(clean && noisy);
  EXPECT_GT(noisy->sigma, 1.5 * clean->sigma);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_LT((noisy->corners[k] - truth[k]).norm(), 6 * noisy->sigma + 0.02);
}

TEST(Border, BlurIsThatOfThePicture) {
  const Corners truth = square(70, 0.3, {80, 80});
  double before = 0;
  for (const double blur : {0.5, 0.8, 1.1}) {
    const auto border = locate_border(picture(truth, bright, 30, blur), truth);
    ASSERT_TRUE(border) << blur;
    EXPECT_NEAR(border->blur, blur, 0.35);
    EXPECT_GT(border->blur, before);
    before = border->blur;
  }
}

TEST(Border, TooLittleContrastIsNoBorder) {
  const Corners truth = square(60, 0.4, {80, 80});
  const auto with = [&](double light) {
    return locate_border(picture(
                             truth, [=](auto&) { return light; }, 100),
                         truth);
  };
  EXPECT_TRUE(with(116));
  EXPECT_FALSE(with(110));
  EXPECT_FALSE(with(100));
  EXPECT_FALSE(with(40)) << "lighter inside than outside";
}

TEST(Border, OneEdgeThatIsMuchFainterThanTheOthersIsNotItsOwn) {
  const Corners truth = square(60, M_PI / 4, {80, 80});
  const auto shaded = [&](double light) {
    return locate_border(picture(truth, [=](const Vector2& p) { return p.x() > 110 ? light : 230.; }), truth);
  };
  EXPECT_TRUE(shaded(230));
  EXPECT_TRUE(shaded(170)) << "140 of 200";
  EXPECT_FALSE(shaded(130)) << "100 of 200";
}

TEST(Border, ASmallSquareOrRoughCornersThatAreFarOffAreRefused) {
  const Corners small = square(11.5, 0.4, {80, 80});
  EXPECT_FALSE(locate_border(picture(small, bright), small));
  const Corners truth = square(60, 0.4, {80, 80});
  EXPECT_FALSE(locate_border(picture(truth, bright), off(truth, 6)));
  EXPECT_FALSE(locate_border(cv::Mat(kSize, kSize, CV_8U, cv::Scalar(120)), truth));
}

// A bright spot on the border moves its step: these places are left out.
TEST(Border, ASpotOnAnEdgeMovesNoCorner) {
  const Corners truth = square(70, M_PI / 4, {80, 80});
  cv::Mat spotted = picture(truth, bright);
  cv::circle(spotted, {45, 70}, 4, cv::Scalar(255), cv::FILLED);
  const auto border = locate_border(spotted, truth);
  ASSERT_TRUE(border);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((border->corners[k] - truth[k]).norm(), 0.15);
  cv::rectangle(spotted, {40, 50, 10, 60}, cv::Scalar(255), cv::FILLED);
  EXPECT_FALSE(locate_border(spotted, truth)) << "next to nothing of the edge is left";
}

TEST(Border, TheLeastContrastIsTwelveGreyLevels) {
  const Corners truth = square(60, M_PI / 4, {80.3, 80.1});
  const auto with = [&](double light) {
    return locate_border(picture(
                             truth, [=](auto&) { return light; }, 100, 0),
                         truth)
        .has_value();
  };
  EXPECT_TRUE(with(112));
  EXPECT_FALSE(with(111));
}

// A light that changes along an edge is no shadow that ends on it.
TEST(Border, ContrastMayChangeALittleAlongAnEdge) {
  const Corners truth = square(70, M_PI / 4, {80, 80});
  const auto with = [&](double share) {
    const auto light = [=](const Vector2& p) { return 30 + 110 * (1 + share * (p.x() - 80) / 35); };
    return locate_border(picture(truth, light), truth).has_value();
  };
  EXPECT_TRUE(with(0));
  EXPECT_TRUE(with(0.22)) << "all of it within 0.35 of the usual contrast";
  EXPECT_FALSE(with(0.7));
}

TEST(Border, TheFaintestEdgeHasSixTenthsOfTheStrongestOnesContrast) {
  const Corners truth = square(60, M_PI / 4, {80, 80});
  const auto with = [&](double share) {
    const auto light = [=](const Vector2& p) { return 30 + 200 * (p.x() > 105 ? share : 1.0); };
    return locate_border(picture(truth, light), truth).has_value();
  };
  EXPECT_TRUE(with(0.65));
  EXPECT_FALSE(with(0.55));
}

// What was assumed at first does not matter for what is told in the end.
TEST(Border, SigmaAndBlurAreThoseOfTheEdgesWhereTheyWereFound) {
  const Corners truth = square(60, 0.4, {80, 80});
  const cv::Mat grey = picture(truth, bright, 30, 0.6, 4);
  const auto exact = locate_border(grey, truth), rough = locate_border(grey, off(truth, 1.6));
  ASSERT_TRUE(exact && rough);
  EXPECT_NEAR(rough->sigma, exact->sigma, 0.15 * exact->sigma);
  EXPECT_NEAR(rough->blur, exact->blur, 0.1 * exact->blur);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT((rough->corners[k] - exact->corners[k]).norm(), 0.03);
}

TEST(Border, EdgesOfTwelvePixelsAreLongEnough) {
  const Corners enough = square(12.3, 0.4, {80, 80}), small = square(11.9, 0.4, {80, 80});
  EXPECT_TRUE(locate_border(picture(enough, bright, 30, 0.3), enough));
  EXPECT_FALSE(locate_border(picture(small, bright, 30, 0.3), small));
}

// Most of an edge must be seen: seven tenths.
TEST(Border, ThreeTenthsOfAnEdgeMayBeCovered) {
  const Corners truth = square(100, M_PI / 4, {80, 80});
  const auto with = [&](int covered) {
    cv::Mat grey = picture(truth, bright);
    cv::rectangle(grey, cv::Rect(20, 80 - covered / 2, 20, covered), cv::Scalar(255), cv::FILLED);
    return locate_border(grey, truth).has_value();
  };
  EXPECT_TRUE(with(16));
  EXPECT_FALSE(with(34));
}

TEST(Border, CornersMayBeFourPixelsFromWhereTheyWereThoughtToBe) {
  const Corners truth = square(90, 0.4, {80, 80});
  const cv::Mat grey = picture(truth, bright);
  const auto moved = [&](double by) {
    Corners rough = truth;
    rough[1] += by * (truth[1] - truth[0]).normalized();
    return locate_border(grey, rough);
  };
  const auto near = moved(3.7);
  ASSERT_TRUE(near);
  EXPECT_LT((near->corners[1] - truth[1]).norm(), 0.1);
  EXPECT_FALSE(moved(4.3));
}

}  // namespace
}  // namespace mrroc::vsp
