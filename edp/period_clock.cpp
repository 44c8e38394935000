#include "edp/period_clock.hpp"

#include <fmt/core.h>

namespace mrroc::edp {

std::string to_string(const LatePeriods& late) {
  return fmt::format(
      "{} of {} periods late, the worst by {:.1f} ms; {} skipped, {} commands after the deadline", late.late,
      late.periods, 1e3 * late.worst, late.skipped, late.overruns);
}

}  // namespace mrroc::edp
