#include "vsp/chessboard/board_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mrroc::vsp::chessboard {
namespace {

constexpr double kGoodSquare = 16;  // edge at which outlines of squares are easily told apart [pixel]
constexpr int kLargestScale = 3;
constexpr double kRegionMargin = 0.35;  // around the last place, in sizes of the board

constexpr double kSlid = 3;  // of a corner's distance to the root mean square of all: noise reaches 2.3

std::vector<Vector3> model_of(const Board& board) {
  std::vector<Vector3> model;
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) model.push_back(board.corner(r, c));
  return model;
}

}  // namespace

Search search_around(const CameraModel& camera, const Board& board, const Pose& T_CG, int offset) {
  Vector2 low(camera.width, camera.height);
  Vector2 high(0, 0);
  double square = std::numeric_limits<double>::max();
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) {
      const Vector2 p = project(camera, T_CG * board.corner(r, c));
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      if (c > 0) square = std::min(square, (p - project(camera, T_CG * board.corner(r, c - 1))).norm());
    }
  const double reach = std::max(30.0, kRegionMargin * (high - low).maxCoeff());
  const auto place = [](double x, int limit) {
    return std::clamp(static_cast<int>(std::lround(x)), 0, limit);
  };
  Search s;
  s.x = place(low.x() - reach, camera.width);
  s.y = place(low.y() - reach, camera.height);
  s.width = place(high.x() + reach, camera.width) - s.x;
  s.height = place(high.y() + reach, camera.height) - s.y;
  s.scale = std::clamp(static_cast<int>(std::ceil(kGoodSquare / std::max(1.0, square))), 1, kLargestScale);
  while (s.scale > 1 && s.width * s.scale * s.height * s.scale > camera.width * camera.height) --s.scale;
  s.block = 2 * std::clamp(static_cast<int>(1.2 * square * s.scale), 12, 50) + 1;
  s.offset = offset;
  return s;
}

std::optional<PlanarPoses> board_pose(const cv::Mat& grey, const CameraModel& camera, const Board& board,
                                      const InnerCorners& corners, const PlanarPoseParameters& parameters) {
  const std::vector<Vector3> model = model_of(board);
  auto first = planar_pose(camera, model, corners.pixels, parameters);
  if (!first || first->best.worst_px < kSlid * first->best.rms_px) return first;
  InnerCorners again{{}, corners.shortest};
  for (const Vector3& p : model) again.pixels.push_back(project(camera, first->best.T_CG * p));
  if (!locate(grey, again)) return first;
  const auto second = planar_pose(camera, model, again.pixels, parameters);
  return second && second->best.rms_px < first->best.rms_px ? second : first;
}

}  // namespace mrroc::vsp::chessboard
