#include "vsp/chessboard/chessboard_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/fault.hpp"
#include "vsp/chessboard/board_search.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
using chessboard::InnerCorners;
using chessboard::Search;

namespace {

constexpr double kGoodSquare = 16;  // edge at which outlines of squares are easily told apart [pixel]
constexpr int kLargestScale = 3;
constexpr double kRegionMargin = 0.35;  // around the last place, in sizes of the board

constexpr double kSlid = 3;     // of a corner's distance to the root mean square of all: noise reaches 2.3
constexpr double kNoBoard = 4;  // in largest reprojection errors

}  // namespace

ChessboardSensor::ChessboardSensor(const CameraModel& camera, const Board& board,
                                   const ChessboardParameters& parameters)
    : camera_(camera), board_(board), k_(parameters) {
  if (!is_proper(camera)) throw FaultError(FaultCode::bad_configuration, "the camera's model is not proper");
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) model_.push_back(board.corner(r, c));
}

std::optional<chessboard::Search> ChessboardSensor::around(const Pose& T_CG) const {
  Vector2 low(camera_.width, camera_.height);
  Vector2 high(0, 0);
  double square = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < model_.size(); ++k) {
    const Vector2 p = project(camera_, T_CG * model_[k]);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    if (k % static_cast<std::size_t>(board_.columns) != 0)
      square = std::min(square, (p - project(camera_, T_CG * model_[k - 1])).norm());
  }
  const double reach = std::max(30.0, kRegionMargin * (high - low).maxCoeff());
  const auto place = [](double x, int limit) {
    return std::clamp(static_cast<int>(std::lround(x)), 0, limit);
  };
  Search s;
  s.x = place(low.x() - reach, camera_.width);
  s.y = place(low.y() - reach, camera_.height);
  s.width = place(high.x() + reach, camera_.width) - s.x;
  s.height = place(high.y() + reach, camera_.height) - s.y;
  if (s.width < 16 || s.height < 16) return std::nullopt;
  s.scale = std::clamp(static_cast<int>(std::ceil(kGoodSquare / std::max(1.0, square))), 1, kLargestScale);
  while (s.scale > 1 && s.width * s.scale * s.height * s.scale > camera_.width * camera_.height) --s.scale;
  s.block = 2 * std::clamp(static_cast<int>(1.2 * square * s.scale), 12, 50) + 1;
  s.offset = k_.offset;
  return s;
}

std::optional<PlanarPoses> ChessboardSensor::pose(const cv::Mat& grey, const InnerCorners& board) const {
  auto first = planar_pose(camera_, model_, board.pixels, k_.pose);
  if (!first || first->best.worst_px < kSlid * first->best.rms_px) return first;
  // A corner has slid along an edge: all are located again, from where the pose has them.
  InnerCorners again = board;
  for (std::size_t k = 0; k < model_.size(); ++k)
    again.pixels[k] = project(camera_, first->best.T_CG * model_[k]);
  if (!chessboard::locate(grey, again)) return first;
  const auto second = planar_pose(camera_, model_, again.pixels, k_.pose);
  return second && second->best.rms_px < first->best.rms_px ? second : first;
}

// One board whose pose explains the picture is the object.
void ChessboardSensor::take(const cv::Mat& grey, const std::vector<InnerCorners>& boards,
                            CameraReading& reading) {
  last_.reset();
  std::vector<PlanarPoses> poses;
  for (const InnerCorners& board : boards) {
    const auto found = pose(grey, board);
    // A lattice that no flat board explains at all is an accident; one that is explained badly may be a second board.
    if (found && found->best.rms_px < kNoBoard * k_.rms_px) poses.push_back(*found);
  }
  if (poses.empty()) return;
  const PlanarPose& best = poses.front().best;
  reading.ambiguous = poses.size() > 1 || poses.front().ambiguous;
  reading.reprojection_px = best.rms_px;
  if (poses.size() == 1) last_ = best.T_CG;
  if (reading.ambiguous || best.rms_px > k_.rms_px || best.worst_px > k_.worst_px) return;
  reading.seen = true;
  reading.T_CG = best.T_CG;
  reading.covariance = best.covariance;
}

CameraReading ChessboardSensor::detect(const ImageView& picture, std::int64_t frame, std::int64_t step) {
  CameraReading reading;
  reading.frame = frame;
  reading.step = step;
  if (!fits(picture, camera_)) return reading;
  const cv::Mat brightness = grey(picture);
  std::vector<InnerCorners> boards;
  bool done = false;
  if (last_)
    if (const auto search = around(*last_)) {
      const chessboard::SearchResult result = find_boards(brightness, *search, board_);
      boards = result.boards;
      done = result.is_one();
    }
  if (!done) find_everywhere(brightness, board_, k_.offset, boards);
  take(brightness, boards, reading);
  return reading;
}

}  // namespace mrroc::vsp
