#include "vsp/cube_face/cube_face_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "base/fault.hpp"
#include "vsp/cube_face/face_search.hpp"
#include "vsp/cube_face/sticker_colour.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kMostSlanted = 0.5;  // cosine of the angle at which a face is seen

bool can_be_seen(const CameraModel& camera, const Pose& T_CG, double edge) {
  if (!is_proper(T_CG) || T_CG.p.z() < edge) return false;
  if (-T_CG.R.col(2).dot(T_CG.p.normalized()) < kMostSlanted) return false;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Vector2 p = project(camera, T_CG * Vector3(x * edge, y * edge, 0));
      if (!(p.x() > 0 && p.y() > 0 && p.x() < camera.width - 1 && p.y() < camera.height - 1)) return false;
    }
  return true;
}

/// The brightest channel of every pixel, a little smoothed: noise makes no edges then.
cv::Mat brightest(const cv::Mat& colours) {
  constexpr double kBlur = 0.7;  // [pixel]
  std::array<cv::Mat, 3> channels;
  cv::split(colours, channels.data());
  cv::Mat bright = cv::max(channels[0], cv::max(channels[1], channels[2]));
  cv::GaussianBlur(bright, bright, {0, 0}, kBlur);
  return bright;
}

}  // namespace

CubeFaceSensor::CubeFaceSensor(const CameraModel& camera, std::vector<Pose> places,
                               const CubeFaceParameters& parameters, const CubeFaceShape& shape)
    : camera_(camera), places_(std::move(places)), k_(parameters), shape_(shape) {
  const auto refuse = [](const char* what) { throw FaultError(FaultCode::bad_configuration, what); };
  if (!mrroc::is_proper(camera)) refuse("the camera's model is not proper");
  if (places_.empty()) refuse("there is no place where a face of the cube is shown");
  for (const Pose& place : places_)
    if (!can_be_seen(camera_, place, shape_.edge))
      refuse(
          "a face of the cube at one of its places is not in the picture, or seen at more than 60 degrees");
}

CubeFaceReading CubeFaceSensor::detect(const ImageView& picture, std::int64_t frame, std::int64_t step,
                                       int place) const {
  CubeFaceReading reading;
  reading.frame = frame;
  reading.step = step;
  if (!fits(picture, camera_) || picture.channels != 3) return reading;
  const cv::Mat colours = matrix(picture);
  const cv::Mat bright = brightest(colours);
  std::optional<FoundFace> best;
  const auto only = static_cast<std::size_t>(place);
  const bool all = place < 0 || only >= places_.size();
  for (std::size_t n = 0; n < places_.size(); ++n) {
    if (!all && n != only) continue;
    const auto face = find_face(bright, camera_, places_[n], shape_, k_);
    const auto whole = [](const FoundFace& f) { return std::ranges::count(f.whole, true); };
    if (!face || (best && whole(*best) >= whole(*face))) continue;
    best = face;
    reading.place = static_cast<int>(n);
  }
  if (!best) return reading;
  reading.seen = true;
  reading.T_CG = best->T_CG;
  reading.covariance = best->covariance;
  reading.reprojection_px = best->rms_px;
  for (std::size_t s = 0; s < kStickers; ++s) {
    reading.stickers[s] = measure_sticker(colours, camera_, best->T_CG, shape_, static_cast<int>(s), k_);
    if (!best->whole[s] && reading.stickers[s].flaw == StickerFlaw::none)
      reading.stickers[s].flaw = StickerFlaw::hidden;
  }
  name_colours(reading.stickers);
  reading.valid = std::ranges::all_of(reading.stickers, [&](const StickerReading& s) {
    return s.flaw == StickerFlaw::none && s.confidence >= k_.confidence &&
           s.deviation <= k_.veil * *std::ranges::max_element(s.rgb);
  });
  return reading;
}

}  // namespace mrroc::vsp
