// The receptors' and the effector's part of x_c: joins each reading of a picture with the effector's pose at
// its time.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/link/clocked_inbox.hpp"
#include "base/link/process.hpp"
#include "ecp/solo.hpp"
#include "mrroc/camera_reading_t.hpp"
#include "mrroc/servo_report_t.hpp"
#include "mrroc/step_samples_t.hpp"
#include "tasks/visual_servo/images.hpp"

namespace mrroc::visual_servo {

/// Rule R7: the newest picture whose reading is visible at a step, never by arrival.
/// @return its number, -1 when there is none yet
[[nodiscard]] constexpr std::int64_t newest_frame(const CameraParameters& k, std::int64_t step) {
  return link::SensorClock{k.period, k.latency}.newest(step);
}

/// 0_E T_c of the last steps: what e_1 tells in every step.
class EffectorPath {
 public:
  /// Steps that are kept: the age of any reading that is believed.
  static constexpr std::int64_t kKept = kPosesKept;

  /// @param last  step of the last pose @param poses  of steps in succession: x y z [m], angle-axis [rad];
  /// without any the path stays as it is
  void add(std::int64_t last, std::span<const step_sample_t> poses);
  /// @return the pose of that step, or of the nearest one that is kept; identity when there is none
  [[nodiscard]] Pose at(std::int64_t step) const;

 private:
  std::array<AngleAxisPose, kKept> pose_{};
  std::int64_t first_{};  // steps that are there: first_ <= step < end_
  std::int64_t end_{};
};

/// Messages with samples that are kept: of three of the longest macrosteps.
inline constexpr std::int64_t kSampleMessages = 3 * 32;

/// Names of what the agent reads.
struct CameraLinkNames {
  std::string robot;                          ///< channel ROBOT.samples
  std::array<std::string, kCameras> reading;  ///< channels CAMERA.OBJECT, e.g. "sac.board"
};

/// Receives x_cV and tells what c_1 decides. In lock-step the reading that must be visible is taken; with the wall clock
/// the newest one, however old it is.
class CameraLinks {
 public:
  /// Make this before the process assembles.
  CameraLinks(link::Process& process, const CameraLinkNames& names, const Parameters& parameters);

  /// @return what the agent has to wait for; must not outlive this
  [[nodiscard]] link::OtherLinks others();

  /// Fills in x_cV of the control step whose x_ce is there.
  /// @throws FaultError  malformed_message: a number is not finite
  void read(Arm::X& x);

  /// Reports what was decided in a control step, for the record.
  /// @param stamp  of the command
  void report(const Motion<Arm>& motion, const Arm::X& x, const Arm::Y& y, std::int64_t stamp);

 private:
  [[nodiscard]] bool here(std::int64_t i, std::int64_t step);
  void take_samples();
  void take(CameraImage& image, const camera_reading_t& m) const;

  link::Process& process_;
  Parameters k_;
  std::unique_ptr<link::Inbox<step_samples_t, kSampleMessages>> samples_in_;
  std::int64_t taken_{};    // number of the last message with samples that path_ has
  std::int64_t sampled_{};  // newest macrostep of which path_ has all samples
  std::array<std::unique_ptr<link::Inbox<camera_reading_t>>, kCameras> reading_in_;
  std::unique_ptr<link::Outbox<servo_report_t>> report_out_;
  EffectorPath path_;
};

/// Port of the agent: that of an arm which works on its own, and the cameras.
class ServoPort {
 public:
  /// @param arm      reads with the cameras from now on, also after the end of the port  @param cameras  must outlive the arm
  ServoPort(ecp::SoloPort<Arm>& arm, CameraLinks& cameras);

  /// The operations of a Port: those of `arm`, which fills in V and waiting, too; dispatch() also tells the record.
  void dispatch(const Motion<Arm>& motion, const Arm::Y& y);
  Outcome wait() { return arm_.wait(); }
  void read(Arm::X& x);

 private:
  ecp::SoloPort<Arm>& arm_;
  CameraLinks& cameras_;
  Arm::X seen_;
};

}  // namespace mrroc::visual_servo
