// Estimates the plane of the paper from the points at which the pen has touched it.
#pragma once
#include <Eigen/LU>
#include <cmath>

#include "base/spatial.hpp"

namespace mrroc::vsp {

/// Tolerances: of a sheet from level, and of points on it from a plane.
struct PlaneParameters {
  double slope{0.02};        ///< sigma_s, standard deviation of a sheet's slope in either direction [rad]
  double roughness{0.0005};  ///< sigma_r, of a point of the pen on the paper from the plane [m]
  double correlation{0.3};   ///< tau_r, time after which a point tells something new [s]
  double memory{30};         ///< tau_m, time on the paper after which an old point counts 1/e [s]
};

/// Depth z = c + a x + b y along the pen's axis, z into the paper. Least squares over the points s = (1, x, y), each
/// with the weight dt / (tau_r sigma_r^2), older ones less by exp(-age / tau_m), and over the slopes a, b, which are 0
/// +- sigma_s: H = sum w s s' + diag(0, 1, 1) / sigma_s^2, g = sum w s z, (c, a, b) = H^-1 g. What it says of a place
/// has the variance s' H^-1 s, which grows away from the points. Real-time safe.
class TouchedPlane {
 public:
  explicit TouchedPlane(const PlaneParameters& parameters) : k_(parameters) {}

  /// Nothing has been touched yet.
  void forget() {
    known_ = false;
    H_.setZero();
    g_.setZero();
  }
  /// The pen is on the paper. @param p  x, y, z of the pen [m] @param dt  since the point before [s]
  void add(const Vector3& p, double dt) {
    if (!known_) origin_ = p;
    known_ = true;
    const Vector3 s = at(p);
    const double weight = dt / (k_.correlation * k_.roughness * k_.roughness);
    const double old = std::exp(-dt / k_.memory);
    H_ = old * H_ + weight * s * s.transpose();
    g_ = old * g_ + weight * (p.z() - origin_.z()) * s;
    const double prior = 1 / (k_.slope * k_.slope);
    covariance_ = (H_ + Vector3(0, prior, prior).asDiagonal().toDenseMatrix()).inverse();
    plane_ = covariance_ * g_;
  }
  /// @return whether a point has been touched
  [[nodiscard]] bool known() const { return known_; }
  /// @return depth of the plane below or above a place [m]; when known()
  [[nodiscard]] double depth(const Vector3& p) const { return origin_.z() + plane_.dot(at(p)); }
  /// @return standard deviation of that [m]; infinite when not known()
  [[nodiscard]] double deviation(const Vector3& p) const {
    return known_ ? std::sqrt(at(p).dot(covariance_ * at(p))) : HUGE_VAL;
  }

 private:
  [[nodiscard]] Vector3 at(const Vector3& p) const { return {1, p.x() - origin_.x(), p.y() - origin_.y()}; }

  PlaneParameters k_;
  bool known_{};
  Vector3 origin_{Vector3::Zero()};  // first point touched
  Matrix3 H_{Matrix3::Zero()};
  Vector3 g_{Vector3::Zero()};
  Matrix3 covariance_{Matrix3::Zero()};
  Vector3 plane_{Vector3::Zero()};  // c, a, b
};

}  // namespace mrroc::vsp
