// The coordinator's run, with a record of what was true of the object.
#pragma once
#include <span>

#include "mp/coordinated_run.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/body_record.hpp"

namespace mrroc::ball {

/// The agent a_0 in MP.
class BallRun final : public mp::CoordinatorRun {
 public:
  /// @param run  is told of every behaviour that begins; must outlive this object
  BallRun(mp::TaskRun& run, const mp::CoordinatedParameters& links, const Parameters& parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return fault_; }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return links_.traces(); }
  /// @return what was true of the object so far
  [[nodiscard]] const BodyRecord& record() const { return record_; }

 private:
  Parameters k_;
  mp::CoordinatedLinks links_;
  BodyRecord record_;
  Fault fault_;
};

/// @return the fault that a failure becomes, with numbers from the memory in its text
[[nodiscard]] Fault fault_of(const Coordinator::X& x);

}  // namespace mrroc::ball
