#include "robots/conveyor/conveyor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc::conveyor {
namespace {

/// W may be so far off the belt's line, and an entry of its rotation so far off, and still be on it: rounding of
/// many small steps, far below what an encoder counts.
constexpr double kOnLine = 1e-6;  // [m]

/// Its line goes beyond the legal range, so that a command which leaves that is told so [m].
constexpr double kReach = kLength / 2;

Matrix3 upright() { return Eigen::DiagonalMatrix<double, 3>(1, -1, -1); }

}  // namespace

const edp::AxisProperties& Conveyor::axis(int) const noexcept { return kAxis; }

Pose Conveyor::forward(const AxisVector& joints) const noexcept {
  return {upright(), kSheet + joints[0] * Vector3::UnitY()};
}

edp::InverseSolution Conveyor::inverse(const Pose& T_0W, const AxisVector& near) const noexcept {
  edp::InverseSolution s;
  s.joints = AxisVector::Zero(1);
  if (near.size() != 1 || !T_0W.R.allFinite() || !T_0W.p.allFinite() || !(std::abs(near[0]) <= kReach)) {
    s.missing = std::numeric_limits<double>::infinity();
    return s;
  }
  const Vector3 way = T_0W.p - kSheet;
  s.joints[0] = std::clamp(way.y(), -kReach, kReach);
  const double off = std::hypot(way.x(), way.y() - s.joints[0], way.z());
  const double turned = (T_0W.R - upright()).cwiseAbs().maxCoeff();
  s.reached = off < kOnLine && turned < kOnLine;
  if (!s.reached) s.missing = std::max(off, kOnLine);
  return s;
}

AxisVector Conveyor::motors_from_joints(const AxisVector& joints) const noexcept {
  return AxisVector::Constant(1, kGear * (joints[0] - kZero));
}

AxisVector Conveyor::joints_from_motors(const AxisVector& motors) const noexcept {
  return AxisVector::Constant(1, motors[0] / kGear + kZero);
}

const robots::RobotType& type() {
  static const robots::RobotType conveyor = [] {
    robots::RobotType t;
    t.name = "conveyor";
    t.make = [](int) -> std::unique_ptr<edp::Robot> { return std::make_unique<Conveyor>(); };
    t.driver.tool_weight = 9.81;
    t.driver.tool_mass_centre = {0, 0, 0};
    t.driver.force_limit = {58, 58, 130, 4.5, 4.5, 4.5};
    t.urdf = urdf();
    t.motors = {kMotor};
    t.start = {0};
    t.T_UB.p = kPlace;
    t.belt = robots::Belt{.middle = kMiddle, .width = kWidth, .length = kLength};
    return t;
  }();
  return conveyor;
}

}  // namespace mrroc::conveyor
