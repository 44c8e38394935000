// Colours of stickers against their formulas: any stickers in any light, and any picture of a face.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "vsp/cube_face/sticker_colour.hpp"

namespace mrroc::vsp {
namespace {

using Rgb = std::array<double, 3>;

constexpr std::array<Rgb, kStickerColours> kPalette{{{0.86, 0.86, 0.84},
                                                     {0.70, 0.06, 0.07},
                                                     {0.05, 0.50, 0.18},
                                                     {0.84, 0.74, 0.07},
                                                     {0.92, 0.36, 0.06},
                                                     {0.05, 0.20, 0.60}}};

using Names = std::array<double, kStickerColours>;

/// @return how likely each name is for a sticker in the light of a lamp whose tint is known
Names densities(const StickerReading& s, double red, double blue) {
  Names all{};
  for (std::size_t name = 0; name < all.size(); ++name) {
    Rgb expected{kPalette[name][0] * std::exp(red), kPalette[name][1], kPalette[name][2] * std::exp(blue)};
    const double as_bright = (s.rgb[0] + s.rgb[1] + s.rgb[2]) / (expected[0] + expected[1] + expected[2]);
    for (double& c : expected) c *= as_bright;
    const auto is = tint(s.rgb), would = tint(expected), variance = s.tint_variance();
    all[name] = std::exp(-0.5 * (std::pow(is[0] - would[0], 2) / (variance[0] + 0.15 * 0.15) +
                                 std::pow(is[1] - would[1], 2) / (variance[1] + 0.15 * 0.15)));
  }
  return all;
}

/// @return probability of every name of sticker k: over all tints, 21 of red and of blue, up to exp(0.75)
Names probabilities(const std::vector<StickerReading>& stickers, std::size_t k) {
  Names all{};
  double total = 0;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) {
      double likelihood = std::exp(-0.5 * 0.075 * 0.075 * (i * i + j * j) / (0.25 * 0.25));
      Names own{};
      for (std::size_t n = 0; n < stickers.size(); ++n) {
        Names d = densities(stickers[n], 0.075 * i, 0.075 * j);
        double sum = 1e-4;  // for colours that have no name
        for (const double x : d) sum += x;
        for (double& x : d) x /= sum;
        likelihood *= sum;
        if (n == k) own = d;
      }
      total += likelihood;
      for (std::size_t name = 0; name < own.size(); ++name) all[name] += likelihood * own[name];
    }
  for (double& p : all) p /= total;
  return all;
}

TEST(ColourFormula, ANameHasTheProbabilityThatAllTintsTogetherGiveIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> level(3, 240), deviation(0, 30), lamp(0.5, 2);
  for (int run = 0; run < 12; ++run) {
    std::array<StickerReading, kStickers> stickers;
    std::vector<StickerReading> good;
    const double red = lamp(random), blue = lamp(random);
    for (std::size_t k = 0; k < stickers.size(); ++k) {
      StickerReading& s = stickers[k];
      s.rgb = kPalette[random() % kPalette.size()];
      for (double& c : s.rgb) c = run % 3 == 0 ? level(random) : 150 * c + 0.02 * level(random);
      s.rgb[0] *= red;
      s.rgb[2] *= blue;
      s.deviation = deviation(random);
      if (k % 2 == 0) s.confidence = 0.5;  // as somebody else has thought
      if ((k + static_cast<std::size_t>(run)) % 4 == 3) s.flaw = StickerFlaw::mixed;
      if (s.flaw == StickerFlaw::none) good.push_back(s);
    }
    name_colours(stickers);
    std::size_t n = 0;
    for (const StickerReading& s : stickers) {
      if (s.flaw != StickerFlaw::none) {
        continue;
      }
      const Names expected = probabilities(good, n++);
      const auto best = std::ranges::max_element(expected);
      EXPECT_EQ(static_cast<std::ptrdiff_t>(s.colour), best - expected.begin()) << run;
      EXPECT_NEAR(s.confidence, *best, 1e-10) << run;
    }
  }
}

CameraModel camera() {
  CameraModel c;
  c.width = 300;
  c.height = 280;
  c.fx = 2500;
  c.fy = 2600;
  c.cx = 148;
  c.cy = 141;
  return c;
}

double middle_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// A ninth of a sticker's inside.
struct Ninth {
  Rgb rgb{};
  double glare{};
};

/// @return the medians of 6 x 6 places, and the share of those that are as bright as can be
Ninth ninth(const cv::Mat& picture, const Pose& T_CG, int sticker, int column, int row) {
  std::array<std::vector<double>, 3> values;
  int glaring = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double edge = 0.66 * kCubeFace.sticker / 3;
      const Vector3 place =
          kCubeFace.middle(sticker) + edge * Vector3(column - 1 + (i - 2.5) / 6, row - 1 + (j - 2.5) / 6, 0);
      const Vector2 p = project(camera(), T_CG * place);
      const auto& bgr =
          picture.at<cv::Vec3b>(static_cast<int>(std::lround(p.y())), static_cast<int>(std::lround(p.x())));
      if (std::max({bgr[0], bgr[1], bgr[2]}) >= 250)
        ++glaring;
      else
        for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)].push_back(bgr[2 - c]);
    }
  Ninth n{.glare = glaring / 36.0};
  for (std::size_t c = 0; c < 3; ++c)
    if (!values[c].empty()) n.rgb[c] = middle_of(values[c]);
  return n;
}

/// @return rgb, deviation and flaw as sticker_colour.hpp says
StickerReading expected(const cv::Mat& picture, const Pose& T_CG, int sticker, const CubeFaceParameters& k) {
  StickerReading s;
  std::vector<Ninth> used;
  double glare = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const Ninth n = ninth(picture, T_CG, sticker, column, row);
      glare += n.glare / 9;
      if (n.glare < 0.5) used.push_back(n);
    }
  if (used.size() < 3 || glare > k.glare_share) {
    s.flaw = StickerFlaw::glaring;
    return s;
  }
  std::ranges::sort(used, {}, [](const Ninth& n) { return *std::ranges::min_element(n.rgb); });
  for (std::size_t c = 0; c < 3; ++c) s.rgb[c] = (used[0].rgb[c] + used[1].rgb[c] + used[2].rgb[c]) / 3;
  const double brightest = *std::ranges::max_element(s.rgb);
  const double tolerance = 4 + 0.08 * brightest;
  const Vector3 colour(s.rgb[0], s.rgb[1], s.rgb[2]);
  double mirrored = 0, unexplained = 0;
  for (const Ninth& n : used) {
    // Least squares with a little preference for small shares: of the colour, and of the lamp's grey.
    Eigen::Matrix<double, 5, 2> A;
    A << colour / (brightest + 1), Vector3::Ones(), std::sqrt(0.03), 0, 0, std::sqrt(0.03);
    Eigen::Matrix<double, 5, 1> b;
    b << Vector3(n.rgb[0], n.rgb[1], n.rgb[2]) - colour, 0, 0;
    const Eigen::Vector2d share = A.colPivHouseholderQr().solve(b);
    const double left = (b - A * share).head<3>().cwiseAbs().maxCoeff();
    mirrored += share[1] * share[1];
    unexplained += left * left;
    if (share[1] <= -tolerance || left >= tolerance + 0.3 * std::max(0.0, share[1]))
      s.flaw = StickerFlaw::mixed;
  }
  const auto count = static_cast<double>(used.size());
  s.deviation = 6 * std::max(0.0, std::sqrt(mirrored / count) - 1.5) + std::sqrt(unexplained / count);
  if (s.flaw == StickerFlaw::none && brightest < k.dark) s.flaw = StickerFlaw::dark;
  return s;
}

TEST(ColourFormula, AStickerIsReadFromTheNinthsOfItsInside) {
  std::mt19937 random(5);
  std::array<int, 5> flaws{};
  for (int run = 0; run < 60; ++run) {
    const Pose T{rotation_from_angle_axis({0, 0, 0.02 * run}) * rotation_from_angle_axis({M_PI, 0.1, 0.05}),
                 {0.001, -0.002, 0.7}};
    // Patches of about a ninth of a sticker, on a ground that changes little.
    cv::Mat picture(280, 300, CV_8UC3);
    const int patch = 5 + run % 9, swing = 4 + 6 * (run % 12), base = 3 + static_cast<int>(random() % 190);
    std::vector<int> patches(3 * 60 * 60);
    for (int& p : patches) p = static_cast<int>(random() % static_cast<unsigned>(swing));
    const std::array<int, 3> paint{base, base * (2 + run % 3) / 5, base * (1 + run % 4) / 5};
    for (int v = 0; v < picture.rows; ++v)
      for (int u = 0; u < picture.cols; ++u)
        for (int c = 0; c < 3; ++c) {
          const int where = (v / patch * 60 + u / patch) * 3;
          const int grey = patches[static_cast<std::size_t>(where)];
          const int own = run % 2 == 0 ? patches[static_cast<std::size_t>(where + c)] / 3 : 0;
          const int lamp = run % 5 == 4 && grey % 5 == 0 ? 255 : 0;
          picture.at<cv::Vec3b>(v, u)[c] = static_cast<std::uint8_t>(std::min(
              255, paint[static_cast<std::size_t>(c)] + grey + own + lamp + static_cast<int>(random() % 4)));
        }
    const CubeFaceParameters k{.glare_share = 0.2, .dark = 20};
    for (int sticker = 0; sticker < kStickers; ++sticker) {
      const StickerReading is = measure_sticker(picture, camera(), T, kCubeFace, sticker, k);
      const StickerReading would = expected(picture, T, sticker, k);
      ASSERT_EQ(is.flaw, would.flaw) << run << ' ' << sticker;
      ++flaws[static_cast<std::size_t>(is.flaw)];
      for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(is.rgb[c], would.rgb[c], 1e-9) << run << ' ' << sticker;
      ASSERT_NEAR(is.deviation, would.deviation, 1e-7) << run << ' ' << sticker;
    }
  }
  for (const StickerFlaw f : {StickerFlaw::none, StickerFlaw::glaring, StickerFlaw::dark, StickerFlaw::mixed})
    EXPECT_GT(flaws[static_cast<std::size_t>(f)], 10) << to_string(f);
}

}  // namespace
}  // namespace mrroc::vsp
