// Random plans that a platform can drive.
#pragma once
#include <cmath>
#include <numbers>
#include <random>

#include "tasks/rex_drive/plan/plan_file.hpp"

namespace mrroc::rex_drive {

/// @return points anywhere within 4 x 2.6 m: most legs begin with a turn on the spot
inline Plan scattered_plan(std::mt19937& random, int n, double speed) {
  std::uniform_real_distribution<double> x(-2, 2), y(-1.3, 1.3);
  Plan plan{.number = 1, .n = n, .speed = speed};
  for (int k = 0; k < n; ++k) plan.point[static_cast<std::size_t>(k)] = {x(random), y(random)};
  return plan;
}

/// @return points of a way that turns by less than 70 degrees at each, with legs of 0.1 to 1.3 m
inline Plan winding_plan(std::mt19937& random, int n, double speed) {
  std::uniform_real_distribution<double> leg(0.1, 1.3), turn(-1.2, 1.2);
  Plan plan{.number = 1, .n = n, .speed = speed};
  double px = 0, py = 0, heading = 0;
  for (int k = 0; k < n; ++k) {
    const double length = leg(random);
    heading += turn(random);
    px += length * std::cos(heading);
    py += length * std::sin(heading);
    plan.point[static_cast<std::size_t>(k)] = {px, py};
  }
  return plan;
}

}  // namespace mrroc::rex_drive
