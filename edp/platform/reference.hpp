// What the tracker is given to follow.
#pragma once
#include <array>

#include "base/platform_command.hpp"
#include "edp/platform/fragment_queue.hpp"
#include "edp/platform/pace.hpp"

namespace mrroc::edp {

/// Where a platform is to be, from now on.
using Reference = std::array<PathPoint, kHorizonPoints>;

/// The reference may be so far from the estimate [m], [rad]: a position that comes back after a drop-out makes no kick.
inline constexpr double kMostAway = 0.25;
inline constexpr double kMostTurnedAway = 0.5;

/// @param period  between points [s]  @return points of the way at the pace that is to come. Real-time safe
[[nodiscard]] Reference reference_ahead(const FragmentQueue& queue, const Pace& pace, double period) noexcept;

/// @param p  estimated  @return the reference as a whole, moved and turned towards p until its first point is within the
///         distances above; headings differ by the shortest turn. Real-time safe
[[nodiscard]] Reference drawn_near(Reference reference, const PlanarPose& p) noexcept;

}  // namespace mrroc::edp
