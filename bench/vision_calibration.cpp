// Calibration from 20 pictures of the rendered board, against the truth.
#include <numbers>

#include "base/fault.hpp"
#include "bench/vision.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/camera/textures.hpp"
#include "vsp/calibration/hand_eye.hpp"

namespace mrroc::bench {
namespace {

constexpr int kPictures = 20;

// The board near enough to fill a part of the picture, tilted to all sides.
std::vector<Pose> views(std::mt19937& random) {
  const auto uniform = [&random](double a, double b) {
    return std::uniform_real_distribution<>(a, b)(random);
  };
  std::vector<Pose> poses;
  for (int k = 0; k < kPictures; ++k) {
    const double azimuth = uniform(0, 2 * std::numbers::pi);
    Pose T;
    T.R = rotation_from_angle_axis(uniform(0.2, 0.6) * Vector3(std::cos(azimuth), std::sin(azimuth), 0)) *
          rotation_from_angle_axis({std::numbers::pi, 0, 0}) *
          rotation_from_angle_axis({0, 0, uniform(-0.5, 0.5)});
    T.p = {uniform(-0.1, 0.1), uniform(-0.07, 0.07), uniform(0.4, 0.7)};
    poses.push_back(T);
  }
  return poses;
}

std::vector<vsp::BoardView> pictures(const std::vector<Pose>& T_CG) {
  camera::Renderer renderer(web_camera(), camera::exact_profile());
  camera::Scene scene;
  camera::add_board(scene, {}, {});
  std::vector<vsp::BoardView> result;
  for (std::size_t k = 0; k < T_CG.size(); ++k) {
    const Image picture = renderer.render(scene, T_CG[k].inverse(), static_cast<std::int64_t>(k));
    auto corners = vsp::find_corners(picture.view());
    if (!corners)
      throw FaultError(FaultCode::internal_error, "the board was not found in a picture for calibration");
    result.push_back({std::to_string(k), std::move(*corners)});
  }
  return result;
}

// Error of the camera's place with the lens as calibrated [mm].
double place_error(vsp::Arrangement arrangement, const CameraModel& lens, const std::vector<Pose>& T_CG,
                   const std::vector<vsp::BoardView>& seen) {
  const Pose X = pose_from_angle_axis((AngleAxisPose() << 0.05, 0.01, 0.04, 0.1, -0.2, 1.5).finished());
  const Pose Y = pose_from_angle_axis((AngleAxisPose() << 0.9, 0.1, 0.0, 0, 0, 0.3).finished());
  std::vector<vsp::PosedView> posed;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Pose A = X * T_CG[k] * Y.inverse();
    posed.push_back({seen[k], arrangement == vsp::Arrangement::eye_in_hand ? A.inverse() : A});
  }
  return 1e3 * (vsp::calibrate_place(lens, arrangement, posed).camera.p - X.p).norm();
}

}  // namespace

Figures run_calibration_figures() {
  std::mt19937 random(5);
  const std::vector<Pose> T_CG = views(random);
  const auto seen = pictures(T_CG);
  const vsp::LensCalibration lens = vsp::calibrate_lens(web_camera().width, web_camera().height, seen);
  return {
      {"calib_reproj_px", lens.rms_px, "pixel", "reprojection error of a lens calibrated from 20 pictures"},
      {"handeye_mm", place_error(vsp::Arrangement::eye_in_hand, lens.model, T_CG, seen), "mm",
       "error of the hand camera's place from the same pictures, with that lens"},
      {"sac_place_mm", place_error(vsp::Arrangement::board_in_hand, lens.model, T_CG, seen), "mm",
       "the same for a camera that stands beside the robot, the board in the hand"}};
}

}  // namespace mrroc::bench
