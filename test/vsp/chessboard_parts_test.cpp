// The reading of the chessboard is made of its parts: the search around the last place and everywhere, and the pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "test/vsp/plane_camera.hpp"
#include "test/vsp/reading_count.hpp"
#include "vsp/chessboard/board_pose.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

constexpr Board kSmall{.columns = 5, .rows = 4};

/// As chessboard_sensor.hpp says; remembers where the board was.
class Reference {
 public:
  Reference(const CameraModel& camera, const ChessboardParameters& k) : camera_(camera), k_(k) {}

  CameraReading detect(const cv::Mat& picture, std::int64_t frame, std::int64_t step) {
    std::vector<chessboard::InnerCorners> boards;
    bool one = false;
    if (last_) {
      const auto found =
          find_boards(picture, chessboard::search_around(camera_, kSmall, *last_, k_.offset), kSmall);
      boards = found.boards;
      one = found.boards.size() == 1 && !found.unresolved;
    }
    if (!one) chessboard::find_everywhere(picture, kSmall, k_.offset, boards);
    std::vector<PlanarPoses> poses;
    for (const auto& board : boards) {
      const auto pose = chessboard::board_pose(picture, camera_, kSmall, board, k_.pose);
      if (pose && pose->best.rms_px < 4 * k_.rms_px) poses.push_back(*pose);
    }
    CameraReading r;
    r.frame = frame;
    r.step = step;
    last_.reset();
    if (poses.empty()) return r;
    const PlanarPoses& first = poses.front();
    r.reprojection_px = first.best.rms_px;
    r.ambiguous = first.ambiguous;
    if (poses.size() == 1)
      last_ = first.best.T_CG;
    else
      r.ambiguous = true;
    if (r.ambiguous || first.best.rms_px > k_.rms_px || first.best.worst_px > k_.worst_px) return r;
    r.seen = true;
    r.T_CG = first.best.T_CG;
    r.covariance = first.best.covariance;
    return r;
  }

 private:
  CameraModel camera_;
  ChessboardParameters k_;
  std::optional<Pose> last_;
};

TEST(ChessboardParts, MakeTheReading) {
  CameraModel camera = test::web_camera();
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300;
  camera.cx = 159.5;
  camera.cy = 119.5;
  const test::PlaneCamera eye(camera, 1);
  std::mt19937 random(8);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto board = test::chessboard_texture(kSmall.columns, kSmall.rows, kSmall.square, kSmall.margin);
  test::ReadingCount count;
  for (int run = 0; run < 10; ++run) {
    ChessboardParameters k;
    k.offset = 4 + run % 5;
    k.rms_px = run % 2 == 0 ? 0.5 : uniform(0.04, 0.12);
    k.worst_px = run % 3 == 0 ? 2 : uniform(0.15, 0.3);
    k.pose.significance = run % 4 == 3 ? 2000 : 16;
    ChessboardSensor sensor(camera, kSmall, k);
    Reference reference(camera, k);
    const double z = uniform(0.5, 1.1), azimuth = uniform(0, 6.3);
    double x = 0;
    for (int step = 0; step < 12; ++step) {
      x += uniform(-0.05, 0.05);
      const bool hidden = step == 7;
      const double other = step % 5 == 4 ? uniform(0.17, 0.35) : 9;
      const Pose T = test::facing(z, 0.3, azimuth, 0.1 * step, x);
      const Image image = eye.render(T,
                                     [&](double a, double b) {
                                       if (hidden) return 120.0F;
                                       return a > other - 0.09 ? board(a - other, b) : board(a, b);
                                     },
                                     {.noise = 1.0 + run % 4, .seed = static_cast<unsigned>(random())});
      const CameraReading is = sensor.detect(image.view(), step, 20 * step),
                          would = reference.detect(grey(image.view()), step, 20 * step);
      EXPECT_EQ(is.frame, would.frame);
      EXPECT_EQ(is.step, would.step);
      count.compare(is, would, std::to_string(run) + " " + std::to_string(step));
    }
  }
  count.expect_all_kinds();
}

}  // namespace
}  // namespace mrroc::vsp
