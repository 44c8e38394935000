// Whether a platform goes where its reference is, or is held back by something that nobody knows.
#pragma once
#include <optional>

#include "edp/platform/platform.hpp"
#include "edp/platform/reference.hpp"

namespace mrroc::edp {

/// A tracker that cannot follow goes on pushing, as its reference is never drawn further away than kMostAway; while its wheels spin at
/// a wall, none of them stands. Real-time safe.
class FollowWatch {
 public:
  /// So many iterations in succession that far away are too many: a second.
  static constexpr int kLong = 50;

  /// @param reference  as it is to be followed, before it is drawn near  @param p  where the platform is believed to be
  /// @return estimate_lost, when it has been further away than kMostAway for kLong iterations; or nothing
  [[nodiscard]] std::optional<Fault> step(const Reference& reference, const PlanarPose& p) noexcept;
  /// It is not driven.
  void forget() noexcept { far_ = 0; }

 private:
  int far_{};  // iterations in succession
};

}  // namespace mrroc::edp
