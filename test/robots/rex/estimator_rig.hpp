// A platform that the estimators of Rex are tried on: its own dynamics, its sensors, and how late their readings come.
#pragma once
#include <array>
#include <functional>
#include <random>
#include <vector>

#include "edp/platform/platform.hpp"
#include "test/robots/rex/plant.hpp"

namespace mrroc::rex::test {

/// Speeds that are wanted at a time [s].
using Drive = std::function<PlanarVelocity(double)>;

/// How a drive goes.
struct Trial {
  Truth truth{};
  Drive drive{};
  double duration{20};                       ///< [s]
  std::array<double, 2> map_lost{1e9, 1e9};  ///< no map pose is measured between these times [s]
  PlanarPose displacement{};                 ///< of the map, from map_lost[1] on
  bool odometry{true};
  double pictures{1};  ///< scales the noise of the odometry, and what it says of it
  bool imu{true};
  Slip later{};         ///< friction from `changes` on
  double changes{1e9};  ///< [s]
  double noise{1};      ///< scales that of all sensors
  unsigned seed{1};
};

/// A stage of a drive.
struct Sample {
  double time{};
  PlanarPose p;      ///< truth
  PlanarVelocity v;  ///< truth
  edp::EstimatorResult result;
};

/// Drives a platform with an estimator listening. Map poses are measured every 50 steps and come 4 stages later; pairs of
/// pictures are taken every 40 steps, their motion comes 7 stages after the second.
/// @return all stages
[[nodiscard]] std::vector<Sample> drive(edp::Estimator& estimator, const Trial& trial);

/// @return v with a turn that goes to and fro, as along a figure eight
[[nodiscard]] Drive winding(double v, double w);

/// @return root of the mean square of the distance between truth and estimate [m], from a time on [s]
[[nodiscard]] double position_rms(const std::vector<Sample>& run, double from = 1);
/// @return the largest distance between two times [m]
[[nodiscard]] double position_max(const std::vector<Sample>& run, double from, double to);
/// @return the largest error of the heading, the short way round [rad], from a time on [s]
[[nodiscard]] double heading_max(const std::vector<Sample>& run, double from = 1);
/// @return means of the estimated coefficients from a time on [s]
[[nodiscard]] Slip mean_slip(const std::vector<Sample>& run, double from);
/// @return share of the stages whose true position is within the estimate's 95 % ellipse, 0..1
[[nodiscard]] double share_in_ellipse(const std::vector<Sample>& run, double from = 1);

}  // namespace mrroc::rex::test
