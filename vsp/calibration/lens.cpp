#include "vsp/calibration/lens.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/counted.hpp"
#include "base/fault.hpp"
#include "vsp/chessboard/board_search.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kLeastTurn = 0.26;   // between the planes of some two views [rad]
constexpr double kLeastCover = 0.5;   // of the picture's width and height by all views together
constexpr double kWorstRms = 1;       // [pixel]
constexpr double kWorstSigma = 0.01;  // of the focal length, relative

[[noreturn]] void refuse(const std::string& why) { throw FaultError(FaultCode::bad_calibration, why); }

void check_cover(int width, int height, std::span<const BoardView> views) {
  Vector2 low(width, height);
  Vector2 high(0, 0);
  for (const BoardView& v : views)
    for (const Vector2& p : v.corners) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double cover = std::min((high.x() - low.x()) / width, (high.y() - low.y()) / height);
  if (cover < kLeastCover)
    refuse(fmt::format(
        "the board was shown in {:.0f} % of the picture's width or height only; the lens needs {:.0f} %",
        100 * std::max(0.0, cover), 100 * kLeastCover));
}

void check_turns(const std::vector<cv::Mat>& rotations) {
  std::vector<Vector3> normals;
  for (const cv::Mat& r : rotations)
    normals.emplace_back(
        rotation_from_angle_axis({r.at<double>(0), r.at<double>(1), r.at<double>(2)}).col(2));
  double largest = 0;
  for (const Vector3& a : normals)
    for (const Vector3& b : normals) largest = std::max(largest, std::atan2(a.cross(b).norm(), a.dot(b)));
  if (largest < kLeastTurn)
    refuse(fmt::format(
        "the board was tilted alike in all pictures (to within {:.0f} degrees): focal length and distance "
        "cannot be told apart",
        largest * 180 / M_PI));
}

}  // namespace

std::optional<std::vector<Vector2>> find_corners(const ImageView& picture, const Board& board) {
  std::vector<chessboard::InnerCorners> found;
  if (!picture.empty())
    chessboard::find_everywhere(grey(picture), board, ChessboardParameters{}.offset, found);
  if (found.size() != 1) return std::nullopt;
  return std::move(found.front().pixels);
}

LensCalibration calibrate_lens(int width, int height, std::span<const BoardView> views, const Board& board) {
  if (views.size() < kLeastViews)
    refuse(fmt::format("the board was found in {}; at least {} are needed", counted(views.size(), "picture"),
                       kLeastViews));
  check_cover(width, height, views);
  std::vector<cv::Point3f> model;
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) {
      const Vector3 p = board.corner(r, c);
      model.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
    }
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardView& v : views) {
    seen.emplace_back();
    for (const Vector2& p : v.corners)
      seen.back().emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  const std::vector<std::vector<cv::Point3f>> models(views.size(), model);
  cv::Mat K;
  cv::Mat lens;
  cv::Mat sigma;
  cv::Mat sigma_places;
  cv::Mat view_px;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  LensCalibration result;
  try {
    result.rms_px = cv::calibrateCamera(models, seen, {width, height}, K, lens, rotations, translations,
                                        sigma, sigma_places, view_px, cv::CALIB_FIX_K3,
                                        {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-10});
  } catch (const cv::Exception&) {
    refuse("no lens explains the pictures");
  }
  check_turns(rotations);
  CameraModel& m = result.model;
  m.width = width;
  m.height = height;
  m.fx = K.at<double>(0, 0);
  m.fy = K.at<double>(1, 1);
  m.cx = K.at<double>(0, 2);
  m.cy = K.at<double>(1, 2);
  for (int k = 0; k < 5; ++k) m.distortion[static_cast<std::size_t>(k)] = lens.at<double>(k);
  for (int k = 0; k < view_px.rows; ++k) result.view_px.push_back(view_px.at<double>(k));
  result.sigma_f = std::max(sigma.at<double>(0) / m.fx, sigma.at<double>(1) / m.fy);
  if (!is_proper(m) || !(result.rms_px < kWorstRms))
    refuse(fmt::format(
        "the pictures do not fit together: {:.2f} pixels; was the board flat, the camera sharp and always "
        "the same?",
        result.rms_px));
  if (!(result.sigma_f < kWorstSigma))
    refuse(fmt::format("the focal length stays uncertain by {:.1f} %", 100 * result.sigma_f));
  return result;
}

}  // namespace mrroc::vsp
