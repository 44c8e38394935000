// What both receptors of objects promise: poses as exact as their goals, none where there is none, the same for the
// same pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "base/fault.hpp"
#include "test/vsp/adverse.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::vsp {
namespace {

using test::AdversePictures;
using test::facing;

const test::PlaneCamera& web_camera() {
  static const test::PlaneCamera camera(test::web_camera(), 2);
  return camera;
}
const test::PlaneCamera& smooth_camera() {
  static const test::PlaneCamera camera(test::web_camera(), 3);
  return camera;
}

struct Chessboard {
  using Sensor = ChessboardSensor;
  static constexpr auto kObject = AdversePictures::Object::chessboard;
  static constexpr double kMillimetres = 0.5, kDegrees = 0.2;  // 95 %, 0.3 to 1 m, tilt up to 45 degrees
  static constexpr int kMisses = 0;                            // of 30
  static constexpr double kHalfWidth = 0.15, kHalfHeight = 0.1125;
  static test::PlaneCamera::Texture texture(float table = 120) {
    return test::chessboard_texture(kBoard.columns, kBoard.rows, kBoard.square, kBoard.margin, table);
  }
};
struct AprilTag {
  using Sensor = AprilTagSensor;
  static constexpr auto kObject = AdversePictures::Object::apriltag;
  static constexpr double kMillimetres = 1.5, kDegrees = 0.6;
  static constexpr int kMisses = 2;
  static constexpr double kHalfWidth = 0.075, kHalfHeight = 0.075;
  static test::PlaneCamera::Texture texture(float table = 120) {
    return test::tag_texture(kTag.id, kTag.edge, kTag.margin, table);
  }
};

template <class Object>
class ImageSensorTest : public testing::Test {
 protected:
  // In view with its margin, 0.3 to 1 m away, tilted by up to 45 degrees.
  Pose in_view() {
    for (;;) {
      const double d = uniform(0.3, 1);
      const Pose T = facing(d, uniform(0, std::numbers::pi / 4), uniform(0, 6.3), uniform(0, 6.3),
                            uniform(-0.5, 0.5) * d, uniform(-0.4, 0.4) * d);
      const auto visible = [&](double x, double y) {
        const Vector3 q = T * Vector3(x, y, 0);
        if (q.z() < 0.1) return false;
        const Vector2 p = project(web_camera().model(), q);
        return p.x() > 0 && p.y() > 0 && p.x() < 639 && p.y() < 479;
      };
      const double w = Object::kHalfWidth;
      const double h = Object::kHalfHeight;
      if (visible(w, h) && visible(w, -h) && visible(-w, h) && visible(-w, -h)) return T;
    }
  }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Image picture(const Pose& T, const test::PlaneCamera& camera = web_camera()) {
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
    const Image image = hidden ? web_camera().render(T, nothing) : this->picture(T);
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
  const Image image = web_camera().render(
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

TEST(ChessboardSensorTest, BoardsOfOtherCountsAreNotTheObject) {
  for (const auto& [columns, rows] :
       {std::pair{8, 6}, {10, 6}, {9, 5}, {9, 7}, {10, 7}, {8, 5}, {6, 6}, {9, 9}, {5, 8}, {11, 8}}) {
    ChessboardSensor sensor(test::web_camera());
    const Image image =
        web_camera().render(facing(0.7, 0.3, 0.4, 1), test::chessboard_texture(columns, rows, 0.025, 0.025));
    EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen) << columns << " x " << rows;
  }
}

TEST(ChessboardSensorTest, ARightBoardBesideAWrongOneIsSeen) {
  const auto right = Chessboard::texture();
  const auto wrong = test::chessboard_texture(7, 6, 0.025, 0.025);
  ChessboardSensor sensor(test::web_camera());
  const Pose T = facing(0.9, 0.2, 1, 0);
  const Image image = web_camera().render(
      T, [&](double x, double y) { return x < 0 ? right(x + 0.17, y) : wrong(x - 0.17, y); });
  const CameraReading r = sensor.detect(image.view(), 0, 0);
  ASSERT_TRUE(r.seen);
  EXPECT_LT((r.T_CG.p - T * Vector3(-0.17, 0, 0)).norm(), 0.001);
}

TEST(ChessboardSensorTest, ABoardOfWhichTheMarginLeavesThePictureMayBeALargerOne) {
  ChessboardSensor sensor(test::web_camera());
  // The lowest row of squares ends at the picture's edge.
  const Image image = web_camera().render(facing(0.5, 0, 0, 0, 0, 0.1175), Chessboard::texture());
  EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen);
}

TEST(ChessboardSensorTest, FarBoardsAreSeen) {
  int seen = 0;
  constexpr int kPictures = 30;
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  for (int k = 0; k < kPictures; ++k) {
    ChessboardSensor sensor(test::web_camera());
    test::Exposure exposure;
    exposure.seed = static_cast<unsigned>(random());
    const Pose T = facing(uniform(1.5, 2), uniform(0, 0.78), uniform(0, 6.3), uniform(0, 6.3),
                          uniform(-0.4, 0.4), uniform(-0.3, 0.3));
    const CameraReading r =
        sensor.detect(web_camera().render(T, Chessboard::texture(), exposure).view(), 0, 0);
    if (!r.seen) continue;
    ++seen;
    EXPECT_LT((r.T_CG.p - T.p).norm(), 0.02);
  }
  EXPECT_GE(seen, kPictures * 93 / 100);
}

TEST(AprilTagSensorTest, OtherTagsAreNotTheObject) {
  for (const int id : {1, 2, 17, 586}) {
    AprilTagSensor sensor(test::web_camera());
    const Image image = web_camera().render(facing(0.5, 0.3, 0.4, 1), test::tag_texture(id, 0.1, 0.025));
    EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen) << id;
    AprilTagSensor own(test::web_camera(), {.id = id});
    EXPECT_TRUE(own.detect(image.view(), 0, 0).seen) << id;
  }
  EXPECT_THROW(AprilTagSensor(test::web_camera(), {.id = 587}), FaultError);
}

// A hard shadow over the margin takes away the light around the border.
TEST(AprilTagSensorTest, AShadowOverTheMarginHidesTheTagOrDoesNotMatter) {
  const auto tag = AprilTag::texture();
  const Pose T = facing(0.6, 0.3, 0.4, 0.2);
  for (const double edge : {-0.07, -0.06, -0.05, -0.045, -0.03, 0.0}) {
    AprilTagSensor sensor(test::web_camera());
    const Image image =
        web_camera().render(T, [&](double x, double y) { return x < edge ? 0.25F * tag(x, y) : tag(x, y); });
    const CameraReading r = sensor.detect(image.view(), 0, 0);
    if (r.seen) {
      EXPECT_LT((r.T_CG.p - T.p).norm(), 0.003) << edge;
    }
  }
}

}  // namespace
}  // namespace mrroc::vsp
