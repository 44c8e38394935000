// Makes the measurements of a stage of the estimator from the steps of a macrostep.
#pragma once
#include <cstdint>
#include <optional>

#include "edp/platform/platform.hpp"
#include "edp/platform/wheel_meter.hpp"

namespace mrroc::edp {

/// Takes every reading and every command of a platform. Real-time safe.
class StageCollector {
 public:
  /// Readings of the IMU that are absent in succession, from which it counts as silent.
  static constexpr int kImuSilent = 3;
  /// Stages in succession whose loads are not to be believed, from which the load cells count as wrong.
  static constexpr int kLoadsWrong = 5;

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
  void set_static_load(const PerWheel& load) noexcept {
    static_load_ = load;
    loads_wrong_ = 0;
  }
  /// @return those
  [[nodiscard]] const PerWheel& static_load() const noexcept { return static_load_; }
  /// @return what the load cells have told of the last stage, believed or not [N]; nothing: they were silent
  [[nodiscard]] const std::optional<PerWheel>& told_load() const noexcept { return told_load_; }
  /// @return whether they are not to be believed, for kLoadsWrong stages
  [[nodiscard]] bool loads_wrong() const noexcept { return loads_wrong_ >= kLoadsWrong; }
  /// @return whether the IMU has been absent for kImuSilent readings
  [[nodiscard]] bool imu_silent() const noexcept { return imu_absent_ >= kImuSilent; }
  /// @return turns and speeds of the wheels
  [[nodiscard]] const WheelMeter& wheels() const noexcept { return wheels_; }
  /// @return readings of the last step that are measurements; what is none is marked so
  [[nodiscard]] const PlatformReading& reading() const noexcept { return reading_; }

 private:
  /// @return loads of the stage that ends
  PerWheel weigh() noexcept;

  const PlatformProperties* platform_;
  WheelMeter wheels_;
  PlatformReading reading_{};
  PerWheel static_load_{};
  std::optional<PerWheel> told_load_;
  int loads_wrong_{};  // stages in succession
  PerWheel load_sum_{};
  int loads_{};
  PerWheel torque_sum_{};
  int commands_{};
  bool braked_{};
  int imu_absent_{};
};

}  // namespace mrroc::edp
