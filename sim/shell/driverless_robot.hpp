// A robot whose driver is dead: its drives brake by themselves, and the simulator detects when it rests.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/axes.hpp"
#include "edp/standstill_detector.hpp"

namespace mrroc::sim {

/// Finds out by the encoders when the robot has come to rest, as its driver would have done. Real-time safe.
class DriverlessRobot {
 public:
  /// One step without a driver.
  /// @param step     number of the step; the first one is that in which the driver's commands have ended
  /// @param encoders  what the robot's encoders count in it [increments], at most kMaxAxes
  /// @param braked   whether the drives brake
  void step(std::int64_t step, std::span<const std::int32_t> encoders, bool braked) {
    if (!orphaned_) {
      orphaned_ = step;
      std::ranges::copy(encoders, encoder_.begin());
    }
    AxisVector increment = AxisVector::Zero(kMaxAxes);
    for (std::size_t k = 0; k < encoders.size(); ++k)
      increment[static_cast<Eigen::Index>(k)] = static_cast<double>(encoders[k] - encoder_[k]);
    std::ranges::copy(encoders, encoder_.begin());
    standstill_.step(step, increment, *orphaned_, braked);
  }

  /// @return whether the robot rests; false as long as it has a driver
  [[nodiscard]] bool at_rest() const { return orphaned_ && standstill_.at_rest(); }
  /// @return steps from the end of the driver's commands to rest; only meaningful when at_rest()
  [[nodiscard]] int stop_steps() const { return standstill_.stop_steps(orphaned_.value_or(0)); }

 private:
  std::optional<std::int64_t> orphaned_;  // step
  std::array<std::int32_t, kMaxAxes> encoder_{};
  edp::StandstillDetector standstill_;
};

}  // namespace mrroc::sim
