// The clock of a robot with its own timing: the begin of each of the driver's periods, and how late it was.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "base/clock.hpp"

namespace mrroc::edp {

/// Statistics of how well a driver keeps to its periods.
struct LatePeriods {
  std::int64_t periods{};   ///< that have begun
  std::int64_t late{};      ///< of them, begun later than PeriodClock::kTolerance
  std::int64_t skipped{};   ///< not begun at all, because the one before took too long
  std::int64_t overruns{};  ///< commands that came after the deadline, the end of their period
  double worst{};           ///< largest lateness of a beginning [s]
};

/// Periods of the monotonic clock, without drift: period n begins at the first one's beginning plus n periods. Times are
/// given, so that tests need no clock; only await() asks it.
///
/// A period that begins late is counted. One that begins later than a whole period takes the number of the period in which
/// it begins: a driver that was not run for a while goes on at the right time, and its macrosteps with it. When less than
/// PaceWatch::kSlowest of the periods of a few seconds have begun, the host is too slow.
class PeriodClock {
 public:
  using Time = std::chrono::steady_clock::time_point;  ///< of the monotonic clock

  /// A beginning that is later is late.
  static constexpr std::chrono::microseconds kTolerance{500};

  /// @param dt  duration of a period [s], positive
  explicit PeriodClock(double dt)
      : period_(std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(dt))), pace_(dt) {}

  /// @return when a period begins; the first one: now
  [[nodiscard]] Time due(std::int64_t step, Time now) const {
    return begun_ ? first_ + period_ * (step - first_step_) : now;
  }
  /// A period has begun.
  /// @param step  the next one @return the one that it is
  std::int64_t begin(std::int64_t step, Time now) {
    if (!begun_) {
      begun_ = true;
      first_ = now;
      first_step_ = step;
    }
    const Time::duration lateness = now - due(step, now);
    const std::int64_t missed = std::max<std::int64_t>(0, lateness / period_);
    ++late_.periods;
    late_.skipped += missed;
    late_.late += lateness > kTolerance;
    late_.worst = std::max(late_.worst, std::chrono::duration<double>(lateness).count());
    step_ = step + missed;
    pace_.step(now);
    return step_;
  }
  /// The command of the period is given.
  void end(Time now) { late_.overruns += now > due(step_ + 1, now); }

  /// Waits for the beginning of a period. @return the one that has begun, `step` or a later one
  std::int64_t await(std::int64_t step) {
    std::this_thread::sleep_until(due(step, std::chrono::steady_clock::now()));
    return begin(step, std::chrono::steady_clock::now());
  }

  /// @return what has been late so far
  [[nodiscard]] const LatePeriods& late() const { return late_; }
  /// @return whether this host cannot keep to the periods
  [[nodiscard]] bool too_slow() const { return pace_.too_slow(); }
  /// @return periods that have begun per period of time, of the last whole window
  [[nodiscard]] double pace() const { return pace_.speed(); }

 private:
  Time::duration period_;
  bool begun_{};
  Time first_;
  std::int64_t first_step_{};
  std::int64_t step_{};
  LatePeriods late_;
  PaceWatch pace_;
};

/// @return in words, for the log: "4 of 5000 periods late, the worst by 1.2 ms; 1 skipped, 0 commands after the deadline"
[[nodiscard]] std::string to_string(const LatePeriods& late);

}  // namespace mrroc::edp
