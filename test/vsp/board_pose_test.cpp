// From a pose of the board to the part of the next picture that is searched for it, and from corners to the pose.
#include "vsp/chessboard/board_pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "test/vsp/plane_camera.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp::chessboard {
namespace {

class BoardPose : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Pose any_pose(double farthest) {
    const double z = uniform(0.15, farthest);
    return test::facing(z, uniform(0, 0.9), uniform(0, 6.3), uniform(0, 6.3), uniform(-0.7, 0.7) * z,
                        uniform(-0.5, 0.5) * z);
  }
  static inline const Pose kThere = test::facing(0.7, 0.3, 1, 0.2);
  /// The board at that place.
  static Image picture() {
    return test::web_plane_camera().render(kThere, test::chessboard_texture(9, 6, 0.025, 0.025));
  }
  std::mt19937 random_{9};
};

TEST_F(BoardPose, ThePartReachesAThirdOfTheBoardBeyondItAndIsEnlargedForSmallSquares) {
  std::array<int, 4> scales{};
  for (int run = 0; run < 3000; ++run) {
    const Board board{.columns = 3 + run % 7, .rows = 3 + run % 5};
    CameraModel camera = test::web_camera();
    camera.width = 200 + run % 600;
    camera.height = 150 + run % 500;
    const Pose T = any_pose(run % 2 == 0 ? 0.6 : 3);
    std::vector<double> x, y, edges;
    for (int r = 0; r < board.rows; ++r)
      for (int c = 0; c < board.columns; ++c) {
        const Vector2 p = project(camera, T * board.corner(r, c));
        x.push_back(p.x());
        y.push_back(p.y());
        if (c + 1 < board.columns) edges.push_back((project(camera, T * board.corner(r, c + 1)) - p).norm());
      }
    const auto [x_low, x_high] = std::ranges::minmax(x);
    const auto [y_low, y_high] = std::ranges::minmax(y);
    // Of what is not in the picture nothing matters but how far it reaches in.
    const double left = std::min(x_low, 1.0 * camera.width), right = std::max(x_high, 0.0),
                 up = std::min(y_low, 1.0 * camera.height), low = std::max(y_high, 0.0);
    const double reach = std::max(30.0, 0.35 * std::max(right - left, low - up));
    const auto within = [](double a, int limit) {
      return static_cast<int>(std::lround(std::min(std::max(a, 0.0), 1.0 * limit)));
    };
    const int first_x = within(left - reach, camera.width), last_x = within(right + reach, camera.width);
    const int first_y = within(up - reach, camera.height), last_y = within(low + reach, camera.height);
    const Search s = search_around(camera, board, T, run % 9);
    EXPECT_EQ(s.x, first_x) << run;
    EXPECT_EQ(s.y, first_y) << run;
    EXPECT_EQ(s.x + s.width, last_x) << run;
    EXPECT_EQ(s.y + s.height, last_y) << run;
    const double square = *std::ranges::min_element(edges);
    int scale = 1;
    for (const int larger : {2, 3}) {
      const bool needed = (larger - 1) * square < 16;
      if (needed && larger * larger * s.width * s.height <= camera.width * camera.height) scale = larger;
    }
    EXPECT_EQ(s.scale, scale) << run;
    ++scales[static_cast<std::size_t>(scale)];
    EXPECT_EQ(s.block, 1 + 2 * std::min(50, std::max(12, static_cast<int>(1.2 * square * scale)))) << run;
    EXPECT_EQ(s.offset, run % 9);
  }
  for (const int scale : {1, 2, 3}) EXPECT_GT(scales[static_cast<std::size_t>(scale)], 100) << scale;
}

TEST_F(BoardPose, WhereACornerHasSlidAllAreLocatedAgain) {
  const CameraModel camera = test::web_camera();
  std::vector<Vector3> model;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c) model.push_back(kBoard.corner(r, c));
  const Image image = picture();
  const cv::Mat brightness = grey(image.view());
  int again = 0, as_they_were = 0, not_better = 0;
  for (int run = 0; run < 40; ++run) {
    const Pose T = test::facing(uniform(0.5, 0.9), uniform(0.1, 0.5), uniform(0, 6.3), uniform(0, 6.3));
    InnerCorners corners{{}, 20};
    std::normal_distribution<> noise(0, 0.01 + 0.1 * (run % 3));
    const Pose seen = run % 4 != 0 ? kThere : T;
    for (const Vector3& p : model)
      corners.pixels.emplace_back(project(camera, seen * p) + Vector2(noise(random_), noise(random_)));
    const double slid = uniform(0, 1.5);
    corners.pixels[static_cast<std::size_t>(run)] += Vector2(slid, 0);
    const auto first = planar_pose(camera, model, corners.pixels);
    ASSERT_TRUE(first);
    PlanarPoses would = *first;
    if (first->best.worst_px >= 3 * first->best.rms_px) {
      InnerCorners located{{}, 20};
      for (const Vector3& p : model) located.pixels.push_back(project(camera, first->best.T_CG * p));
      if (locate(brightness, located)) {
        const auto second = planar_pose(camera, model, located.pixels);
        ASSERT_TRUE(second);
        const bool better = second->best.rms_px < first->best.rms_px;
        if (better) would = *second;
        ++(better ? again : not_better);
      }
    } else {
      ++as_they_were;
    }
    const auto is = board_pose(brightness, camera, kBoard, corners, {});
    ASSERT_TRUE(is);
    EXPECT_EQ(is->best.T_CG.p, would.best.T_CG.p) << run;
    EXPECT_EQ(is->best.rms_px, would.best.rms_px) << run;
  }
  EXPECT_GT(again, 3);
  EXPECT_GT(not_better, 0);
  EXPECT_GT(as_they_were, 10);
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
