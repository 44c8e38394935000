// What the user is told of load cells that are wrong: nothing else shows it, as the platform drives on.
#pragma once
#include <string>

#include "edp/platform/stage_collector.hpp"

namespace mrroc::edp {

/// A line of a driver, once in a run.
class LoadNote {
 public:
  /// @param sensors  after a macrostep
  /// @return the line, in the first macrostep in which the load cells count as wrong; empty in all others
  [[nodiscard]] std::string next(const StageCollector& sensors);

 private:
  bool told_{};
};

}  // namespace mrroc::edp
