#include "vsp/chessboard/chessboard_sensor.hpp"

#include <opencv2/core.hpp>

#include "base/fault.hpp"
#include "vsp/chessboard/board_pose.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
using chessboard::InnerCorners;

namespace {

constexpr double kNoBoard = 4;  // in largest reprojection errors

}  // namespace

ChessboardSensor::ChessboardSensor(const CameraModel& camera, const Board& board,
                                   const ChessboardParameters& parameters)
    : camera_(camera), board_(board), k_(parameters) {
  if (!is_proper(camera)) throw FaultError(FaultCode::bad_configuration, "the camera's model is not proper");
}

// One board whose pose explains the picture is the object.
void ChessboardSensor::take(const cv::Mat& grey, const std::vector<InnerCorners>& boards,
                            CameraReading& reading) {
  last_.reset();
  std::vector<PlanarPoses> poses;
  for (const InnerCorners& board : boards) {
    const auto found = chessboard::board_pose(grey, camera_, board_, board, k_.pose);
    // A lattice that no flat board explains at all is an accident; one that is explained badly may be a second board.
    if (found && found->best.rms_px < kNoBoard * k_.rms_px) poses.push_back(*found);
  }
  if (poses.empty()) return;
  const auto& [best, other, ambiguous] = poses.front();
  reading.ambiguous = poses.size() > 1 || ambiguous;
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
  if (last_) {
    const chessboard::Search search = chessboard::search_around(camera_, board_, *last_, k_.offset);
    const chessboard::SearchResult result = find_boards(brightness, search, board_);
    boards = result.boards;
    done = result.is_one();
  }
  if (!done) find_everywhere(brightness, board_, k_.offset, boards);
  take(brightness, boards, reading);
  return reading;
}

}  // namespace mrroc::vsp
