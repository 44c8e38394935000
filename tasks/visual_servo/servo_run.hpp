// MP of the task: the arm works on its own, with a record of all events.
#pragma once
#include <optional>
#include <span>

#include "mp/solo_run.hpp"
#include "tasks/visual_servo/images.hpp"
#include "tasks/visual_servo/servo_record.hpp"

namespace mrroc::visual_servo {

/// The coordinator, and the record of the run.
class ServoRun final : public mp::CoordinatorRun {
 public:
  /// @param run          must outlive this object
  /// @param gives_start  false: a person or a script does
  /// @param records      false: nothing is written down, as in a check
  ServoRun(mp::TaskRun& run, const Parameters& parameters, bool gives_start, bool records);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return solo_.fault(); }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return solo_.traces(); }
  /// @param D  as join() takes it
  /// @return what happened in every control step; empty: nothing was written down
  [[nodiscard]] ServoTable table(const Pose& D) const;

 private:
  Parameters k_;
  std::optional<ServoRecord> record_;
  mp::SoloRun solo_;
};

}  // namespace mrroc::visual_servo
