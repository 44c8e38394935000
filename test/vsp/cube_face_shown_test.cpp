// Faces with any stickers, spots over some of them: which place is read, what is valid, and how near the truth it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::vsp {
namespace {

CameraModel camera() {
  CameraModel c;
  c.width = 210;
  c.height = 190;
  c.fx = c.fy = 1000;
  c.cx = 104;
  c.cy = 96;
  return c;
}

class FaceShown : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Pose any_place() {
    return {rotation_from_angle_axis({0.2 * uniform(-1, 1), 0.2 * uniform(-1, 1), uniform(-1, 1)}) *
                rotation_from_angle_axis({M_PI, 0, 0}),
            {0, 0, 0.48}};
  }

  /// Stickers of any colours on black, a few of them partly covered.
  Image picture(const Pose& T_CG) {
    Image image(camera().width, camera().height, 3);
    std::ranges::fill(image.data, std::uint8_t{12});
    cv::Mat on(image.height, image.width, CV_8UC3, image.data.data());
    for (int s = 0; s < kStickers; ++s) {
      std::vector<cv::Point> outline;
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        const Vector3 corner = kCubeFace.middle(s) + 0.5 * kCubeFace.sticker * Vector3(x, y, 0);
        const Vector2 p = project(camera(), T_CG * corner);
        outline.emplace_back(static_cast<int>(std::lround(16 * p.x())),
                             static_cast<int>(std::lround(16 * p.y())));
      }
      const std::array<cv::Scalar, 6> paint{cv::Scalar(190, 190, 190),
                                            {15, 15, 160},
                                            {40, 120, 12},
                                            {15, 170, 190},
                                            {14, 80, 210},
                                            {135, 45, 12}};
      const std::size_t colour = random_() % paint.size();
      painted_[static_cast<std::size_t>(s)] = static_cast<StickerColour>(colour);
      cv::fillConvexPoly(on, outline, paint[colour], cv::LINE_AA, 4);
    }
    if (uniform(0, 1) < 0.5)
      cv::circle(on, {static_cast<int>(uniform(50, 160)), static_cast<int>(uniform(40, 150))},
                 static_cast<int>(uniform(2, 12)),
                 cv::Scalar(uniform(0, 255), uniform(0, 255), uniform(0, 255)), cv::FILLED);
    cv::Mat noise(on.size(), CV_8UC3);
    cv::RNG(random_()).fill(noise, cv::RNG::UNIFORM, 0, 9);
    on += noise;
    cv::GaussianBlur(on, on, {}, 0.6);
    return image;
  }

  /// What is wrong with a reading by its own numbers: valid are those without a flaw or a doubt.
  static void expect_validity(const CubeFaceReading& r, const CubeFaceParameters& k, int run) {
    bool sure = r.seen;
    for (const StickerReading& s : r.stickers) {
      const double brightest = *std::ranges::max_element(s.rgb);
      sure = sure && s.flaw == StickerFlaw::none && s.confidence >= k.confidence &&
             s.deviation <= k.veil * brightest;
      EXPECT_TRUE(s.flaw == StickerFlaw::none || s.confidence == 0) << run;
    }
    EXPECT_EQ(r.valid, sure) << run;
    EXPECT_EQ(r.seen, r.place >= 0) << run;
    if (!r.seen) {
      EXPECT_EQ(r.T_CG.p, Vector3::Zero()) << run;
    }
  }
  /// @return stickers without any of these flaws
  static std::ptrdiff_t without(const CubeFaceReading& r, bool any_flaw) {
    return std::ranges::count_if(r.stickers, [&](const StickerReading& s) {
      return s.flaw == StickerFlaw::none || (!any_flaw && s.flaw != StickerFlaw::hidden);
    });
  }
  static void expect_same(const CubeFaceReading& a, const CubeFaceReading& b, int run) {
    EXPECT_EQ(a.T_CG.p, b.T_CG.p) << run;
    EXPECT_EQ(a.T_CG.R, b.T_CG.R) << run;
    EXPECT_EQ(a.covariance, b.covariance) << run;
    EXPECT_EQ(a.valid, b.valid) << run;
    for (std::size_t s = 0; s < kStickers; ++s) {
      EXPECT_EQ(a.stickers[s].rgb, b.stickers[s].rgb) << run;
      EXPECT_EQ(a.stickers[s].flaw, b.stickers[s].flaw) << run;
      EXPECT_EQ(a.stickers[s].confidence, b.stickers[s].confidence) << run;
    }
  }

  std::array<StickerColour, kStickers> painted_{};  // of the last picture
  std::mt19937 random_{13};
};

// The reading over all places is the one of a single place, namely of that with the fewest stickers hidden.
TEST_F(FaceShown, ReadingIsThatOfTheBestPlaceAndIsNearTheTruth) {
  std::array<int, 2> chosen{};
  int seen = 0, right = 0, wrong = 0;
  for (int run = 0; run < 40; ++run) {
    const Pose place = any_place();
    Pose other = place;
    other.p += Vector3(uniform(-0.004, 0.004), uniform(-0.004, 0.004), 0.012);
    const std::vector<Pose> places = run % 2 == 0 ? std::vector{place, other} : std::vector{other, place};
    const Pose truth{place.R, place.p + Vector3(0.001, -0.001, 0.004)};
    const Image image = picture(truth);
    const CubeFaceSensor sensor(camera(), places);
    const CubeFaceReading all = sensor.detect(image.view(), 5, 77);
    EXPECT_EQ(all.frame, 5);
    EXPECT_EQ(all.step, 77);
    const std::array each{sensor.detect(image.view(), 5, 77, 0), sensor.detect(image.view(), 5, 77, 1)};
    for (int n = 0; n < 2; ++n)
      if (each[static_cast<std::size_t>(n)].seen) {
        EXPECT_EQ(each[static_cast<std::size_t>(n)].place, n);
      }
    ASSERT_EQ(all.seen, each[0].seen || each[1].seen) << run;
    if (!all.seen) continue;
    const CubeFaceReading &here = each[static_cast<std::size_t>(all.place)],
                          &there = each[static_cast<std::size_t>(1 - all.place)];
    expect_same(all, here, run);
    // One with a flaw of another kind may be hidden as well.
    if (there.seen) {
      EXPECT_LE(without(there, true), without(here, false)) << run;
    }
    expect_same(all, sensor.detect(image.view(), 5, 77, 2), run);
    ++chosen[static_cast<std::size_t>(all.place)];
    ++seen;
    const Vector3 off = all.T_CG.p - truth.p;
    EXPECT_LT(off.head<2>().norm(), 0.001) << run;
    EXPECT_LT(std::abs(off.z()), 0.006)
        << run << ": the painter makes stickers larger by half a pixel all around";
    EXPECT_LT(angle_axis_from_rotation(all.T_CG.R * truth.R.transpose()).norm(), 0.05) << run;
    for (std::size_t s = 0; s < kStickers; ++s)
      if (all.stickers[s].confidence > 0.95) ++(all.stickers[s].colour == painted_[s] ? right : wrong);
  }
  EXPECT_GT(std::min(chosen[0], chosen[1]), 3);
  EXPECT_GT(seen, 25);
  EXPECT_GT(right, 100);
  EXPECT_LT(wrong, right / 50) << "under the spots";
}

TEST_F(FaceShown, IsValidJustWhenEveryStickerIsSureEnough) {
  int valid = 0, doubtful = 0;
  for (int run = 0; run < 40; ++run) {
    const Pose place = any_place();
    CubeFaceParameters k;
    k.confidence = uniform(0.3, 0.99);
    k.veil = uniform(0.02, 0.3);
    const Image image = picture(place);
    const CubeFaceReading r = CubeFaceSensor(camera(), {place}, k).detect(image.view(), 0, 0);
    expect_validity(r, k, run);
    ++(r.valid ? valid : doubtful);
    if (!r.valid) continue;
    k.confidence = std::ranges::min(r.stickers, {}, &StickerReading::confidence).confidence;
    EXPECT_TRUE(CubeFaceSensor(camera(), {place}, k).detect(image.view(), 0, 0).valid) << "the very one";
    k.confidence = std::nextafter(k.confidence, 1);
    EXPECT_EQ(CubeFaceSensor(camera(), {place}, k).detect(image.view(), 0, 0).valid, k.confidence > 1);
  }
  EXPECT_GT(valid, 5);
  EXPECT_GT(doubtful, 5);
}

}  // namespace
}  // namespace mrroc::vsp
