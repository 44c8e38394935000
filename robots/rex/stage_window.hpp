// The measurements that an estimator of Rex looks back at: the stages of the last 0.4 s, and the late ones put where they
// belong.
#pragma once
#include <array>

#include "edp/platform/platform.hpp"
#include "robots/rex/stage_model.hpp"
#include "robots/rex/stage_residuals.hpp"
#include "robots/rex/weighing.hpp"

namespace mrroc::rex {

/// Stages of a full window, with the newest one.
inline constexpr int kWindowStages = 21;

/// How a reading has entered the window.
enum class Entry {
  next,      ///< it follows the newest stage; of a full window the oldest stage is gone
  restart,   ///< readings were missing: it is the only stage
  repeated,  ///< it is not newer than the newest stage, or nothing has begun: ignored
};

/// Window of stages, oldest first. Everything is real-time safe. What no platform can have measured is left out, so that
/// all numbers in it are finite.
class StageWindow {
 public:
  /// @param noise  is copied
  explicit StageWindow(const EstimatorNoise& noise) noexcept : noise_(noise) {}

  /// Forgets all stages, weighs the platform, and makes its rest the first stage.
  void begin(const edp::StandingStill& found) noexcept;

  Entry add(const edp::StageReading& reading) noexcept;
  /// Also draws the offset of the IMU's yaw a little towards the heading.
  /// @return the stage next to it; -1: it is not within the window, or no proper measurement, and is ignored
  int add(const MapPose& pose) noexcept;
  /// The stage of its first picture becomes a picture.
  /// @return that stage; -1: its pictures are not two stages of the window, other pictures were taken between them, or it
  ///         is no proper measurement, and it is ignored
  int add(const OdometryReading& odometry) noexcept;

  /// While there is no map, draws the offset of the IMU's yaw towards a heading that exact pictures have led to: the bias of an IMU
  /// is not known, and of the two the pictures drift less.
  /// @param k  stage at which a motion begins that the odometry has told, < size()  @param heading  there, as it is believed [rad]
  void see_heading(int k, double heading) noexcept;

  /// What is believed of all stages has been displaced to a map pose: that pose is used, those before it are of another map, and
  /// the offset of the IMU's yaw goes along. @param turn  of the displacement [rad]
  void displace(double turn) noexcept;

  /// @return stages; 0 before begin()
  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool full() const noexcept { return size_ == kWindowStages; }
  /// @param k  0: the oldest, < size()
  [[nodiscard]] const WindowStage& operator[](int k) const noexcept {
    return stage_[static_cast<std::size_t>(k)];
  }
  /// Only when it has begun.
  [[nodiscard]] const WindowStage& newest() const noexcept { return (*this)[size_ - 1]; }
  /// @return the platform as it was weighed
  [[nodiscard]] const Load& weighed() const noexcept { return weighed_; }
  /// @return mass centre in B [m]
  [[nodiscard]] Eigen::Vector2d centre() const noexcept { return {weighed_.centre.x, weighed_.centre.y}; }
  [[nodiscard]] const EstimatorNoise& noise() const noexcept { return noise_; }
  /// @return heading on the map minus yaw of the IMU, as it is believed now [rad]
  [[nodiscard]] double yaw_offset() const noexcept { return yaw_offset_; }

  /// @return residuals of stage k for a state of it
  [[nodiscard]] StageResiduals residuals_at(int k, const StageVector& z) const noexcept {
    return residuals(z, (*this)[k], yaw_offset_, centre(), noise_);
  }
  /// @return transition from stage k to the next one, for a state of k; k < size() - 1
  [[nodiscard]] StageTransition transition_from(int k, const StageVector& z) const noexcept {
    return transition(z, (*this)[k], (*this)[k + 1], weighed_, noise_);
  }

 private:
  [[nodiscard]] WindowStage stage_of(const edp::StageReading& reading) const noexcept;
  /// @return index of the stage of a step; -1: there is none
  [[nodiscard]] int find(std::int64_t step) const noexcept;
  [[nodiscard]] bool can_be_picture(int first, int second) const noexcept;
  void anchor_yaw(const WindowStage& stage, double heading, double gain) noexcept;

  EstimatorNoise noise_;
  Load weighed_ = weigh({});
  double yaw_offset_{};
  double gyro_bias_{};
  std::int64_t map_step_{};       // of the newest pose
  double odometry_heading_{1e9};  // standard deviation of the newest motion's turn [rad]
  std::array<WindowStage, kWindowStages> stage_{};
  int size_{};
};

}  // namespace mrroc::rex
