// The two clocks that drive the same code, and the times at which the steps of a paced run are due.
#pragma once
#include <chrono>
#include <cstdint>

namespace mrroc {

/// The source of time.
enum class ClockKind : std::uint8_t {
  step,  ///< lock-step: everybody waits for the messages that it needs; bit-identical from run to run
  wall,  ///< 500 Hz of the monotonic clock: what is not there in time is late
};

/// Says when the steps of a paced run are due. Asks no clock itself: times are given, so that tests need none.
class Pacer {
 public:
  using Time = std::chrono::steady_clock::time_point;  ///< of the monotonic clock

  /// After a delay longer than this the lost time is not caught up.
  static constexpr std::chrono::milliseconds kMaxDelay{1000};

  /// @param step  simulated duration of a step [s]
  /// @param max_delay  after a delay longer than this the lost time is not caught up
  constexpr explicit Pacer(double step, std::chrono::milliseconds max_delay = kMaxDelay)
      : step_(step), max_delay_(max_delay) {}

  /// The first step begins now.
  constexpr void begin(Time now) { due_ = now; }

  /// A step begins.
  /// @param speed  simulated seconds per second; 0: as fast as possible
  /// @return when it is to end; in the past: at once
  constexpr Time next(double speed, Time now) {
    if (speed <= 0) return due_ = now;
    due_ += std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(step_ / speed));
    if (due_ < now - max_delay_) due_ = now;
    return due_;
  }

 private:
  double step_;
  std::chrono::milliseconds max_delay_;
  Time due_{};
};

/// Finds out that a run by the wall clock cannot keep to it. Asks no clock itself.
class PaceWatch {
 public:
  using Time = Pacer::Time;  ///< of the monotonic clock

  /// Time over which the speed is judged.
  static constexpr std::chrono::seconds kWindow{4};
  /// Simulated seconds per second below which a run by the wall clock is none any more.
  static constexpr double kSlowest = 0.6;
  /// So long without a step is no slowness: somebody has stopped the process, and its peers say so.
  static constexpr std::chrono::milliseconds kAbsence{500};

  /// @param step  simulated duration of a step [s]
  constexpr explicit PaceWatch(double step) : step_(step) {}

  /// A step has ended. The first one begins the first window.
  constexpr void step(Time now) {
    if (!begun_ || now - last_ > kAbsence) {
      begun_ = true;
      since_ = last_ = now;
      steps_ = 0;
      return;
    }
    last_ = now;
    ++steps_;
    if (now - since_ < kWindow) return;
    speed_ = static_cast<double>(steps_) * step_ / std::chrono::duration<double>(now - since_).count();
    since_ = now;
    steps_ = 0;
  }

  /// @return simulated seconds per second in the last whole window; 1 before its end
  [[nodiscard]] constexpr double speed() const { return speed_; }
  /// @return whether that is below kSlowest
  [[nodiscard]] constexpr bool too_slow() const { return speed_ < kSlowest; }

 private:
  double step_;
  bool begun_{};
  Time since_{}, last_{};
  long steps_{};
  double speed_{1};
};

}  // namespace mrroc
