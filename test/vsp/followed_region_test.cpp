// Search region of an object that was seen before: around its last place, so that another one beside it does
// not matter, and how far around.
#include <gtest/gtest.h>

#include "test/vsp/plane_camera.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::vsp {
namespace {

const test::PlaneCamera& straight_camera() {
  static const test::PlaneCamera camera(CameraModel{}, 2);
  return camera;
}
using Texture = test::PlaneCamera::Texture;

/// The object, and another one that is shifted by x, y [m].
Image with_another(const Pose& T, const Texture& one, const Texture& other, double x, double y) {
  return straight_camera().render(T, [&](double a, double b) {
    const float light = other(a - x, b - y);
    return light > 119 && light < 121 ? one(a, b) : light;
  });
}
Image alone(const Pose& T, const Texture& one) { return straight_camera().render(T, one); }

// A tag of 120 pixels is looked for half of that around it.
TEST(FollowedTag, AnotherOneBeyondHalfItsSizeDoesNotMatter) {
  const Pose T = test::facing(0.5, 0.35, 1, 0);
  const Texture tag = test::tag_texture(0, 0.1, 0.025), small = test::tag_texture(0, 0.03, 0.0075);
  for (const auto& [x, y] : {std::pair(0.12, 0.0), {-0.12, 0.0}, {0.0, 0.12}, {0.0, -0.12}}) {
    AprilTagSensor sensor(CameraModel{});
    ASSERT_TRUE(sensor.detect(alone(T, tag).view(), 0, 0).seen);
    const Image two = with_another(T, tag, small, x, y);
    EXPECT_TRUE(sensor.detect(two.view(), 1, 1).seen) << x << ' ' << y;
    sensor.forget();
    EXPECT_TRUE(sensor.detect(two.view(), 2, 2).ambiguous) << x << ' ' << y;
  }
}

// What has moved is found wherever it is, as if for the first time.
TEST(FollowedTag, IsFoundWhereverItMoves) {
  AprilTagSensor sensor(CameraModel{});
  const Texture tag = test::tag_texture(0, 0.1, 0.025);
  int k = 0;
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), {0.02, 0.0}, {0.18, 0.1}, {-0.18, 0.1}, {-0.18, -0.12}, {0.18, -0.12}}) {
    const Pose T = test::facing(0.5, 0.35, 1, 0.1, x, y);
    const CameraReading r = sensor.detect(alone(T, tag).view(), k, k);
    ASSERT_TRUE(r.seen) << x << ' ' << y;
    EXPECT_LT((r.T_CG.p - T.p).norm(), 0.002) << x << ' ' << y;
    ++k;
  }
}

// At the picture's borders the part that is looked at ends there.
TEST(FollowedBoard, IsSeenAgainAtEveryBorderOfThePicture) {
  const Texture board = test::chessboard_texture(9, 6, 0.025, 0.025);
  for (const double z : {0.75, 1.6}) {
    const double x = 0.53 * z - 0.165, y = 0.395 * z - 0.13;
    for (const auto& [a, b] : {std::pair(x, 0.0), {-x, 0.0}, {0.0, y}, {0.0, -y}, {x, y}, {-x, -y}}) {
      ChessboardSensor sensor(CameraModel{});
      const Pose T = test::facing(z, 0.1, 0.5, 0, a, b);
      const Image image = alone(T, board);
      const CameraReading first = sensor.detect(image.view(), 0, 0),
                          second = sensor.detect(image.view(), 1, 1);
      ASSERT_TRUE(first.seen && second.seen) << z << ' ' << a << ' ' << b;
      EXPECT_LT((first.T_CG.p - second.T_CG.p).norm(), 1e-3);
      EXPECT_LT((second.T_CG.p - T.p).norm(), 2e-3 * z);
    }
  }
}

// The part that is looked at reaches a third of the board's size beyond it, to every side.
TEST(FollowedBoard, AnotherOneBeyondAThirdOfItsSizeDoesNotMatter) {
  const Texture board = test::chessboard_texture(9, 6, 0.025, 0.025);
  const Pose T = test::facing(1.6, 0.1, 0.5, 0);
  // Its inner corners take 0.2 x 0.125 m: it is looked for 0.07 m around them.
  for (const auto& [x, y] : {std::pair(0.36, 0.0), {-0.36, 0.0}, {0.0, 0.29}, {0.0, -0.29}}) {
    ChessboardSensor sensor(CameraModel{});
    ASSERT_TRUE(sensor.detect(alone(T, board).view(), 0, 0).seen);
    const Image two = with_another(T, board, board, x, y);
    EXPECT_TRUE(sensor.detect(two.view(), 1, 1).seen) << x << ' ' << y;
    sensor.forget();
    const CameraReading r = sensor.detect(two.view(), 2, 2);
    EXPECT_TRUE(r.ambiguous) << x << ' ' << y;
    EXPECT_FALSE(sensor.detect(two.view(), 3, 3).seen) << "neither of them is followed";
  }
}

}  // namespace
}  // namespace mrroc::vsp
