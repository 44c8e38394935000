// The parts of the group `vision`.
#pragma once
#include <random>

#include "base/camera.hpp"
#include "bench/figures.hpp"
#include "sim/camera/scene.hpp"
#include "sim/world.hpp"

namespace mrroc::bench {

/// The simulated cell with its arms, and poses from which its object can be seen.
class ViewedCell {
 public:
  /// What the cameras look for: the chessboard or the AprilTag.
  enum class Object { board, tag };

  /// @param seed  of the poses
  ViewedCell(Object object, unsigned seed);

  /// @return T_CG with the whole plate in the picture of the camera, no part of the arms before it, and its face tilted
  ///         by at most 45 degrees against the optical axis; every second picture shows a part of an arm
  Pose pose(const CameraModel& camera, double nearest, double farthest);
  /// @return the cell with its arms and the object; always the same
  [[nodiscard]] const camera::Scene& scene() const { return scene_; }
  /// @return camera in the world when the object is there in the camera
  [[nodiscard]] Pose camera(const Pose& T_CG) const { return T_UG_ * T_CG.inverse(); }

 private:
  [[nodiscard]] bool visible(const CameraModel& camera, const Pose& T_CG) const;
  [[nodiscard]] bool shows_arm(const CameraModel& camera, const Pose& T_CG) const;
  [[nodiscard]] bool belongs_to_an_arm(const camera::Body& body) const;
  [[nodiscard]] bool hidden(const Vector3& eye, const Vector3& point) const;

  Object object_;
  camera::Scene scene_;
  std::size_t arms_end_{};
  Pose T_UG_;
  std::mt19937 random_;
  int poses_{};
};

/// A web camera: 640x480, with its lens.
CameraModel web_camera();
/// @return processor time of the calling thread [ms]
double thread_ms();
/// @return value below which a share of the values lie
double quantile(std::vector<double> values, double share);

/// board_eih_*, board_sac_*, tag_eih_*, tag_sac_*: how exact poses from pictures of the cell are.
Figures run_pose_figures();
/// false_poses, detect_ms_max, detect_vs_opencv*: adverse pictures, and the work that pictures take.
Figures run_detection_figures();
/// cube_misread, cube_flagged*, cube_completed, cube_face_*: colours of the cube in four kinds of light.
Figures run_cube_face_figures();
/// calib_reproj_px, handeye_mm, sac_place_mm.
Figures run_calibration_figures();

}  // namespace mrroc::bench
