// Records the servoing of the arm, and joins it with the truth.
#pragma once
#include <memory>
#include <vector>

#include "base/link/process.hpp"
#include "ecp/generators/trajectory.hpp"
#include "mrroc/object_truth_t.hpp"
#include "mrroc/servo_report_t.hpp"
#include "tasks/visual_servo/servo_table.hpp"

namespace mrroc::visual_servo {

/// @param reports  one per control step, in order
/// @param truths   in order; between two of them the object and E move evenly
/// @param T_EGd    E_G T_d @param pacing  of the control steps
/// @param D  what the tool's camera takes for the identity, see tool_camera_error()
/// @return a row per report; without a truth about its step the object is not there
[[nodiscard]] ServoTable join(const std::vector<servo_report_t>& reports,
                              const std::vector<object_truth_t>& truths, const Pose& T_EGd,
                              const ecp::Pacing& pacing, const Pose& D = {});

/// Collects the messages of a run. Used by MP's thread.
class ServoRecord {
 public:
  /// Make this before the process assembles. @param arm  key
  ServoRecord(link::Process& process, const std::string& arm);

  /// Takes what has come; to be called at least every ten macrosteps.
  void collect();
  /// @return one per control step, in order
  [[nodiscard]] const std::vector<servo_report_t>& reports() const { return reports_; }
  /// @return what the simulator has told of the object, in order
  [[nodiscard]] const std::vector<object_truth_t>& truths() const { return truths_; }

 private:
  std::unique_ptr<link::Inbox<servo_report_t>> report_in_;
  std::unique_ptr<link::Inbox<object_truth_t>> truth_in_;
  std::vector<servo_report_t> reports_;
  std::vector<object_truth_t> truths_;
};

}  // namespace mrroc::visual_servo
