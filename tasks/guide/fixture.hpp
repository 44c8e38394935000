// A virtual fixture: what a tool may move on, a curve or a piece of a plane.
#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/pose.hpp"
#include "tasks/guide/curve.hpp"

namespace mrroc::guide {

/// How a tool stands to a fixture. All along the axes of the task frame: x along the curve, y across it in its plane, z
/// across the plane; of a plane x and y are free.
struct Standing {
  double s{};                      ///< place on the curve, length from its beginning [m]; 0 of a plane
  double y{};                      ///< off a curve, within its plane [m]; 0 of a plane
  double z{};                      ///< off the plane of the fixture [m]
  std::array<double, 2> beyond{};  ///< beyond the ends along x, and of a plane along y [m]; 0: within

  /// @return across everything that is stiff [m]
  [[nodiscard]] double off() const;
  /// @return from the fixture with its ends [m]
  [[nodiscard]] double distance() const;
};

/// Constant during a run; every function is pure.
class Fixture {
 public:
  /// @param T_0F  frame of its plane in the base of the arm: x and y in the plane
  Fixture(const Pose& T_0F, Curve curve) : T_0F_(T_0F), curve_(std::move(curve)) {}
  /// A rectangle around the origin of F. @param sides  along x and y [m], above 0
  Fixture(const Pose& T_0F, const std::array<double, 2>& sides) : T_0F_(T_0F), sides_(sides) {}

  /// @return whether the tool is free in a plane, not only along a curve
  [[nodiscard]] bool is_plane() const { return !curve_; }
  /// @return the curve; null of a plane
  [[nodiscard]] const Curve* curve() const { return curve_ ? &*curve_ : nullptr; }
  /// @return sides of the rectangle of a plane [m]
  [[nodiscard]] const std::array<double, 2>& sides() const { return sides_; }
  /// @return frame of its plane in the base
  [[nodiscard]] const Pose& T_0F() const { return T_0F_; }

  /// @param tool  in the base [m]
  /// @param s     where it stood before [m]; nothing: not known, the nearest place of all counts
  [[nodiscard]] Standing stand(const Vector3& tool, std::optional<double> s) const;
  /// @return axes of the task frame at a place, in the base
  [[nodiscard]] Matrix3 axes(double s) const;
  /// @return radius of the narrowest bend around a place [m]; of a plane infinity
  [[nodiscard]] double bend(double s) const { return curve_ ? curve_->narrowest(s) : HUGE_VAL; }
  /// @return points all over it, in the base, at most so far from one another [m]
  [[nodiscard]] std::vector<Vector3> points(double distance) const;

 private:
  Pose T_0F_;
  std::optional<Curve> curve_{};
  std::array<double, 2> sides_{};
};

}  // namespace mrroc::guide
