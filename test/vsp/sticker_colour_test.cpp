// The colour of one sticker, measured in pictures that are painted by hand: the camera looks straight at the face.
#include "vsp/cube_face/sticker_colour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace mrroc::vsp {
namespace {

using Rgb = std::array<int, 3>;

constexpr int kSticker = 4;  // the middle one

/// 10 pixels for a millimetre; the middle of the face is seen in the middle of the picture.
CameraModel camera() {
  CameraModel c;
  c.width = 601;
  c.height = 601;
  c.fx = c.fy = 10'000;
  c.cx = c.cy = 300;
  return c;
}
Pose place() { return {rotation_from_angle_axis({M_PI, 0, 0}), {0, 0, 1}}; }

/// @param colour  at a place of a sticker: column and row, 0..1 each, of its inside from the lower left
cv::Mat painted(const std::function<Rgb(double x, double y)>& colour, int sticker = kSticker) {
  cv::Mat picture(601, 601, CV_8UC3, cv::Scalar(5, 5, 5));
  const Vector3 middle = kCubeFace.middle(sticker);
  for (int v = 0; v < 601; ++v)
    for (int u = 0; u < 601; ++u) {
      const double x = (u - 300) * 1e-4 - middle.x(), y = (300 - v) * 1e-4 - middle.y();
      if (std::max(std::abs(x), std::abs(y)) > kCubeFace.sticker / 2) continue;
      const double inside = 0.66 * kCubeFace.sticker;
      const Rgb c = colour(x / inside + 0.5, y / inside + 0.5);
      picture.at<cv::Vec3b>(v, u) = {static_cast<std::uint8_t>(c[2]), static_cast<std::uint8_t>(c[1]),
                                     static_cast<std::uint8_t>(c[0])};
    }
  return picture;
}
StickerReading measured(const std::function<Rgb(double x, double y)>& colour,
                        const CubeFaceParameters& k = {}) {
  return measure_sticker(painted(colour), camera(), place(), kCubeFace, kSticker, k);
}
int part(double x) { return static_cast<int>(std::floor(3 * x)); }

TEST(StickerColour, IsThatOfItsInsideWithoutItsBorder) {
  for (const int sticker : {0, 2, 4, 7}) {
    const cv::Mat picture = painted(
        [](double x, double y) {
          const bool inside = std::min(x, y) > -0.1 && std::max(x, y) < 1.1;
          return inside ? Rgb{200, 90, 30} : Rgb{20, 20, 240};
        },
        sticker);
    const StickerReading s = measure_sticker(picture, camera(), place(), kCubeFace, sticker, {});
    EXPECT_EQ(s.rgb, (std::array<double, 3>{200, 90, 30})) << sticker;
    EXPECT_NEAR(s.deviation, 0, 1e-9);
    EXPECT_EQ(s.flaw, StickerFlaw::none);
    EXPECT_EQ(s.confidence, 0) << "a name comes later";
  }
}

TEST(StickerColour, IsTheMeanOfTheThreeLeastBrightParts) {
  const StickerReading s = measured([](double x, double y) {
    const int n = part(x) + 3 * part(y);
    return Rgb{100 + n, 50 + n, 40 + n};
  });
  EXPECT_EQ(s.rgb, (std::array<double, 3>{101, 51, 41}));
  EXPECT_EQ(s.flaw, StickerFlaw::none);
}

// A little of the lamp's light over a third of the sticker: what is mirrored counts six times, above what noise makes.
TEST(StickerColour, MirroredLightIsToldByTheDeviation) {
  const StickerReading s = measured([](double x, double) {
    const int more = part(x) == 1 ? 20 : 0;
    return Rgb{120 + more, 30 + more, 30 + more};
  });
  EXPECT_EQ(s.rgb, (std::array<double, 3>{120, 30, 30}));
  EXPECT_EQ(s.flaw, StickerFlaw::none);
  // Root mean square over the parts, of which a little passes for more light on the same colour.
  const double mirrored = 0.975 * 20 / std::sqrt(3.0);
  EXPECT_NEAR(s.deviation, 6 * (mirrored - 1.5), 1);
  const StickerReading noise = measured([](double x, double) {
    const int more = part(x) == 1 ? 2 : 0;
    return Rgb{120 + more, 30 + more, 30 + more};
  });
  EXPECT_LT(noise.deviation, 0.2) << "noise mirrors nothing";
}

TEST(StickerColour, AShadowIsTheSameColour) {
  const StickerReading s = measured([](double x, double y) {
    return x + y < 1 ? Rgb{90, 30, 60} : Rgb{180, 60, 120};
  });
  EXPECT_EQ(s.flaw, StickerFlaw::none);
  EXPECT_NEAR(s.rgb[0], 90, 2);
  EXPECT_NEAR(s.rgb[2], 60, 2);
}

// Four grey levels and 0.08 of the brightness of another colour are tolerated: 12 of 100.
TEST(StickerColour, MoreThanATraceOfAnotherColourIsMixed) {
  const auto with = [](int more) {
    return measured([more](double x, double) {
      return part(x) == 2 ? Rgb{100, 20 + more, 20} : Rgb{100, 20, 20};
    });
  };
  const StickerReading trace = with(14);
  EXPECT_EQ(trace.flaw, StickerFlaw::none);
  const StickerReading mixed = with(46);
  EXPECT_EQ(mixed.flaw, StickerFlaw::mixed);
  EXPECT_GT(mixed.deviation, trace.deviation);
  EXPECT_EQ(measured([](double x, double) {
              return x < 0.5 ? Rgb{150, 20, 20} : Rgb{20, 120, 40};
            }).flaw,
            StickerFlaw::mixed);
  EXPECT_EQ(measured([](double x, double) {
              return x < 0.4 ? Rgb{20, 20, 150} : Rgb{150, 150, 20};
            }).flaw,
            StickerFlaw::mixed);
}

TEST(StickerColour, LampsMayBeALittleTinted) {
  const auto with = [](double tint) {
    return measured([tint](double x, double) {
             return part(x) == 1 ? Rgb{120 + 90, 40 + 90, static_cast<int>(40 + 90 * tint)}
                                 : Rgb{120, 40, 40};
           })
        .flaw;
  };
  EXPECT_EQ(with(0.8), StickerFlaw::none);
  EXPECT_EQ(with(0), StickerFlaw::mixed);
}

TEST(StickerColour, IsDarkWhenItsBrightestChannelIs) {
  const auto with = [](int red) {
    return measured([red](double, double) { return Rgb{red, 2, 3}; }, {.dark = 20}).flaw;
  };
  EXPECT_EQ(with(20), StickerFlaw::none);
  EXPECT_EQ(with(19), StickerFlaw::dark);
  EXPECT_EQ(measured([](double, double) { return Rgb{2, 3, 20}; }, {.dark = 20}).flaw, StickerFlaw::none);
  EXPECT_EQ(measured([](double, double) { return Rgb{2, 3, 7}; }).flaw, StickerFlaw::dark);
}

// A pixel glares from 250 of its brightest channel on.
TEST(StickerColour, GlareIsLeftOutUntilThereIsTooMuchOfIt) {
  const auto with = [](int parts, int bright, double share = 0.67) {
    return measured(
        [=](double x, double y) {
          return part(x) + 3 * part(y) < parts ? Rgb{bright, 100, 100} : Rgb{60, 70, 80};
        },
        {.glare_share = share});
  };
  for (const int parts : {1, 5, 6}) {
    const StickerReading s = with(parts, 250);
    EXPECT_EQ(s.flaw, StickerFlaw::none) << parts;
    EXPECT_EQ(s.rgb, (std::array<double, 3>{60, 70, 80})) << parts;
    EXPECT_NEAR(s.deviation, 0, 1e-9) << parts;
  }
  const StickerReading most = with(7, 250, 1);
  EXPECT_EQ(most.flaw, StickerFlaw::glaring) << "three parts must be without";
  EXPECT_EQ(most.rgb, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(with(9, 255, 1).flaw, StickerFlaw::glaring);
  EXPECT_EQ(with(3, 250, 0.32).flaw, StickerFlaw::glaring);
  EXPECT_EQ(with(3, 250, 0.35).flaw, StickerFlaw::none);
  EXPECT_GT(with(3, 249).deviation, 50) << "bright, but no glare: light that nothing explains";
  for (const Rgb& lamp : {Rgb{10, 250, 20}, Rgb{10, 20, 255}})
    EXPECT_EQ(measured([&](double, double) { return lamp; }).flaw, StickerFlaw::glaring);
}

TEST(StickerColour, SingleGlaringPixelsDoNotMatter) {
  const StickerReading s = measured([](double x, double y) {
    const bool spark = std::fmod(17 * x + 31 * y, 1.0) < 0.3;
    return spark ? Rgb{255, 255, 255} : Rgb{60, 70, 80};
  });
  EXPECT_EQ(s.flaw, StickerFlaw::none);
  EXPECT_EQ(s.rgb, (std::array<double, 3>{60, 70, 80}));
}

TEST(StickerColour, BeyondThePictureThereIsItsBorder) {
  CameraModel far = camera();
  far.cx = -2000;
  const cv::Mat picture(601, 601, CV_8UC3, cv::Scalar(80, 70, 60));
  EXPECT_EQ(measure_sticker(picture, far, place(), kCubeFace, kSticker, {}).rgb,
            (std::array<double, 3>{60, 70, 80}));
}

}  // namespace
}  // namespace mrroc::vsp
