// Names of stickers' colours under any light.
#include <gtest/gtest.h>

#include <random>

#include "vsp/cube_face/sticker_colour.hpp"

namespace mrroc::vsp {
namespace {

/// What stickers reflect; not the numbers that the receptor expects.
constexpr std::array<std::array<double, 3>, kStickerColours> kPaint{{{0.88, 0.86, 0.82},
                                                                     {0.68, 0.07, 0.07},
                                                                     {0.06, 0.52, 0.19},
                                                                     {0.83, 0.75, 0.08},
                                                                     {0.90, 0.37, 0.06},
                                                                     {0.05, 0.19, 0.58}}};

class ColourNames : public testing::Test {
 protected:
  using Stickers = std::array<StickerReading, kStickers>;
  Stickers seen(const std::array<int, kStickers>& colours, const std::array<double, 3>& lamp,
                double noise = 1) {
    Stickers all;
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c)
        all[k].rgb[c] = std::max(0., 220 * lamp[c] * kPaint[static_cast<std::size_t>(colours[k])][c] +
                                         noise * std::normal_distribution<>()(random_));
      all[k].deviation = noise;
    }
    return all;
  }
  std::array<int, kStickers> any() {
    std::array<int, kStickers> colours{};
    for (int& c : colours) c = std::uniform_int_distribution<>(0, kStickerColours - 1)(random_);
    return colours;
  }
  std::mt19937 random_{1};
};

TEST_F(ColourNames, AreRightAndSureInWhiteLightOfAnyStrength) {
  for (const double strength : {1.0, 0.5, 0.2}) {
    const std::array<int, kStickers> all{0, 1, 2, 3, 4, 5, 0, 3, 4};
    Stickers stickers = seen(all, {strength, strength, strength}, 0.5);
    name_colours(stickers);
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(static_cast<int>(stickers[k].colour), all[k]) << k << ' ' << strength;
      EXPECT_GT(stickers[k].confidence, 0.9) << k << ' ' << strength;
      EXPECT_LE(stickers[k].confidence, 1 + 1e-12);
    }
  }
}

TEST_F(ColourNames, AWrongNameInTintedLightIsNoSureOne) {
  int right = 0, sure = 0, wrong_and_sure = 0;
  for (int n = 0; n < 40; ++n) {
    const auto all = any();
    const auto lamp = [&] { return std::exp(std::normal_distribution<>(0, 0.2)(random_)); };
    Stickers stickers = seen(all, {lamp(), 1, lamp()});
    name_colours(stickers);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool good = static_cast<int>(stickers[k].colour) == all[k];
      right += good ? 1 : 0;
      sure += stickers[k].confidence > 0.95 ? 1 : 0;
      wrong_and_sure += !good && stickers[k].confidence > 0.95 ? 1 : 0;
    }
  }
  EXPECT_GT(right, 340) << "of 360";
  EXPECT_GT(sure, 240);
  EXPECT_LE(wrong_and_sure, 3);
}

TEST_F(ColourNames, StickersWithAFlawGetNoneAndDoNotMatter) {
  const std::array<int, kStickers> all{0, 1, 2, 3, 4, 5, 0, 3, 4};
  Stickers stickers = seen(all, {1, 1, 1});
  stickers[4].flaw = StickerFlaw::glaring;
  stickers[4].rgb = {255, 0, 255};
  name_colours(stickers);
  EXPECT_EQ(stickers[4].confidence, 0);
  EXPECT_EQ(stickers[4].colour, StickerColour::white) << "as it was";
  for (const std::size_t k : {0U, 1U, 2U, 3U, 5U, 6U, 7U, 8U})
    EXPECT_EQ(static_cast<int>(stickers[k].colour), all[k]) << k;
  for (StickerReading& s : stickers) s.flaw = StickerFlaw::dark;
  const Stickers before = stickers;
  name_colours(stickers);
  for (std::size_t k = 0; k < stickers.size(); ++k) EXPECT_EQ(stickers[k].confidence, before[k].confidence);
}

TEST_F(ColourNames, AColourThatIsNoneOfThemIsNotSure) {
  Stickers stickers = seen({0, 1, 2, 3, 4, 5, 0, 3, 4}, {1, 1, 1}, 0.5);
  stickers[8].rgb = {150, 20, 150};  // purple
  name_colours(stickers);
  EXPECT_LT(stickers[8].confidence, 0.9);
}

TEST_F(ColourNames, MoreMirroredLightMakesThemLessSure) {
  double before = 2;
  for (const double deviation : {1., 20., 60.}) {
    Stickers stickers = seen({3, 3, 0, 0, 4, 4, 1, 1, 3}, {1, 1, 1}, 0);
    for (StickerReading& s : stickers) s.deviation = deviation;
    name_colours(stickers);
    double mean = 0;
    for (const StickerReading& s : stickers) mean += s.confidence / kStickers;
    EXPECT_LT(mean, before) << deviation;
    before = mean;
  }
}

// What the receptor expects of stickers (vsp/cube_face/colour_names.cpp), in white light of a given strength.
std::array<double, 3> palette(std::size_t name, double strength) {
  constexpr std::array<std::array<double, 3>, kStickerColours> kPalette{{{0.86, 0.86, 0.84},
                                                                         {0.70, 0.06, 0.07},
                                                                         {0.05, 0.50, 0.18},
                                                                         {0.84, 0.74, 0.07},
                                                                         {0.92, 0.36, 0.06},
                                                                         {0.05, 0.20, 0.60}}};
  std::array<double, 3> rgb = kPalette[name];
  for (double& c : rgb) c *= strength;
  return rgb;
}

// The grey that a tint has added counts for more in dim light: what is expected is as bright as what was measured.
TEST_F(ColourNames, AreAsSureInDimLightAsItsTintsAllow) {
  for (const double strength : {230., 60., 15., 1.}) {
    Stickers stickers;
    for (std::size_t k = 0; k < kStickers; ++k) stickers[k].rgb = palette(k % kStickerColours, strength);
    name_colours(stickers);
    for (std::size_t k = 0; k < kStickers; ++k) {
      EXPECT_EQ(static_cast<std::size_t>(stickers[k].colour), k % kStickerColours) << strength << ' ' << k;
      EXPECT_GT(stickers[k].confidence, strength > 100  ? 0.999
                                        : strength > 50 ? 0.99
                                                        : 0.8)
          << strength << ' ' << k;
    }
  }
}

// Half way between two names either is as likely.
TEST_F(ColourNames, BetweenTwoNamesNeitherIsSure) {
  for (const auto& [from, to] : {std::pair(4, 1), {4, 3}, {0, 3}, {2, 5}, {0, 5}}) {
    int changes = 0, last = from;
    double before = 1;
    for (int step = 0; step <= 20; ++step) {
      Stickers stickers = seen({0, 1, 2, 3, 4, 5, from, to, from}, {1, 1, 1}, 0);
      for (std::size_t c = 0; c < 3; ++c)
        stickers[8].rgb[c] *= std::pow(stickers[7].rgb[c] / stickers[6].rgb[c], step / 20.0);
      name_colours(stickers);
      const int now = static_cast<int>(stickers[8].colour);
      if (now != last) {
        ++changes;
        EXPECT_EQ(now, to) << from;
        EXPECT_LT(std::min(before, stickers[8].confidence), 0.75) << from << ' ' << to;
        EXPECT_NEAR(step, 10.5, 2) << from << ' ' << to;
      }
      last = now;
      before = stickers[8].confidence;
    }
    EXPECT_EQ(changes, 1) << from << ' ' << to;
    EXPECT_GT(before, 0.9) << from << ' ' << to;
  }
}

}  // namespace
}  // namespace mrroc::vsp
