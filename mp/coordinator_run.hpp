// The execution of a task's coordinator, as MP sees it.
#pragma once
#include <span>

#include "base/fault.hpp"
#include "base/motion.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::mp {

/// Executes the agent a_0 once. It is made before the nodes start, since its links belong to the run.
class CoordinatorRun {
 public:
  CoordinatorRun() = default;
  virtual ~CoordinatorRun() = default;
  CoordinatorRun(const CoordinatorRun&) = delete;
  CoordinatorRun& operator=(const CoordinatorRun&) = delete;

  /// Executes the task's program to its end. Call TaskRun::start() before.
  virtual Outcome execute() = 0;
  /// @return why execute() gave faulted
  [[nodiscard]] virtual const Fault& fault() const = 0;
  /// @return what it wrote down of every arm, in the order of the arms; empty: nothing
  [[nodiscard]] virtual std::span<const ArmTrace> traces() const { return {}; }
};

}  // namespace mrroc::mp
