// Random rotations and poses for tests.
#pragma once
#include <Eigen/Geometry>
#include <random>

#include "base/pose.hpp"

namespace mrroc::test {

/// @return uniform in [lower, upper)
inline double uniform(std::mt19937_64& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

/// @return three numbers, each uniform in [-size, size)
inline Vector3 random_vector(std::mt19937_64& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

/// @return a unit vector, all directions alike
inline Vector3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

/// @return a rotation, all orientations alike
inline Matrix3 random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

/// @return a pose whose position lies in a cube of this half edge [m]
inline Pose random_pose(std::mt19937_64& random, double size = 1) {
  return {random_rotation(random), random_vector(random, size)};
}

/// @return largest difference of an element
inline double distance(const Pose& a, const Pose& b) {
  return std::max((a.R - b.R).cwiseAbs().maxCoeff(), (a.p - b.p).cwiseAbs().maxCoeff());
}

/// @return six components, each uniform in [-size, size)
template <class Quantity>
Quantity random_spatial(std::mt19937_64& random, double size) {
  return Quantity::from(random_vector(random, size), random_vector(random, size));
}

/// @return largest difference of a component
template <class Tag>
double distance(const Spatial<Tag>& a, const Spatial<Tag>& b) {
  return (a.vector() - b.vector()).cwiseAbs().maxCoeff();
}

}  // namespace mrroc::test
