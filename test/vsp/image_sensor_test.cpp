// Contract of both receptors of objects: poses as exact as their goals, none where there is none, the same
// for the same pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/adverse.hpp"
#include "test/vsp/plane_camera.hpp"
#include "test/vsp/sensor_objects.hpp"

namespace mrroc::vsp {
namespace {

using test::AdversePictures;
using test::AprilTag;
using test::Chessboard;
using test::facing;
using test::web_plane_camera;

const test::PlaneCamera& smooth_camera() {
  static const test::PlaneCamera camera(test::web_camera(), 3);
  return camera;
}

template <class Object>
class ImageSensorTest : public testing::Test {
 protected:
  // In view with its margin, 0.3 to 1 m away, tilted by up to 45 degrees.
  Pose in_view() {
    for (;;) {
      const double d = uniform(0.3, 1);
      Pose T = facing(d, uniform(0, std::numbers::pi / 4), uniform(0, 6.3), uniform(0, 6.3),
                      uniform(-0.5, 0.5) * d, uniform(-0.4, 0.4) * d);
      const auto visible = [&](double x, double y) {
        const Vector3 q = T * Vector3(x, y, 0);
        if (q.z() < 0.1) return false;
        const Vector2 p = project(web_plane_camera().model(), q);
        return p.x() > 0 && p.y() > 0 && p.x() < 639 && p.y() < 479;
      };
      const double w = Object::kHalfWidth;
      const double h = Object::kHalfHeight;
      if (visible(w, h) && visible(w, -h) && visible(-w, h) && visible(-w, -h)) return T;
    }
  }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Image picture(const Pose& T, const test::PlaneCamera& camera = web_plane_camera()) {
    test::Exposure exposure;
    exposure.seed = static_cast<unsigned>(random_());
    return camera.render(T, Object::texture(), exposure);
  }
  static double degrees(const Pose& a, const Pose& b) {
    return angle_axis_from_rotation(a.R.transpose() * b.R).norm() * 180 / std::numbers::pi;
  }

  typename Object::Sensor sensor_{test::web_camera()};
  std::mt19937 random_{2};
};
using Objects = testing::Types<Chessboard, AprilTag>;
TYPED_TEST_SUITE(ImageSensorTest, Objects);

TYPED_TEST(ImageSensorTest, SeesEveryObjectInViewAsExactlyAsItsGoal) {
  constexpr int kPictures = 30;
  int misses = 0;
  std::vector<double> millimetres;
  std::vector<double> degrees;
  for (int k = 0; k < kPictures; ++k) {
    const Pose T = this->in_view();
    const CameraReading r = this->sensor_.detect(this->picture(T, smooth_camera()).view(), k, 20 * k);
    if (!r.seen) {
      ++misses;
      continue;
    }
    EXPECT_EQ(r.frame, k);
    EXPECT_EQ(r.step, 20 * k);
    EXPECT_TRUE(is_proper(r.T_CG));
    EXPECT_TRUE(r.covariance.allFinite());
    millimetres.push_back(1e3 * (r.T_CG.p - T.p).norm());
    degrees.push_back(this->degrees(r.T_CG, T));
  }
  EXPECT_LE(misses, TypeParam::kMisses);
  ASSERT_GT(millimetres.size(), 20U);
  std::ranges::sort(millimetres);
  std::ranges::sort(degrees);
  EXPECT_LT(millimetres[millimetres.size() * 95 / 100], TypeParam::kMillimetres);
  EXPECT_LT(degrees[degrees.size() * 95 / 100], TypeParam::kDegrees);
  EXPECT_LT(degrees.back(), 10) << "an end of the object was taken for another";
}

TYPED_TEST(ImageSensorTest, TellsTheEndsOfTheObjectApartHoweverItIsTurned) {
  for (int k = 0; k < 24; ++k) {
    const Pose T = facing(0.6, 0.3, 0.26 * k, 2 * std::numbers::pi * k / 24);
    this->sensor_.forget();
    const CameraReading r = this->sensor_.detect(this->picture(T).view(), k, k);
    ASSERT_TRUE(r.seen) << k;
    EXPECT_LT(this->degrees(r.T_CG, T), 1) << k;
  }
}

TYPED_TEST(ImageSensorTest, FollowsAMovingObjectAndFindsItAgainAfterItWasHidden) {
  const test::PlaneCamera::Texture nothing = [](double, double) { return 120.0F; };
  for (int k = 0; k < 20; ++k) {
    const Pose T = facing(0.6 + 0.01 * k, 0.2, 0.5, 0.3, 0.2 * std::sin(0.8 * k), 0.1 * std::cos(0.8 * k));
    const bool hidden = k == 7 || k == 8;
    const Image image = hidden ? web_plane_camera().render(T, nothing) : this->picture(T);
    const CameraReading r = this->sensor_.detect(image.view(), k, k);
    EXPECT_EQ(r.seen, !hidden) << k;
    EXPECT_TRUE(hidden || (r.T_CG.p - T.p).norm() < 0.002) << k;
  }
}

TYPED_TEST(ImageSensorTest, IsAFunctionOfThePicturesThatItWasGiven) {
  typename TypeParam::Sensor other(test::web_camera());
  for (int k = 0; k < 12; ++k) {
    const Image image = this->picture(this->in_view());
    const CameraReading a = this->sensor_.detect(image.view(), k, k);
    const CameraReading b = other.detect(image.view(), k, k);
    EXPECT_EQ(a.seen, b.seen);
    EXPECT_EQ(a.T_CG.p, b.T_CG.p);
    EXPECT_EQ(a.T_CG.R, b.T_CG.R);
    EXPECT_EQ(a.covariance, b.covariance);
  }
}

TYPED_TEST(ImageSensorTest, IsNotFooledByAdversePictures) {
  AdversePictures pictures(test::web_camera(), TypeParam::kObject, 11);
  for (int k = 0; k < 2 * AdversePictures::kinds(); ++k) {
    const auto picture = pictures.next();
    this->sensor_.forget();
    const CameraReading r = this->sensor_.detect(picture.image.view(), k, k);
    EXPECT_FALSE(test::is_false(r, picture)) << picture.kind << ", picture " << k;
    if (!r.seen) {
      EXPECT_EQ(r.T_CG.p, Vector3::Zero());
    }
  }
}

TYPED_TEST(ImageSensorTest, TwoObjectsAreAmbiguous) {
  const auto one = TypeParam::texture();
  const Image image = web_plane_camera().render(
      facing(0.9, 0.2, 1, 0), [&](double x, double y) { return one(x < 0 ? x + 0.17 : x - 0.17, y); });
  const CameraReading r = this->sensor_.detect(image.view(), 0, 0);
  EXPECT_FALSE(r.seen);
  EXPECT_TRUE(r.ambiguous);
}

TYPED_TEST(ImageSensorTest, PicturesThatCannotBeOfThisCameraShowNothing) {
  const Image good = this->picture(facing(0.6, 0.2, 0, 0));
  EXPECT_FALSE(this->sensor_.detect({}, 0, 0).seen);
  EXPECT_FALSE(this->sensor_.detect(Image(320, 240, 1).view(), 0, 0).seen);
  EXPECT_FALSE(this->sensor_.detect(Image(480, 640, 1).view(), 0, 0).seen);
  EXPECT_FALSE(this->sensor_.detect(Image(640, 480, 4).view(), 0, 0).seen);
  ImageView null = good.view();
  null.data = nullptr;
  EXPECT_FALSE(this->sensor_.detect(null, 0, 0).seen);
  EXPECT_TRUE(this->sensor_.detect(good.view(), 1, 20).seen);
}

TYPED_TEST(ImageSensorTest, ColourIsReadAsBrightness) {
  const Pose T = facing(0.6, 0.2, 0, 0.4);
  const Image grey = this->picture(T);
  Image colour(640, 480, 3);
  for (std::size_t k = 0; k < grey.data.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) colour.data[3 * k + c] = grey.data[k];
  typename TypeParam::Sensor other(test::web_camera());
  const CameraReading a = this->sensor_.detect(grey.view(), 0, 0);
  const CameraReading b = other.detect(colour.view(), 0, 0);
  ASSERT_TRUE(a.seen && b.seen);
  EXPECT_LT((a.T_CG.p - b.T_CG.p).norm(), 1e-4);
}

TYPED_TEST(ImageSensorTest, SmallCamerasDoNotBreakIt) {
  for (const int edge : {16, 17, 40}) {
    CameraModel tiny;
    tiny.width = edge;
    tiny.height = edge;
    tiny.fx = tiny.fy = edge;
    tiny.cx = tiny.cy = 0.5 * (edge - 1);
    typename TypeParam::Sensor sensor(tiny);
    EXPECT_FALSE(sensor.detect(Image(edge, edge, 1).view(), 0, 0).seen);
    const Image image = test::PlaneCamera(tiny, 2).render(facing(0.4, 0.1, 0, 0), TypeParam::texture());
    sensor.detect(image.view(), 1, 1);
  }
  CameraModel wrong;
  wrong.fx = 0;
  EXPECT_THROW(typename TypeParam::Sensor{wrong}, FaultError);
}

// What a receptor does when its configuration says nothing.
TEST(Thresholds, AreTheDocumentedOnesUnlessTheConfigurationSaysOtherwise) {
  const AprilTagParameters tag;
  EXPECT_EQ(tag.search_blur, 0.8);
  EXPECT_EQ(tag.margin, 20);
  EXPECT_EQ(tag.contrast, 15);
  EXPECT_EQ(tag.worst_blur, 1.4);
  EXPECT_EQ(tag.rms_px, 0.2);
  EXPECT_EQ(tag.worst_angle, 0.012);
  EXPECT_EQ(tag.pose.noise_px, 0.03);
  EXPECT_EQ(tag.pose.significance, 49);
  EXPECT_EQ(tag.pose.same_angle, 0.03);
  const ChessboardParameters board;
  EXPECT_EQ(board.offset, 6);
  EXPECT_EQ(board.rms_px, 0.5);
  EXPECT_EQ(board.worst_px, 2);
  EXPECT_EQ(board.pose.noise_px, 0.02);
  EXPECT_EQ(board.pose.significance, 16);
  EXPECT_EQ(board.pose.same_angle, 0.03);
  EXPECT_EQ(kTag.id, 0);
  EXPECT_EQ(kTag.edge, 0.1);
  EXPECT_EQ(kTag.margin, 0.025);
  EXPECT_EQ(kBoard.columns, 9);
  EXPECT_EQ(kBoard.rows, 6);
  EXPECT_EQ(kBoard.square, 0.025);
  EXPECT_EQ(kBoard.margin, 0.025);
}

}  // namespace
}  // namespace mrroc::vsp
