// The reading of a face is made of its parts: the pose, the colours of the stickers, their names, and what is valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <vector>

#include "vsp/cube_face/face_search.hpp"
#include "vsp/cube_face/sticker_colour.hpp"
#include "vsp/opencv.hpp"

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

class FaceParts : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

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
      cv::fillConvexPoly(on, outline, paint[random_() % 6], cv::LINE_AA, 4);
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

  /// As cube_face_sensor.hpp says.
  static CubeFaceReading expected(const Image& image, const std::vector<Pose>& places, int only,
                                  const CubeFaceParameters& k) {
    const cv::Mat colours = matrix(image.view());
    cv::Mat bright(colours.size(), CV_8U);
    for (int v = 0; v < colours.rows; ++v)
      for (int u = 0; u < colours.cols; ++u) {
        const auto& c = colours.at<cv::Vec3b>(v, u);
        bright.at<unsigned char>(v, u) = std::max({c[0], c[1], c[2]});
      }
    cv::GaussianBlur(bright, bright, {0, 0}, 0.7);
    CubeFaceReading r;
    r.frame = 5;
    r.step = 77;
    std::optional<FoundFace> best;
    for (int n = 0; n < static_cast<int>(places.size()); ++n) {
      if (only >= 0 && only < static_cast<int>(places.size()) && n != only) continue;
      const auto face = find_face(bright, camera(), places[static_cast<std::size_t>(n)], kCubeFace, k);
      if (!face) continue;
      if (best && std::ranges::count(face->whole, true) <= std::ranges::count(best->whole, true)) continue;
      best = face;
      r.place = n;
    }
    if (!best) return r;
    r.seen = r.valid = true;
    r.T_CG = best->T_CG;
    r.covariance = best->covariance;
    r.reprojection_px = best->rms_px;
    for (int s = 0; s < kStickers; ++s) {
      const auto n = static_cast<std::size_t>(s);
      r.stickers[n] = measure_sticker(colours, camera(), best->T_CG, kCubeFace, s, k);
      if (r.stickers[n].flaw == StickerFlaw::none && !best->whole[n])
        r.stickers[n].flaw = StickerFlaw::hidden;
    }
    name_colours(r.stickers);
    for (const StickerReading& s : r.stickers) {
      const double most = std::max({s.rgb[0], s.rgb[1], s.rgb[2]});
      if (s.flaw != StickerFlaw::none || s.confidence < k.confidence || s.deviation > k.veil * most)
        r.valid = false;
    }
    return r;
  }
  std::mt19937 random_{13};
};

TEST_F(FaceParts, MakeTheReading) {
  int valid = 0, seen = 0, flawed = 0;
  std::array<int, 2> chosen{};
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const Pose place{rotation_from_angle_axis({0.2 * uniform(-1, 1), 0.2 * uniform(-1, 1), uniform(-1, 1)}) *
                         rotation_from_angle_axis({M_PI, 0, 0}),
                     {0, 0, 0.48}};
    Pose other = place;
    other.p += Vector3(uniform(-0.004, 0.004), uniform(-0.004, 0.004), 0.012);
    const std::vector<Pose> places = run % 2 == 0 ? std::vector{place, other} : std::vector{other, place};
    CubeFaceParameters k;
    k.confidence = uniform(0.3, 0.99);
    k.veil = uniform(0.02, 0.3);
    const Image image = picture({place.R, place.p + Vector3(0.001, -0.001, 0.004)});
    const int only = run % 5 - 2;
    const CubeFaceReading is = CubeFaceSensor(camera(), places, k).detect(image.view(), 5, 77, only),
                          would = expected(image, places, only, k);
    EXPECT_EQ(is.frame, 5);
    EXPECT_EQ(is.step, 77);
    ASSERT_EQ(is.seen, would.seen) << run;
    ASSERT_EQ(is.place, would.place) << run;
    EXPECT_EQ(is.valid, would.valid) << run;
    EXPECT_EQ(is.T_CG.p, would.T_CG.p) << run;
    EXPECT_EQ(is.covariance, would.covariance) << run;
    EXPECT_EQ(is.reprojection_px, would.reprojection_px) << run;
    for (std::size_t s = 0; s < kStickers; ++s) {
      EXPECT_EQ(is.stickers[s].flaw, would.stickers[s].flaw) << run << ' ' << s;
      EXPECT_EQ(is.stickers[s].rgb, would.stickers[s].rgb) << run << ' ' << s;
      EXPECT_EQ(is.stickers[s].colour, would.stickers[s].colour) << run << ' ' << s;
      EXPECT_EQ(is.stickers[s].confidence, would.stickers[s].confidence) << run << ' ' << s;
      flawed += is.stickers[s].flaw == StickerFlaw::none ? 0 : 1;
    }
    if (is.valid) {
      k.confidence = 1;
      for (const StickerReading& s : is.stickers) k.confidence = std::min(k.confidence, s.confidence);
      EXPECT_TRUE(CubeFaceSensor(camera(), places, k).detect(image.view(), 5, 77, only).valid)
          << "the very one";
    }
    valid += is.valid ? 1 : 0;
    seen += is.seen ? 1 : 0;
    if (is.seen) ++chosen[static_cast<std::size_t>(is.place)];
  }
  EXPECT_GT(valid, 5);
  EXPECT_GT(seen - valid, 5);
  EXPECT_GT(flawed, 5);
  EXPECT_GT(std::min(chosen[0], chosen[1]), 5);
}

}  // namespace
}  // namespace mrroc::vsp
