#include "vsp/odometry/film.hpp"

#include <fmt/core.h>

#include <opencv2/imgproc.hpp>

#include "vsp/opencv.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kColumns = 4;
constexpr int kWidth = 320;  // of a picture of the film [pixel]
constexpr std::size_t kMost = 12;

}  // namespace

void annotate(Image& picture, const OdometrySupport& support, const std::vector<SeenPoint>& seen) {
  if (picture.channels != 3) return;
  const cv::Scalar agreeing(60, 200, 60), other(0, 210, 240);
  cv::Mat on = drawn_on(picture);
  const int radius = std::max(1, on.cols / 160);
  const auto rounded = [](const Vector2& p) { return cv::Point(cvRound(p.x()), cvRound(p.y())); };
  for (const SeenPoint& point : seen) {
    const cv::Scalar& colour = point.inlier ? agreeing : other;
    cv::line(on, rounded(point.before), rounded(point.now), colour, 1, cv::LINE_AA);
    cv::circle(on, rounded(point.now), radius, colour, 1, cv::LINE_AA);
  }
  const bool measured = support.finding == OdometryFinding::motion;
  if (!measured) draw_frame(picture);
  write_text(picture, measured ? fmt::format("pair {}: {} of {} points agree", support.frame, support.inliers,
                                             support.matches)
                               : fmt::format("pair {}: {}", support.frame, to_words(support.finding)));
}

OdometryFilm::OdometryFilm(std::string key, const Config& config)
    : key_(std::move(key)), directory_(config.text("film.directory", "")), strip_(kColumns, kWidth, kMost) {}

void OdometryFilm::see(const ImageView& left, const StereoOdometry& odometry) {
  const OdometrySupport& support = odometry.support();
  const bool measured = support.finding == OdometryFinding::motion;
  if (directory_.empty() || left.empty() || !strip_.wants(support.frame, measured)) return;
  Image drawn = in_colour(left);
  annotate(drawn, support, odometry.seen());
  strip_.add(support.frame, measured, drawn.view());
}

void OdometryFilm::write() const {
  if (strip_.empty()) return;
  write_picture(directory_ / fmt::format("{}_odometry.png", key_), strip_.picture().view());
}

}  // namespace mrroc::vsp
