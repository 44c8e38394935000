#include "tasks/calibrate_cell/probing.hpp"

#include <algorithm>

#include "tasks/calibrate_cell/fit.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr double kSamePlace = 1e-4;  // [m]

std::span<const Touch> of_ball(std::span<const Touch> done, std::size_t ball) {
  const std::size_t first = std::min(done.size(), ball * kTouchesPerBall);
  return done.subspan(first, std::min(kTouchesPerBall, done.size() - first));
}

double gap(const ProbePlan& plan, std::size_t n) {
  return n % kTouchesPerBall < kDirections.size() ? plan.wide_gap : plan.narrow_gap;
}

Vector3 found(const ProbePlan& plan, std::span<const Touch> of_it, const Vector3& told) {
  const double radius = plan.ball_radius + plan.tip_radius;
  Vector3 centre = told;
  std::vector<Vector3> middles;
  for (const Touch& t : of_it) {
    centre += ((t.middle - centre).dot(t.along) + radius) * t.along;
    middles.push_back(t.middle);
  }
  const auto fit = fit_ball(middles, centre, radius);
  return fit ? fit->centre : centre;
}

/// Poses with one orientation; those that stand where the one before does are left out.
std::vector<Pose> poses(const Pose& T_now, const Matrix3& R, std::initializer_list<Vector3> places) {
  std::vector<Pose> way{T_now};
  for (const Vector3& p : places)
    if ((p - way.back().p).norm() > kSamePlace) way.push_back({R, p});
  return way;
}

/// The same place at another depth.
Vector3 at_depth(const Vector3& p, const Vector3& z, double depth) { return p + (depth - p.dot(z)) * z; }

Vector3 clear_of_last(const ProbePlan& plan, std::span<const Touch> done, const Vector3& p) {
  return done.empty() ? p : Vector3(p - gap(plan, done.size() - 1) * done.back().along);
}

}  // namespace

Vector3 in_base(const Direction& d, const Matrix3& R) { return d.sign * R.col(static_cast<int>(d.axis)); }

Vector3 middle_of_tip(const ProbePlan& plan, const Pose& T_0E) {
  return T_0E.p - plan.tip_radius * T_0E.R.col(2);
}

Vector3 believed(const ProbePlan& plan, std::span<const Touch> done, std::size_t ball) {
  Vector3 shift = Vector3::Zero();
  const std::size_t whole = std::min(ball, done.size() / kTouchesPerBall);
  for (std::size_t k = 0; k < whole; ++k)
    shift += (found(plan, of_ball(done, k), plan.balls[k]) - plan.balls[k]) / static_cast<double>(whole);
  return found(plan, of_ball(done, ball), plan.balls[ball] + shift);
}

std::vector<Pose> way_to_touch(const ProbePlan& plan, std::span<const Touch> done, const Pose& T_now,
                               const Pose& T_ready) {
  const std::size_t n = done.size();
  const Matrix3& R = T_ready.R;
  const Vector3 z = R.col(2);
  const Vector3 centre = believed(plan, done, std::min(n / kTouchesPerBall, plan.balls.size() - 1));
  const double away = plan.ball_radius + plan.tip_radius + gap(plan, n);
  const Vector3 goal = centre - away * in_base(direction(n), R) + plan.tip_radius * z;
  const double before = (centre + plan.tip_radius * z).dot(z) - away;  // in front of the ball
  const double depth = n % kTouchesPerBall == 0 ? std::min(before, T_ready.p.dot(z)) : before;
  const Vector3 clear = clear_of_last(plan, done, T_now.p);
  return poses(T_now, R, {clear, at_depth(clear, z, depth), at_depth(goal, z, depth), goal});
}

std::vector<Pose> way_back(const ProbePlan& plan, std::span<const Touch> done, const Pose& T_now,
                           const Pose& T_ready) {
  const Vector3 z = T_ready.R.col(2);
  const Vector3 clear = clear_of_last(plan, done, T_now.p);
  return poses(T_now, T_ready.R, {clear, at_depth(clear, z, T_ready.p.dot(z)), T_ready.p});
}

double longest_way(const ProbePlan& plan, std::size_t n) { return gap(plan, n) + plan.beyond; }

}  // namespace mrroc::calibrate_cell
