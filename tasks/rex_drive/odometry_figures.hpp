// The figures of a run's visual odometry.
#pragma once
#include "mp/figure_table.hpp"
#include "tasks/rex_drive/odometry_table.hpp"

namespace mrroc::rex_drive {

/// Way over which the drift is taken [m].
inline constexpr double kDriftWay = 2;

/// @return figures; none without eyes. "While it drives" is while a fragment is under way
///   odometry_pairs, odometry_invalid  pairs of pictures while it drives, and those without a motion
///   odometry_valid_pct                share of the others
///   odometry_rms_mm, odometry_turn_rms_mrad  error of a motion from one pair to the next: of place and turn
///   odometry_95_pct                   how often that error is within the 95 % ellipsoid of its covariance
///   odometry_drift_pct                error at the end of ways of kDriftWay against their length, mean; a pair without
///                                     a motion begins a new one
///   odometry_inliers                  points on which a motion rests, mean
[[nodiscard]] mp::Figures odometry_figures(const OdometryTable& table);

}  // namespace mrroc::rex_drive
