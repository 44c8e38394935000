// Makes the measurements of a stage of the estimator from the steps of a macrostep.
#pragma once
#include <cstdint>

#include "edp/platform/platform.hpp"
#include "edp/platform/wheel_meter.hpp"

namespace mrroc::edp {

/// Takes every reading and every command of a platform. Real-time safe.
class StageCollector {
 public:
  /// Readings of the IMU that are absent in succession, from which it counts as silent.
  static constexpr int kImuSilent = 3;

  /// @param platform  lives longer than this object  @param dt  duration of a step [s]
  StageCollector(const PlatformProperties& platform, double dt) noexcept
      : platform_(&platform), wheels_(platform.increments_per_turn, dt) {}

  /// A step begins. What is not finite is no measurement.
  void measure(const PlatformReading& reading) noexcept;
  /// The step's command.
  void command(const PlatformDrive& drive) noexcept;
  /// @param step  of the stage  @return the measurements of the stage that ends with the last reading. The next one begins
  [[nodiscard]] StageReading take(std::int64_t step) noexcept;

  /// @param load  of the wheels at rest [N], used where the cells are not to be believed (edp/platform/wheel_load.hpp)
  void set_static_load(const PerWheel& load) noexcept { static_load_ = load; }
  /// @return whether the IMU has been absent for kImuSilent readings
  [[nodiscard]] bool imu_silent() const noexcept { return imu_absent_ >= kImuSilent; }
  /// @return turns and speeds of the wheels
  [[nodiscard]] const WheelMeter& wheels() const noexcept { return wheels_; }
  /// @return readings of the last step that are measurements; what is none is marked so
  [[nodiscard]] const PlatformReading& reading() const noexcept { return reading_; }

 private:
  const PlatformProperties* platform_;
  WheelMeter wheels_;
  PlatformReading reading_{};
  PerWheel static_load_{};
  PerWheel load_sum_{};
  int loads_{};
  PerWheel torque_sum_{};
  int commands_{};
  bool braked_{};
  int imu_absent_{};
};

}  // namespace mrroc::edp
