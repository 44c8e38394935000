// Measures how long a process has been silent; time in which nobody listened does not count.
#pragma once
#include <algorithm>
#include <chrono>

namespace mrroc::link {

/// Hears the signs of life of one process; also a wait that counts only while somebody waits. Of the time
/// between two looks no more counts than a bound: beyond that the listener was not run itself, as when it is
/// suspended or the host sleeps. Asks no clock. Real-time safe.
class HeartbeatMonitor {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time

  /// So 10 s of silence are found by the tenth look at the latest, however far apart looks are.
  static constexpr std::chrono::seconds kMostAtOnce{1};

  /// @param begun         when the process is expected to speak from
  /// @param most_at_once  counts of the time between two looks
  explicit HeartbeatMonitor(Clock::time_point begun, Clock::duration most_at_once = kMostAtOnce)
      : most_at_once_(most_at_once), heard_(begun), looked_(begun) {}

  /// A sign of life.
  void hear(Clock::time_point now) {
    heard_ = looked_ = now;
    counted_ = {};
  }
  /// The listener is run, and has heard nothing since the last call of either.
  /// @return what of the time since then counts
  Clock::duration look(Clock::time_point now) {
    const Clock::duration counts = std::min<Clock::duration>(now - looked_, most_at_once_);
    counted_ += counts;
    looked_ = now;
    return counts;
  }

  /// @return how long nothing was heard although somebody listened, up to the last look
  [[nodiscard]] Clock::duration counted() const { return counted_; }
  /// @return when it was heard last
  [[nodiscard]] Clock::time_point heard() const { return heard_; }

 private:
  Clock::duration most_at_once_;
  Clock::time_point heard_, looked_;
  Clock::duration counted_{};
};

}  // namespace mrroc::link
