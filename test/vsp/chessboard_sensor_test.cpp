// The sensor of the chessboard: which boards it takes for the object, how far away, which one it follows,
// and how flat they must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "test/vsp/sensor_objects.hpp"

namespace mrroc::vsp {
namespace {

using test::Chessboard;
using test::facing;
using test::web_plane_camera;

TEST(ChessboardSensorTest, BoardsOfOtherCountsAreNotTheObject) {
  for (const auto& [columns, rows] :
       {std::pair{8, 6}, {10, 6}, {9, 5}, {9, 7}, {10, 7}, {8, 5}, {6, 6}, {9, 9}, {5, 8}, {11, 8}}) {
    ChessboardSensor sensor(test::web_camera());
    const Image image = web_plane_camera().render(facing(0.7, 0.3, 0.4, 1),
                                                  test::chessboard_texture(columns, rows, 0.025, 0.025));
    EXPECT_FALSE(sensor.detect(image.view(), 0, 0).seen) << columns << " x " << rows;
  }
}

TEST(ChessboardSensorTest, ARightBoardBesideAWrongOneIsSeen) {
  const auto right = Chessboard::texture();
  const auto wrong = test::chessboard_texture(7, 6, 0.025, 0.025);
  ChessboardSensor sensor(test::web_camera());
  const Pose T = facing(0.9, 0.2, 1, 0);
  const Image image = web_plane_camera().render(
      T, [&](double x, double y) { return x < 0 ? right(x + 0.17, y) : wrong(x - 0.17, y); });
  const CameraReading r = sensor.detect(image.view(), 0, 0);
  ASSERT_TRUE(r.seen);
  EXPECT_LT((r.T_CG.p - T * Vector3(-0.17, 0, 0)).norm(), 0.001);
}

TEST(ChessboardSensorTest, ABoardOfWhichTheMarginLeavesThePictureMayBeALargerOne) {
  ChessboardSensor sensor(test::web_camera());
  // The lowest row of squares ends at the picture's edge.
  const Image image = web_plane_camera().render(facing(0.5, 0, 0, 0, 0, 0.1175), Chessboard::texture());
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
        sensor.detect(web_plane_camera().render(T, Chessboard::texture(), exposure).view(), 0, 0);
    if (!r.seen) continue;
    ++seen;
    EXPECT_LT((r.T_CG.p - T.p).norm(), 0.02);
  }
  EXPECT_GE(seen, kPictures * 93 / 100);
}

// What is followed stays what is meant, whatever comes into view elsewhere; what has moved far is looked for everywhere.
TEST(ChessboardSensorTest, ABoardThatIsFollowedStaysTheOneThatIsMeant) {
  const auto one = Chessboard::texture();
  const auto beside = [&](double shift, double distance, double other) {
    const Pose T = facing(distance, 0.15, 1, 0);
    return web_plane_camera().render(T, [&, other](double x, double y) {
      return x > other - 0.15 ? one(x - other, y) : one(x - shift, y);
    });
  };
  for (const double distance : {1.1, 2.0, 2.6}) {
    ChessboardSensor sensor(test::web_camera());
    const double left = -0.3 * distance, right = 0.35 * distance;
    ASSERT_TRUE(sensor.detect(beside(left, distance, 100).view(), 0, 0).seen) << distance;
    const CameraReading followed = sensor.detect(beside(left + 0.05, distance, right).view(), 1, 1);
    EXPECT_TRUE(followed.seen) << distance;
    EXPECT_FALSE(followed.ambiguous);
    sensor.forget();
    EXPECT_TRUE(sensor.detect(beside(left + 0.05, distance, right).view(), 2, 2).ambiguous) << distance;
  }
  ChessboardSensor sensor(test::web_camera());
  ASSERT_TRUE(sensor.detect(beside(-0.5, 1.6, 100).view(), 0, 0).seen);
  EXPECT_TRUE(sensor.detect(beside(-0.15, 1.6, 0.4).view(), 1, 1).ambiguous)
      << "more than its own width away";
}

TEST(ChessboardSensorTest, ABoardThatIsNoPlaneIsNoneAndABadOneIsNotSeen) {
  const test::PlaneCamera& camera = web_plane_camera();
  const auto board = Chessboard::texture();
  const Pose T = facing(0.6, 0.3, 0.4, 0.1);
  const auto bent = [&](double by) {  // the right half is shifted upwards, as if folded
    return camera.render(T, [&, by](double x, double y) { return board(x, y - by * std::max(0.0, x)); });
  };
  ChessboardSensor exact(test::web_camera());
  const CameraReading flat = exact.detect(bent(0).view(), 0, 0);
  EXPECT_TRUE(flat.seen);
  EXPECT_GT(flat.reprojection_px, 0.005);
  EXPECT_LT(flat.reprojection_px, 0.2);
  const CameraReading little =
      ChessboardSensor(test::web_camera(), kBoard, {.rms_px = 2, .worst_px = 9, .pose = {}})
          .detect(bent(0.03).view(), 0, 0);
  ASSERT_TRUE(little.seen);
  EXPECT_GT(little.reprojection_px, 0.5);
  const double px = little.reprojection_px;
  const auto seen = [&](double rms, double worst) {
    return ChessboardSensor(test::web_camera(), kBoard, {.rms_px = rms, .worst_px = worst, .pose = {}})
        .detect(bent(0.03).view(), 0, 0);
  };
  EXPECT_TRUE(seen(px, 9).seen);
  const CameraReading bad = seen(0.98 * px, 9);
  EXPECT_FALSE(bad.seen);
  EXPECT_EQ(bad.reprojection_px, px) << "it is told all the same";
  EXPECT_EQ(bad.T_CG.p, Vector3::Zero());
  EXPECT_EQ(seen(0.26 * px, 9).reprojection_px, px);
  EXPECT_EQ(seen(0.24 * px, 9).reprojection_px, 0) << "four times the largest error: no board at all";
  EXPECT_FALSE(seen(2, px).seen) << "one corner is farther off than all in the mean";
}

}  // namespace
}  // namespace mrroc::vsp
