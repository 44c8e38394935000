// The sensor of the tag: which tags it takes for the object, what hides them, which one it follows, and its
// thresholds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "test/vsp/sensor_objects.hpp"

namespace mrroc::vsp {
namespace {

using test::AprilTag;
using test::facing;
using test::web_plane_camera;

TEST(AprilTagSensorTest, OtherTagsAreNotTheObject) {
  for (const int id : {1, 2, 17, 586}) {
    AprilTagSensor sensor(test::web_camera());
    const Image image =
        web_plane_camera().render(facing(0.5, 0.3, 0.4, 1), test::tag_texture(id, 0.1, 0.025));
    EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen) << id;
    AprilTagSensor own(test::web_camera(), {.id = id});
    EXPECT_TRUE(own.detect(image.view(), 0, 0).seen) << id;
  }
  EXPECT_THROW(AprilTagSensor(test::web_camera(), {.id = 587}), FaultError);
}

TEST(AprilTagSensorTest, ATagWithOneWrongCellIsNone) {
  const auto tag = AprilTag::texture();
  const double cell = kTag.edge / 8;
  for (int k = 0; k < 36; k += 5) {
    const int column = k % 6, row = k / 6;
    const double x = (column - 3) * cell, y = (row - 3) * cell;
    const Image image = web_plane_camera().render(facing(0.5, 0.3, 0.4, 0.2), [&](double a, double b) {
      const bool wrong = a > x && a < x + cell && b > y && b < y + cell;
      return wrong ? 255 - tag(a, b) : tag(a, b);
    });
    AprilTagSensor sensor(test::web_camera());
    EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen) << k;
  }
}

// A hard shadow over the margin takes away the light around the border.
TEST(AprilTagSensorTest, AShadowOverTheMarginHidesTheTagOrDoesNotMatter) {
  const auto tag = AprilTag::texture();
  const Pose T = facing(0.6, 0.3, 0.4, 0.2);
  std::string seen;
  for (const double edge : {-0.07, -0.06, -0.05, -0.045, -0.03, 0.0}) {
    AprilTagSensor sensor(test::web_camera());
    const Image image = web_plane_camera().render(
        T, [&](double x, double y) { return x < edge ? 0.25F * tag(x, y) : tag(x, y); });
    const CameraReading r = sensor.detect(image.view(), 0, 0);
    seen += r.seen ? '1' : '0';
    if (!r.seen) continue;
    EXPECT_LT((r.T_CG.p - T.p).norm(), 0.003) << edge;
    EXPECT_LT((r.T_CG.R - T.R).norm(), 0.05) << edge;
  }
  EXPECT_EQ(seen, "110000") << "a shadow that ends within the margin, or on the tag, hides it";
}

TEST(AprilTagSensorTest, ThresholdsDecideWhatIsSeen) {
  const Pose T = facing(0.6, 0.5, 0.4, 0.2);
  const Image image = web_plane_camera().render(T, AprilTag::texture());
  const auto with = [&](const AprilTagParameters& k) {
    return AprilTagSensor(test::web_camera(), kTag, k).detect(image.view(), 4, 80);
  };
  const CameraReading usual = with({});
  ASSERT_TRUE(usual.seen);
  EXPECT_EQ(usual.frame, 4);
  EXPECT_EQ(usual.step, 80);
  EXPECT_GT(usual.reprojection_px, 0);
  const double px = usual.reprojection_px;
  const double angle = std::sqrt(usual.covariance.diagonal().tail<3>().maxCoeff());
  EXPECT_TRUE(with({.rms_px = px}).seen);
  EXPECT_FALSE(with({.rms_px = 0.999 * px}).seen);
  EXPECT_EQ(with({.rms_px = 0.999 * px}).reprojection_px, 0) << "no pose at all";
  EXPECT_TRUE(with({.worst_angle = 1.001 * angle}).seen);
  const CameraReading uncertain = with({.worst_angle = 0.999 * angle});
  EXPECT_FALSE(uncertain.seen);
  EXPECT_EQ(uncertain.reprojection_px, px);
  EXPECT_EQ(uncertain.T_CG.p, Vector3::Zero());
  EXPECT_FALSE(with({.margin = 200}).seen);
  EXPECT_FALSE(with({.worst_blur = 0.3}).seen);
  EXPECT_FALSE(with({.contrast = 230}).seen);
  AprilTagParameters strict;
  strict.pose.significance = 1e9;
  EXPECT_TRUE(with(strict).ambiguous);
  EXPECT_FALSE(with(strict).seen);
  AprilTagParameters noisy;
  noisy.pose.noise_px = 10 * std::max(0.03, px);
  noisy.pose.significance = 0;
  noisy.worst_angle = 10;
  EXPECT_GT(with(noisy).covariance(0, 0), 20 * usual.covariance(0, 0)) << "noise that is believed";
}

TEST(AprilTagSensorTest, ATagThatIsFollowedStaysTheOneThatIsMeantAndReadsAsAtFirstSight) {
  const auto one = AprilTag::texture();
  const Pose T = facing(0.9, 0.3, 1, 0.2);
  const auto beside = [&](double other) {
    return web_plane_camera().render(
        T, [&, other](double x, double y) { return x > other - 0.1 ? one(x - other, y) : one(x + 0.2, y); });
  };
  AprilTagSensor sensor(test::web_camera());
  const CameraReading first = sensor.detect(beside(100).view(), 0, 0);
  const CameraReading second = sensor.detect(beside(100).view(), 1, 1);
  ASSERT_TRUE(first.seen && second.seen);
  EXPECT_LT((first.T_CG.p - second.T_CG.p).norm(), 1e-5);
  const CameraReading followed = sensor.detect(beside(0.2).view(), 2, 2);
  EXPECT_TRUE(followed.seen);
  EXPECT_LT((followed.T_CG.p - first.T_CG.p).norm(), 1e-3);
  sensor.forget();
  EXPECT_TRUE(sensor.detect(beside(0.2).view(), 3, 3).ambiguous);
  EXPECT_TRUE(sensor.detect(beside(0.2).view(), 4, 4).ambiguous) << "neither of them is followed";
}

TEST(AprilTagSensorTest, ATagInAPictureFullOfEdgesIsSeenAsExactly) {
  const auto tag = AprilTag::texture();
  const Pose T = facing(0.6, 0.3, 0.4, 0.2);
  const Image image = web_plane_camera().render(T, [&](double x, double y) {
    if (std::max(std::abs(x), std::abs(y)) < 0.1) return tag(x, y);
    return std::fmod(std::abs(x), 0.02) < 0.01 ? 235.0F : 60.0F;
  });
  AprilTagSensor sensor(test::web_camera());
  const CameraReading r = sensor.detect(image.view(), 0, 0);
  ASSERT_TRUE(r.seen);
  EXPECT_LT((r.T_CG.p - T.p).norm(), 0.002);
}

TEST(AprilTagSensorTest, TagsOfTheFamilyWithASizeCanBeLookedFor) {
  const auto makes = [](const Tag& tag) {
    try {
      const AprilTagSensor sensor(test::web_camera(), tag);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(e.what()).find("there is no such tag in the family 36h11"), std::string::npos);
      return false;
    }
    return true;
  };
  EXPECT_TRUE(makes({.id = 0}));
  EXPECT_TRUE(makes({.id = 586}));
  EXPECT_FALSE(makes({.id = -1}));
  EXPECT_FALSE(makes({.id = 587}));
  EXPECT_FALSE(makes({.edge = 0}));
  EXPECT_FALSE(makes({.edge = -0.1}));
  const auto corners = Tag{.edge = 0.2}.corners();
  EXPECT_EQ(corners[0], Vector3(-0.1, -0.1, 0));
  EXPECT_EQ(corners[1], Vector3(0.1, -0.1, 0));
  EXPECT_EQ(corners[2], Vector3(0.1, 0.1, 0));
  EXPECT_EQ(corners[3], Vector3(-0.1, 0.1, 0));
}

}  // namespace
}  // namespace mrroc::vsp
