// How long a process has been silent, as far as somebody could have heard it.
#pragma once
#include <algorithm>
#include <chrono>

namespace mrroc::mp {

/// One process, as its supervisor hears it. Of the time between two looks at it no more counts than kMostAtOnce: beyond
/// that the supervisor was not run itself, as on a host that sleeps. Asks no clock. Real-time safe.
class Silence {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time

  /// So 10 s of silence are found by the tenth look at the latest, however far apart looks are.
  static constexpr std::chrono::seconds kMostAtOnce{1};

  /// @param begun  when the process is expected to speak from
  explicit Silence(Clock::time_point begun) : heard_(begun), looked_(begun) {}

  /// A sign of life.
  void hear(Clock::time_point now) {
    heard_ = looked_ = now;
    counted_ = {};
  }
  /// The supervisor is run, and has heard nothing since the last call of either.
  void look(Clock::time_point now) {
    counted_ += std::min<Clock::duration>(now - looked_, kMostAtOnce);
    looked_ = now;
  }

  /// @return how long nothing was heard although somebody listened, up to the last look
  [[nodiscard]] Clock::duration counted() const { return counted_; }
  /// @return when it was heard last
  [[nodiscard]] Clock::time_point heard() const { return heard_; }

 private:
  Clock::time_point heard_, looked_;
  Clock::duration counted_{};
};

}  // namespace mrroc::mp
