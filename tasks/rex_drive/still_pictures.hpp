// Pictures that stand still although the wheels turn.
#pragma once
#include <cstdint>
#include <optional>

#include "tasks/rex_drive/wheel_watch.hpp"

namespace mrroc::rex_drive {

/// What the pictures have shown since they began to stand. A camera that hangs gives a picture which does not move; with the
/// sensor's noise on it, it looks like one of a platform that stands.
struct StillPictures {
  std::int64_t step{-1};  ///< of the newest reading
  std::optional<PerWheel>
      theta{};  ///< of the wheels when the pictures began to stand; none: they move, or nobody knows
  double x{}, y{}, turn{};  ///< seen since then [m], [rad]
  bool
      against_wheels{};  ///< since then the wheels have turned by more than they can slip, and are believed. Should
                         ///< the platform be held back while they spin, what is lost are readings
};

/// @return what is known with one reading more: from one that shows a motion on, the pictures move again; one that is not
///         valid, or not newer, says nothing
[[nodiscard]] StillPictures seen(StillPictures still, const OdometryReading& reading,
                                 const WheelWatch& watch);

}  // namespace mrroc::rex_drive
