// The two clocks that drive the same code, and when the steps of a paced run are due.
#pragma once
#include <chrono>
#include <cstdint>

namespace mrroc {

/// Who drives time.
enum class ClockKind : std::uint8_t {
  step,  ///< lock-step: everybody waits for the messages that it needs; bit-identical from run to run
  wall,  ///< 500 Hz of the monotonic clock: what is not there in time is late
};

/// Says when the steps of a paced run are due. Asks no clock itself: times are given, so that tests need none.
class Pacer {
 public:
  using Time = std::chrono::steady_clock::time_point;  ///< of the monotonic clock

  /// After a delay longer than this the lost time is not caught up.
  static constexpr std::chrono::milliseconds kPatience{1000};

  /// @param step  simulated duration of a step [s]
  /// @param patience  after a delay longer than this the lost time is not caught up
  constexpr explicit Pacer(double step, std::chrono::milliseconds patience = kPatience)
      : step_(step), patience_(patience) {}

  /// The first step begins now.
  constexpr void begin(Time now) { due_ = now; }

  /// A step begins.
  /// @param speed  simulated seconds per second; 0: as fast as possible
  /// @return when it is to end; in the past: at once
  constexpr Time next(double speed, Time now) {
    if (speed <= 0) return due_ = now;
    due_ += std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(step_ / speed));
    if (due_ < now - patience_) due_ = now;
    return due_;
  }

 private:
  double step_;
  std::chrono::milliseconds patience_;
  Time due_{};
};

}  // namespace mrroc
