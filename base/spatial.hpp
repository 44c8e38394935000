// Six-component quantities along the axes of one frame: generalised velocity and generalised force.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace mrroc {

/// Three components along the axes of one frame; a matrix that turns them; six in the order of Axis.
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Axes of a frame, in the order of every six-component vector.
enum class Axis : std::uint8_t { x, y, z, ax, ay, az };
/// All axes in their order, for loops.
inline constexpr std::array kAxes{Axis::x, Axis::y, Axis::z, Axis::ax, Axis::ay, Axis::az};

/// Six components along and about the axes of one frame. The tag makes a Wrench where a Twist belongs a
/// compile error. Trivially copyable; every function is real-time safe.
template <class Tag>
struct Spatial {
  std::array<double, 6> v{};  ///< x, y, z, ax, ay, az

  constexpr double& operator[](Axis a) { return v[static_cast<std::size_t>(a)]; }
  constexpr double operator[](Axis a) const { return v[static_cast<std::size_t>(a)]; }

  /// @return the components along x, y, z
  [[nodiscard]] Vector3 linear() const { return {v[0], v[1], v[2]}; }
  /// @return the components about x, y, z
  [[nodiscard]] Vector3 angular() const { return {v[3], v[4], v[5]}; }
  /// @return all six components as a column
  [[nodiscard]] Vector6 vector() const { return Eigen::Map<const Vector6>(v.data()); }
  /// @return the quantity with these components along and about x, y, z
  static Spatial from(const Vector3& linear, const Vector3& angular) {
    return {{linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()}};
  }

  constexpr Spatial& operator+=(const Spatial& o) {
    for (std::size_t k = 0; k < 6; ++k) v[k] += o.v[k];
    return *this;
  }
  constexpr Spatial& operator-=(const Spatial& o) {
    for (std::size_t k = 0; k < 6; ++k) v[k] -= o.v[k];
    return *this;
  }
  constexpr Spatial& operator*=(double s) {
    for (double& c : v) c *= s;
    return *this;
  }
  friend constexpr Spatial operator+(Spatial a, const Spatial& b) { return a += b; }
  friend constexpr Spatial operator-(Spatial a, const Spatial& b) { return a -= b; }
  friend constexpr Spatial operator-(Spatial a) { return a *= -1; }
  friend constexpr Spatial operator*(Spatial a, double s) { return a *= s; }
  friend constexpr Spatial operator*(double s, Spatial a) { return a *= s; }
  friend constexpr bool operator==(const Spatial&, const Spatial&) = default;
};

/// Generalised velocity r'_(A): [m/s], [rad/s].
using Twist = Spatial<struct TwistTag>;
/// Generalised force F: [N], [N m]. F_a is what the end effector exerts on its surroundings.
using Wrench = Spatial<struct WrenchTag>;

/// @return whether every component is a finite number
template <class Tag>
[[nodiscard]] inline bool finite(const Spatial<Tag>& s) {
  for (const double c : s.v)
    if (!std::isfinite(c)) return false;
  return true;
}

}  // namespace mrroc
