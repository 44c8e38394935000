// Ways that trackers of Rex are tried on, and closed loops along them.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "edp/platform/platform.hpp"
#include "test/robots/rex/plant.hpp"

namespace mrroc::rex::test {

/// A reference: where B is to be at a time [s] from 0 to its duration; it starts at rest at the origin.
struct Course {
  std::function<PathPoint(double)> at;
  double duration{};  ///< [s]
};

/// One lap of a figure eight of 4 x 2 m, sped up over the first 2 s. @param lap  duration of a lap at full speed [s]
[[nodiscard]] Course figure_eight(double lap);
/// A straight, a quarter of a turn of radius 0.4 m, a straight. @param v  [m/s]
[[nodiscard]] Course corner(double v);
/// 1.2 m ahead, a quarter of a turn on the spot, 1.2 m ahead.
[[nodiscard]] Course pivot();

/// What a tracker is told and how fast it is heard.
struct Loop {
  Truth truth{another_structure()};
  Slip believed{};      ///< slip that the tracker gets
  double delay{0.004};  ///< from the measurement to the new torques [s]
};

/// What has come of it.
struct Tracked {
  double rms{};                             ///< of the distance between truth and reference [m], from 1 s on
  double max{};                             ///< of it [m]
  double largest_torque{};                  ///< of all [N m]
  int failures{};                           ///< steps whose solver failed
  int most_iterations{};                    ///< of a solver
  std::vector<edp::TrackerResult> results;  ///< of all steps
};

/// Drives along the course with the true state, and the true mass and centre.
[[nodiscard]] Tracked track(edp::Tracker& tracker, const Course& course, const Loop& loop);

/// @return the state of the plant as a perfect estimator knows it, phi wrapped
[[nodiscard]] edp::EstimatorResult perfect(const Plant& plant, const Truth& truth);
/// @return the reference from a time on
[[nodiscard]] std::array<PathPoint, kHorizonPoints> horizon(const Course& course, double time);

}  // namespace mrroc::rex::test
