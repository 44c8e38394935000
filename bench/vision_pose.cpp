// Measures the accuracy of the poses that receptors find in pictures of the cell.
#include <cmath>
#include <numbers>

#include "bench/vision.hpp"
#include "sim/camera/renderer.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::bench {
namespace {

struct Accuracy {
  std::vector<double> mm;
  std::vector<double> deg;
  int pictures{};

  [[nodiscard]] double misses() const { return pictures - static_cast<double>(mm.size()); }
};

// Every picture is the first one: nothing is known from the one before.
template <class Sensor>
Accuracy measure(ViewedCell::Object object, double nearest, double farthest, int pictures) {
  const CameraModel model = web_camera();
  ViewedCell cell(object, 21);
  camera::Renderer renderer(model, camera::exact_profile());
  Sensor sensor(model);
  Accuracy result;
  result.pictures = pictures;
  for (int k = 0; k < pictures; ++k) {
    const Pose T = cell.pose(model, nearest, farthest);
    const Image picture = renderer.render(cell.scene(), cell.camera(T), k);
    sensor.forget();
    const CameraReading r = sensor.detect(picture.view(), k, k);
    if (!r.seen) continue;
    result.mm.push_back(1e3 * (r.T_CG.p - T.p).norm());
    result.deg.push_back(angle_axis_from_rotation(r.T_CG.R.transpose() * T.R).norm() * 180 /
                         std::numbers::pi);
  }
  return result;
}

}  // namespace

Figures run_pose_figures() {
  constexpr int kNear = 400;
  constexpr int kFar = 300;
  using Object = ViewedCell::Object;
  const Accuracy board_eih = measure<vsp::ChessboardSensor>(Object::board, 0.3, 1, kNear);
  const Accuracy board_sac = measure<vsp::ChessboardSensor>(Object::board, 1.5, 2, kFar);
  const Accuracy tag_eih = measure<vsp::AprilTagSensor>(Object::tag, 0.3, 1, kNear);
  const Accuracy tag_sac = measure<vsp::AprilTagSensor>(Object::tag, 1.5, 2, kFar);
  return {
      {"board_eih_mm95", quantile(board_eih.mm, 0.95), "mm",
       "board 0.3-1 m away, tilt up to 45 deg: error at 95 %"},
      {"board_eih_deg95", quantile(board_eih.deg, 0.95), "deg", "the same, orientation"},
      {"board_eih_miss", board_eih.misses(), "", "boards not found, of 400"},
      {"board_sac_mm95", quantile(board_sac.mm, 0.95), "mm", "board 1.5-2 m away: error at 95 %"},
      {"board_sac_deg95", quantile(board_sac.deg, 0.95), "deg", "the same, orientation"},
      {"board_sac_miss_pct", 100 * board_sac.misses() / kFar, "%", "boards not found"},
      {"tag_eih_mm95", quantile(tag_eih.mm, 0.95), "mm", "tag of 100 mm, 0.3-1 m away: error at 95 %"},
      {"tag_eih_deg95", quantile(tag_eih.deg, 0.95), "deg", "the same, orientation"},
      {"tag_eih_miss", tag_eih.misses(), "", "tags not found or ambiguous, of 400"},
      {"tag_sac_mm95", quantile(tag_sac.mm, 0.95), "mm", "tag 1.5-2 m away: error at 95 %"},
      {"tag_sac_deg95", quantile(tag_sac.deg, 0.95), "deg", "the same, orientation"},
      {"tag_sac_miss_pct", 100 * tag_sac.misses() / kFar, "%", "tags not found or ambiguous"},
  };
}

}  // namespace mrroc::bench
