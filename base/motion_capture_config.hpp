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

/// @return `motion_capture.period`, `motion_capture.latency`
/// @throws ConfigError
[[nodiscard]] inline MotionCaptureSetup read_motion_capture(const Config& config) {
  MotionCaptureSetup m;
  m.period = config.integer<std::int64_t>("motion_capture.period", m.period, {1, 1000}, "steps");
  m.latency = config.integer<std::int64_t>("motion_capture.latency", m.latency, {0, 500}, "steps");
  return m;
}

}  // namespace mrroc
