// When a motion capture system measures, as the simulation and those who use its readings read it.
#pragma once
#include <cstdint>

#include "base/config.hpp"

namespace mrroc {

/// Times of a motion capture system.
struct MotionCaptureSetup {
  std::int64_t period{50};   ///< steps from one reading to the next; reading n is taken at step n * period
  std::int64_t latency{10};  ///< steps until a reading is visible (rule R6 of docs/architecture.md)
};

/// Readings that are visible later than this are older than anything that estimators remember: they have a window of 200
/// steps, and a message is on its way for up to 40 [steps].
inline constexpr std::int64_t kLongestCaptureLatency = 150;

/// @return `motion_capture.period`, `motion_capture.latency`
/// @throws ConfigError
[[nodiscard]] inline MotionCaptureSetup read_motion_capture(const Config& config) {
  MotionCaptureSetup m;
  m.period = config.integer<std::int64_t>("motion_capture.period", m.period, {1, 1000}, "steps");
  m.latency =
      config.integer<std::int64_t>("motion_capture.latency", m.latency, {0, kLongestCaptureLatency}, "steps");
  return m;
}

}  // namespace mrroc
