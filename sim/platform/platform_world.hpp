// Platforms in a room, step by step: the same for them as sim/world.hpp is for arms.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/platform_hardware.hpp"
#include "base/platform_transmission.hpp"
#include "sim/platform/motion_capture.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// Most platforms of a world.
inline constexpr std::size_t kMostPlatforms = 2;
/// Most boxes of a world.
inline constexpr std::size_t kMostBoxes = 4;

/// The simulation. Single-threaded and deterministic: the same parameters, seed and calls give the same bits.
class PlatformWorld {
 public:
  /// Platforms and boxes at rest where they start, encoders and yaws zero, step 0.
  /// @throws std::invalid_argument  a parameter is out of range; the text says which
  explicit PlatformWorld(const PlatformWorldParameters& parameters, std::uint64_t seed = 1);
  ~PlatformWorld();
  PlatformWorld(PlatformWorld&&) noexcept;
  PlatformWorld& operator=(PlatformWorld&&) noexcept;

  /// @return number of platforms
  [[nodiscard]] int platforms() const;
  /// @return steps so far
  [[nodiscard]] std::int64_t steps() const;

  /// Advances by kPlatformPeriod / kPlatformSteps.
  /// @param drives  one per platform, in order, torques finite. A platform whose drive is absent (the span is shorter) or not
  ///                enabled brakes by itself: motors short-circuited.
  void step(std::span<const PlatformDrive> drives);

  /// @param platform  0..platforms()-1
  /// @return what its sensors measured in the last step; before the first that of the platform at rest, step 0
  [[nodiscard]] const PlatformReading& reading(int platform) const;
  /// @return the reading of motion capture that becomes visible in this step, if one does
  [[nodiscard]] const std::optional<CapturedPose>& motion_capture(int platform) const;
  /// @return the true state, for tests, viewers and figures, never for control
  [[nodiscard]] const PlatformTruth& truth(int platform) const;

  /// @param platform  0..platforms()-1 @return its body, as it really is
  [[nodiscard]] const robots::SkidSteerParameters& body(int platform) const;

  /// @return number of boxes
  [[nodiscard]] int boxes() const;
  /// @param box  0..boxes()-1, in the order of the parameters
  /// @return the reading of motion capture for it that becomes visible in this step, if one does
  [[nodiscard]] const std::optional<CapturedPose>& box_motion_capture(int box) const;
  /// @return its true state, for tests, viewers and figures, never for control
  [[nodiscard]] const BoxTruth& box_truth(int box) const;

  /// @return hash over the complete state of all platforms and boxes, to compare runs
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
