#include "tasks/rex_drive/odometry_figures.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "base/planar.hpp"
#include "base/statistics.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr double kMilli = 1e3;

/// Whether an error is within the 95 % ellipsoid of its covariance.
bool within_ellipsoid(const PlanarPose& error, const PlanarCovariance& covariance) {
  constexpr double kChiSquared = 7.815;  // three degrees of freedom
  const Eigen::Matrix3d P = Eigen::Map<const Eigen::Matrix3d>(covariance.data());
  const Eigen::Vector3d e(error.x, error.y, error.phi);
  const Eigen::LDLT<Eigen::Matrix3d> root(P);
  return root.vectorD().minCoeff() > 0 && e.dot(root.solve(e)) <= kChiSquared;
}

/// Adds up motions, measured and true.
class Drift {
 public:
  void add(const PlanarPose& measured, const PlanarPose& truth) {
    measured_ = chained(measured_, measured);
    truth_ = chained(truth_, truth);
    length_ += std::hypot(truth.x, truth.y);
    if (length_ < kDriftWay) return;
    percent_.add(100 * std::hypot(measured_.x - truth_.x, measured_.y - truth_.y) / length_);
    begin();
  }
  /// What has been added so far is no way.
  void begin() {
    measured_ = truth_ = {};
    length_ = 0;
  }
  /// @return mean of the ways [%]; not a number: there is none
  [[nodiscard]] double mean_pct() const { return percent_.mean(); }

 private:
  PlanarPose measured_, truth_;
  double length_{};
  Statistics percent_;
};

void of_errors(const OdometryTable& table, mp::Figures& figures) {
  Statistics place, turn, within;  // squares
  Drift drift;
  for (const OdometryRow& row : table) {
    const auto error = motion_error(row);
    if (!row.drives) continue;
    if (!error) {
      drift.begin();
      continue;
    }
    drift.add(row.motion, *row.truth);
    place.add(error->x * error->x + error->y * error->y);
    turn.add(error->phi * error->phi);
    within.add(within_ellipsoid(*error, row.covariance) ? 100 : 0);
  }
  if (std::isnan(place.mean())) return;
  figures["odometry_rms_mm"] = kMilli * std::sqrt(place.mean());
  figures["odometry_turn_rms_mrad"] = kMilli * std::sqrt(turn.mean());
  figures["odometry_95_pct"] = within.mean();
  if (!std::isnan(drift.mean_pct())) figures["odometry_drift_pct"] = drift.mean_pct();
}

}  // namespace

mp::Figures odometry_figures(const OdometryTable& table) {
  mp::Figures figures;
  int pairs = 0, valid = 0;
  Statistics inliers;
  for (const OdometryRow& row : table) {
    if (!row.drives) continue;
    ++pairs;
    if (!row.valid) continue;
    ++valid;
    inliers.add(row.support.inliers);
  }
  if (pairs == 0) return figures;
  figures["odometry_pairs"] = static_cast<double>(pairs);
  figures["odometry_invalid"] = static_cast<double>(pairs - valid);
  figures["odometry_valid_pct"] = 100.0 * valid / pairs;
  if (valid > 0) figures["odometry_inliers"] = inliers.mean();
  of_errors(table, figures);
  return figures;
}

}  // namespace mrroc::rex_drive
