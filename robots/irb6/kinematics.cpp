#include "robots/irb6/kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "robots/irb6/transmission.hpp"

namespace mrroc::irb6 {
namespace {

using std::numbers::pi;

constexpr double kTurn = 2 * pi;
// Less change of all angles together than this is a step of a path: it never jumps to another branch, not
// even beyond a limit or the reach, which is for the guards to see.
constexpr double kPathStep = 0.05;
// Cost of an angle outside the limits, above any distance within them; and of each metre out of reach.
constexpr double kIllegal = 1e3;
constexpr double kUnreached = 1e5;
// A rule for the track moves it by at most 1 / kWellConditioned for each metre that the pose moves.
constexpr double kWellConditioned = 0.2;
// Below this sine the direction of a singular axis is rounding noise.
constexpr double kSingular = 1e-10;
// A position beyond the reach by less than this is reached.
constexpr double kReachTolerance = 1e-9;
// Beyond this nothing is a joint position, nor a position.
constexpr double kHuge = 1e6;

edp::Range sorted(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

// The representation angle + k * 2 pi nearest to another angle.
double nearest_turn(double angle, double near) {
  const double away = near - angle;
  return std::abs(away) <= pi ? angle : angle + kTurn * std::round(away / kTurn);
}

// The nearest representation within the limits; without one, the nearest.
double nearest_legal_turn(double angle, double near, edp::Range legal) {
  const double nearest = nearest_turn(angle, near);
  if (legal.contains(nearest)) return nearest;
  const double inside = nearest < legal.lower ? nearest + kTurn * std::ceil((legal.lower - nearest) / kTurn)
                                              : nearest - kTurn * std::ceil((nearest - legal.upper) / kTurn);
  return legal.contains(inside) ? inside : nearest;
}

// Tells whether the angle's opposite is nearer to the other angle than itself.
bool half_turn_apart(double angle, double other) {
  return std::abs(angle - nearest_turn(other, angle)) > pi / 2;
}

double cost(double angle, double near, edp::Range legal) {
  return std::abs(angle - near) + (legal.contains(angle) ? 0 : kIllegal);
}

bool usable(const double* x, Eigen::Index n) {
  return std::all_of(x, x + n, [](double v) { return std::abs(v) < kHuge; });  // false for NaN
}

AxisVector motor_limits(const ArmParameters& arm, double edp::Range::*end) {
  AxisVector m(arm.axis_count());
  for (int k = 0; k < arm.axis_count(); ++k)
    m[k] = arm.axes[static_cast<std::size_t>(k)].properties.motor.*end;
  return m;
}

}  // namespace

Kinematics::Kinematics(const ArmParameters& arm) noexcept
    : k_(arm.lengths),
      track_rule_(arm.on_track ? arm.track_rule : TrackRule::kept),
      first_(arm.first()),
      count_(arm.axis_count()),
      legal_{} {
  const Transmission transmission(arm);
  const AxisVector lower = transmission.joints(motor_limits(arm, &edp::Range::lower)).value;
  const AxisVector upper = transmission.joints(motor_limits(arm, &edp::Range::upper)).value;
  const Angles a = angles(lower), b = angles(upper);
  const std::size_t T = static_cast<std::size_t>(first_) + 3;
  const double per_theta4 = -arm.axes[T].drive.gear / arm.axes[T + 1].drive.gear;
  legal_ = {.track = arm.on_track ? sorted(lower[0], upper[0]) : edp::Range{},
            .theta1 = sorted(a.theta1, b.theta1),
            .theta2 = sorted(a.theta2, b.theta2),
            .theta3 = sorted(a.theta3, b.theta3),
            .theta4 = sorted(a.theta4, b.theta4),
            .q6 = sorted(a.q6, b.q6),
            .q5_at_zero = sorted(a.q5 - per_theta4 * a.theta4, b.q5 - per_theta4 * b.theta4),
            .q5_per_theta4 = per_theta4};
}

Kinematics::Angles Kinematics::angles(const AxisVector& joints) const noexcept {
  const double* q = joints.data() + first_;
  const double theta3 = q[1] + q[2] + pi / 2;
  return {q[0], q[1], theta3, theta3 + q[3], q[4], q[5]};
}

Pose Kinematics::forward(const AxisVector& joints) const noexcept {
  const Angles a = angles(joints);
  return forward(Directions{
      {Direction::of(a.theta2), Direction::of(a.theta3), Direction::of(a.theta4), Direction::of(a.q5)},
      Direction::of(a.theta1),
      Direction::of(a.q6),
      first_ == 1 ? joints[0] : 0});
}

Pose Kinematics::forward(const Directions& links) const noexcept {
  const auto [c1, s1] = links.theta1;
  const auto [c2, s2] = links.theta2;
  const auto [c3, s3] = links.theta3;
  const auto [c4, s4] = links.theta4;
  const auto [c5, s5] = links.q5;
  const auto [c6, s6] = links.q6;
  Pose T;
  T.R << (c1 * s4 * c5 + s1 * s5) * c6 + c1 * c4 * s6, -(c1 * s4 * c5 + s1 * s5) * s6 + c1 * c4 * c6,
      c1 * s4 * s5 - s1 * c5,  //
      (s1 * s4 * c5 - c1 * s5) * c6 + s1 * c4 * s6, -(s1 * s4 * c5 - c1 * s5) * s6 + s1 * c4 * c6,
      s1 * s4 * s5 + c1 * c5,  //
      c4 * c5 * c6 - s4 * s6, -c4 * c5 * s6 - s4 * c6, c4 * s5;
  const double radius = k_.a2 * c2 + k_.a3 * c3 + k_.d5 * c4;
  T.p << c1 * radius, s1 * radius + links.track, k_.z_offset - k_.a2 * s2 - k_.a3 * s3 - k_.d5 * s4;
  return T;
}

Jacobian Kinematics::jacobian(const AxisVector& joints) const noexcept {
  const Angles a = angles(joints);
  const Vector3 h{std::cos(a.theta1), std::sin(a.theta1), 0};
  const Vector3 z = Vector3::UnitZ();
  const Vector3 n = z.cross(h);
  // A link of the plane that stands at an angle, and how it moves when the angle grows.
  const auto along = [&](double angle) -> Vector3 { return std::cos(angle) * h - std::sin(angle) * z; };
  const auto turning = [&](double angle) -> Vector3 { return -std::sin(angle) * h - std::cos(angle) * z; };
  const Vector3 d4 = k_.d5 * turning(a.theta4);
  const Vector3 d3 = k_.a3 * turning(a.theta3) + d4;
  const Vector3 d2 = k_.a2 * turning(a.theta2) + d3;
  const double radius = k_.a2 * std::cos(a.theta2) + k_.a3 * std::cos(a.theta3) + k_.d5 * std::cos(a.theta4);

  Jacobian J = Jacobian::Zero(6, count_);
  const auto put = [&](int axis, const Vector3& v, const Vector3& w) { J.col(first_ + axis) << v, w; };
  if (first_ == 1) J(1, 0) = 1;
  put(0, radius * n, z);
  put(1, d2, n);
  put(2, d3, n);
  put(3, d4, n);
  put(4, Vector3::Zero(), along(a.theta4));
  put(5, Vector3::Zero(), forward(joints).R.col(2));
  return J;
}

Kinematics::Plane Kinematics::plane(double x, double y, const Angles& near) const noexcept {
  const double radius = std::sqrt(x * x + y * y);
  if (radius < kSingular) {
    const double c1 = std::cos(near.theta1), s1 = std::sin(near.theta1);
    return {near.theta1, c1, s1, c1 * x + s1 * y, true};
  }
  const double theta1 = std::atan2(y, x);
  if (half_turn_apart(theta1, near.theta1) &&
      k_.a2 * std::cos(near.theta2) + k_.a3 * std::cos(near.theta3) + k_.d5 * std::cos(near.theta4) < 0)
    return {theta1 + pi, -x / radius, -y / radius, -radius, false};
  return {theta1, x / radius, y / radius, radius, false};
}

void Kinematics::elbow(Branch& b, double c4, double s4, double radius, double height,
                       const Angles& near) const noexcept {
  // The triangle shoulder, elbow, wrist pitch axis in the plane of the arm: E forward, F down.
  const double E = radius - k_.d5 * c4;
  const double F = -height - k_.d5 * s4;
  const double reach2 = E * E + F * F;
  const double reach = std::sqrt(reach2);
  b.missing = std::max({0.0, reach - (k_.a2 + k_.a3), std::abs(k_.a2 - k_.a3) - reach});
  if (b.missing < kReachTolerance) b.missing = 0;

  const double c = std::clamp((reach2 - k_.a2 * k_.a2 - k_.a3 * k_.a3) / (2 * k_.a2 * k_.a3), -1.0, 1.0);
  const double bend = near.theta3 - near.theta2;
  const bool usual = (bend > 0 && bend < pi) || std::sin(bend) >= 0;
  const double s = std::sqrt(1 - c * c) * (usual ? 1 : -1);
  b.angles.theta2 = std::atan2(F, E) - std::atan2(k_.a3 * s, k_.a2 + k_.a3 * c);
  b.angles.theta3 = b.angles.theta2 + std::atan2(s, c);
}

bool Kinematics::take_path_step(Angles& a, const Angles& near) noexcept {
  const Angles step{nearest_turn(a.theta1, near.theta1), nearest_turn(a.theta2, near.theta2),
                    nearest_turn(a.theta3, near.theta3), nearest_turn(a.theta4, near.theta4),
                    nearest_turn(a.q5, near.q5),         nearest_turn(a.q6, near.q6)};
  const double change = std::abs(step.theta1 - near.theta1) + std::abs(step.theta2 - near.theta2) +
                        std::abs(step.theta3 - near.theta3) + std::abs(step.theta4 - near.theta4) +
                        std::abs(step.q5 - near.q5) + std::abs(step.q6 - near.q6);
  if (!(change < kPathStep)) return false;
  a = step;
  return true;
}

void Kinematics::take_legal_turns(Branch& b, const Angles& near) const noexcept {
  Angles& a = b.angles;
  a.theta1 = nearest_legal_turn(a.theta1, near.theta1, legal_.theta1);
  a.theta2 = nearest_legal_turn(a.theta2, near.theta2, legal_.theta2);
  a.theta3 = nearest_legal_turn(a.theta3, near.theta3, legal_.theta3);
  a.theta4 = nearest_legal_turn(a.theta4, near.theta4, legal_.theta4);
  const double shift = legal_.q5_per_theta4 * a.theta4;
  const edp::Range legal_q5{legal_.q5_at_zero.lower + shift, legal_.q5_at_zero.upper + shift};
  a.q5 = nearest_legal_turn(a.q5, near.q5, legal_q5);
  a.q6 = nearest_legal_turn(a.q6, near.q6, legal_.q6);
  b.cost = cost(a.theta1, near.theta1, legal_.theta1) + cost(a.theta2, near.theta2, legal_.theta2) +
           cost(a.theta3, near.theta3, legal_.theta3) + cost(a.theta4, near.theta4, legal_.theta4) +
           cost(a.q5, near.q5, legal_q5) + cost(a.q6, near.q6, legal_.q6) + kUnreached * b.missing;
}

Kinematics::Branch Kinematics::solve(const Pose& T_0W, double track, const Angles& near) const noexcept {
  const double height = T_0W.p.z() - k_.z_offset;
  const Plane plane = this->plane(T_0W.p.x(), T_0W.p.y() - track, near);

  // Columns of R in the plane of the arm: along it (h), along z, and along its normal (n).
  const auto N = T_0W.R.col(0), O = T_0W.R.col(1), A = T_0W.R.col(2);
  const double N_h = plane.c1 * N.x() + plane.s1 * N.y();
  const double O_h = plane.c1 * O.x() + plane.s1 * O.y();
  const double A_h = plane.c1 * A.x() + plane.s1 * A.y();
  const double A_n = plane.c1 * A.y() - plane.s1 * A.x();
  const double s5 = std::sqrt(A_h * A_h + A.z() * A.z());

  // Two choices differ by half a turn of T and N and the sign of sin q5. First the one with T nearer.
  const bool wrist_singular = s5 < kSingular;
  double theta4 = near.theta4;
  double c4{}, s4{};
  if (wrist_singular) {
    c4 = std::cos(theta4);
    s4 = std::sin(theta4);
  } else {
    theta4 = std::atan2(A_h, A.z());
    const bool mirrored = half_turn_apart(theta4, near.theta4);
    if (mirrored) theta4 += pi;
    c4 = (mirrored ? -A.z() : A.z()) / s5;
    s4 = (mirrored ? -A_h : A_h) / s5;
  }
  const double q5 = std::atan2(A_h * s4 + A.z() * c4, A_n);
  const double q6 = std::atan2(N_h * c4 - N.z() * s4, O_h * c4 - O.z() * s4);

  Branch best{.angles = {plane.theta1, 0, 0, theta4, q5, q6}};
  elbow(best, c4, s4, plane.radius, height, near);
  if (!take_path_step(best.angles, near)) {
    take_legal_turns(best, near);
    // Lower bound of the other one's cost. Half a turn of T is seldom within the limits.
    const double other_theta4 = nearest_legal_turn(theta4 + pi, near.theta4, legal_.theta4);
    if (!wrist_singular && cost(other_theta4, near.theta4, legal_.theta4) < best.cost) {
      Branch other{.angles = {plane.theta1, 0, 0, theta4 + pi, -q5, q6 + pi}};
      elbow(other, -c4, -s4, plane.radius, height, near);
      take_legal_turns(other, near);
      if (other.cost < best.cost) best = other;
    }
  }
  best.track = track;
  best.singular = plane.singular || wrist_singular;
  return best;
}

double Kinematics::place_track(const Pose& T_0W, double track, const Angles& near) const noexcept {
  // A direction in the arm's plane, level enough: the plane through the wrist meets the track there.
  double x = 0, y = 0;
  if (track_rule_ == TrackRule::column_kept) {
    x = std::cos(near.theta1);
    y = std::sin(near.theta1);
  } else {
    // The hand: what turning N by q6 leaves along the forearm-hand line.
    const double c6 = std::cos(near.q6), s6 = std::sin(near.q6);
    x = s6 * T_0W.R(0, 0) + c6 * T_0W.R(0, 1);
    y = s6 * T_0W.R(1, 0) + c6 * T_0W.R(1, 1);
  }
  if (std::abs(x) < kWellConditioned) return track;
  const double wanted = T_0W.p.y() - T_0W.p.x() * y / x;
  return std::clamp(wanted, std::min(legal_.track.lower, track), std::max(legal_.track.upper, track));
}

edp::InverseSolution Kinematics::inverse(const Pose& T_0W, const AxisVector& near) const noexcept {
  edp::InverseSolution solution{AxisVector::Zero(count_)};
  if (near.size() != count_ || !usable(near.data(), count_) || !usable(T_0W.p.data(), 3) ||
      !usable(T_0W.R.data(), 9)) {
    solution.missing = std::numeric_limits<double>::infinity();
    return solution;
  }
  const Angles n = angles(near);
  const double track = first_ == 1 ? near[0] : 0;
  Branch best{};
  if (track_rule_ == TrackRule::kept) {
    best = solve(T_0W, track, n);
  } else {
    best = solve(T_0W, place_track(T_0W, track, n), n);
    if (best.missing > 0 || best.cost >= kIllegal) {
      const Branch still = solve(T_0W, track, n);
      if (still.missing < best.missing || (still.missing == best.missing && still.cost < best.cost))
        best = still;
    }
  }

  const Angles& a = best.angles;
  solution.reached = best.missing == 0;
  solution.missing = best.missing;
  solution.singular = best.singular;
  if (first_ == 1) solution.joints[0] = best.track;
  solution.joints.tail<kArmAxes>() << a.theta1, a.theta2, a.theta3 - a.theta2 - pi / 2, a.theta4 - a.theta3,
      a.q5, a.q6;
  return solution;
}

}  // namespace mrroc::irb6
