// MP of the task: lets the arms take their turns, asks the cameras for pictures, and records what the receptors have seen.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "base/camera_config.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "mp/solo_run.hpp"
#include "mrroc/camera_reading_t.hpp"

namespace mrroc::calibrate_cell {

/// What a receptor has told of a camera's pictures.
struct CameraRecord {
  CameraSetup camera;                      ///< as everybody believes it
  std::vector<camera_reading_t> readings;  ///< one per frame, also of those of which there is no picture
};

/// The coordinator, and the record of the pictures.
class CellRun final : public mp::CoordinatorRun {
 public:
  /// @param run         must outlive this object
  /// @param cameras     whose receptors it hears
  /// @param parameters  of the arms; what is asked and heard is added here
  CellRun(mp::TaskRun& run, const std::vector<CameraSetup>& cameras, mp::SoloParameters parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return solo_.fault(); }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return solo_.traces(); }
  /// @return what was seen, in the order of the cameras
  [[nodiscard]] const std::vector<CameraRecord>& records() const { return records_; }

 private:
  /// @return the parameters with what is asked and heard
  mp::SoloParameters with_cameras(mp::SoloParameters parameters);
  void collect();
  /// @return whether the readings that are visible in macrostep i have come
  [[nodiscard]] bool here(std::int64_t i) const;

  int n_s_;
  std::vector<CameraRecord> records_;
  std::vector<std::unique_ptr<link::Inbox<camera_reading_t>>> reading_in_;
  mp::SoloRun solo_;
};

}  // namespace mrroc::calibrate_cell
