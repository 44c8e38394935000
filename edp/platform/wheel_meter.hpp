// Turns and speeds of a platform's wheels, from their encoders.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/platform_hardware.hpp"

namespace mrroc::edp {

/// Encoders of all wheels. The speed is the slope of a parabola through the last readings, at its end: it does not lag behind a
/// constant acceleration, and whole increments disturb it less than a difference would be. Torques change once in a macrostep:
/// through the readings of two of them the parabola was wrong by up to 0.7 rad/s where wheels slip. Real-time safe.
class WheelMeter {
 public:
  /// Readings of which a speed is made: those since the torques changed last, and a few, which make increments finer.
  static constexpr std::size_t kReadings = 13;

  /// @param increments_per_turn  of the encoders  @param dt  duration of a step [s]
  WheelMeter(double increments_per_turn, double dt) noexcept;

  /// Takes a reading. Steps that were missed before it count as evenly turned through.
  void step(const PlatformReading& reading) noexcept;

  /// @return turned since power-up [rad]; right even when a counter of 32 bits has wrapped around
  [[nodiscard]] PerWheel theta() const noexcept;
  /// @return [rad/s]
  [[nodiscard]] PerWheel theta_dot() const noexcept;
  /// @param steps  0..kReadings-1 @return turned in the last steps [increments]; before the first reading the wheels stood
  [[nodiscard]] PerWheel turned(std::size_t steps) const noexcept;
  /// @return turned since the reading before [increments]
  [[nodiscard]] const PerWheel& increments() const noexcept { return increments_; }

 private:
  void add(const PerWheel& count) noexcept;

  double rad_per_increment_;
  double dt_;
  std::array<PerWheel, kReadings> ring_{};  // [increments] since power-up
  std::size_t newest_{};
  PerWheel increments_{};
  std::array<std::int32_t, kWheels> encoder_{};
  std::int64_t step_{-1};
};

}  // namespace mrroc::edp
