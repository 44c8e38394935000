// Motion capture: cameras of a room that measure where a platform is, now and then, and tell it later.
#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "base/platform_transmission.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// A reading that becomes visible.
struct CapturedPose {
  std::int64_t number{};  ///< 0, 1, 2, ... of the platform's readings
  MotionCapture reading;  ///< as it is told
};

/// The readings of one platform. The same seed gives the same noise, whatever is lost or wrong.
class MotionCaptureSystem {
 public:
  /// @param dt  duration of a step [s]
  MotionCaptureSystem(const MotionCaptureParameters& parameters, std::uint64_t seed, double dt);

  /// To be called in every step, from 0 on.
  /// @param pose  true one at that step
  /// @return the reading that becomes visible in this step; nothing: none does
  std::optional<CapturedPose> step(std::int64_t step, const PlanarPose& pose);

 private:
  [[nodiscard]] MotionCapture measure(std::int64_t step, const PlanarPose& pose);

  MotionCaptureParameters k_;
  double dt_;
  std::mt19937_64 random_;
  std::deque<CapturedPose> under_way_;
};

}  // namespace mrroc::sim
