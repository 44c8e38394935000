// What keeps a platform going when the map says that it is elsewhere: its reference moves along, and comes back slowly.
#pragma once
#include "base/planar.hpp"
#include "edp/platform/reference.hpp"

namespace mrroc::edp {

/// By how much the reference is displaced. Everything is real-time safe.
class ReferenceOffset {
 public:
  /// How fast it comes back: as fast as a platform corrects its way without being seen to.
  static constexpr double kBack = 0.04;        // [m/s]
  static constexpr double kTurnedBack = 0.04;  // [rad/s]

  /// The reference is what it is.
  void drop() noexcept { offset_ = {}; }
  /// The estimate was displaced, and the reference is to be where it was to the platform.
  /// @param displacement  as EstimatorResult has it
  void add(const PlanarPose& displacement) noexcept { offset_ = chained(displacement, offset_); }
  /// @param period  between points of the reference [s]
  /// @return the reference displaced, less and less from point to point, as it will come back
  [[nodiscard]] Reference applied(Reference reference, double period) const noexcept;
  /// A macrostep has passed. @param p  where the platform was to be
  void come_back(const PlanarPose& p) noexcept { offset_ = nearer(p, kPlatformPeriod); }

 private:
  /// @return the offset after a time, seen at p
  [[nodiscard]] PlanarPose nearer(const PlanarPose& p, double time) const noexcept;

  PlanarPose offset_;  // of the plane: p becomes chained(offset_, p)
};

}  // namespace mrroc::edp
