#include "ecp/generators/trapezoid.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace mrroc::ecp {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw FaultError(FaultCode::bad_trajectory, what); }

/// Way covered while the speed changes evenly.
double ramp(double from, double to, double a) { return (from + to) / 2 * std::abs(to - from) / a; }

/// Way in the time T with the middle speed vc.
double way(double v0, double vc, double v1, double a, double T) {
  const double at_vc = T - (std::abs(vc - v0) + std::abs(v1 - vc)) / a;
  return ramp(v0, vc, a) + vc * at_vc + ramp(vc, v1, a);
}

/// One axis of a section, looked at in the direction of its motion: no number is negative. Neither v0 nor v1 is above the mean
/// of the way from rest to rest, which is sqrt(a d) / 2 at most. To come from one to the other takes an eighth of the way, and
/// to stop from v0 and to come up to v1 a quarter: there is a motion in every time that is not shorter than the shortest one.
struct Task {
  double d, v0, v1, v, a;

  /// @return highest speed on the shortest way in time
  [[nodiscard]] double peak() const { return std::min(v, std::sqrt((2 * a * d + v0 * v0 + v1 * v1) / 2)); }
  [[nodiscard]] double shortest_time() const {
    const double vp = peak();
    if (vp <= 0) return 0;
    const double even = d - ramp(v0, vp, a) - ramp(vp, v1, a);
    return (vp - v0 + vp - v1) / a + std::max(0.0, even) / vp;
  }
  /// @return middle speed with which the way takes the time T, not less than the shortest
  [[nodiscard]] double speed_for(double T) const {
    double low = std::max(0.0, (v0 + v1 - a * T) / 2), high = peak();
    for (int k = 0; k < 200 && low < high; ++k) {
      const double middle = (low + high) / 2;
      if (middle == low || middle == high) break;
      (way(v0, middle, v1, a, T) < d ? low : high) = middle;
    }
    return low;
  }
};

void check(const Coordinates& q, Eigen::Index size, const char* what) {
  if (q.size() != size) refuse(fmt::format("{} has {} numbers instead of {}", what, q.size(), size));
  if (!q.allFinite()) refuse(fmt::format("{} has a number that is not finite", what));
}

}  // namespace

/// Finds times and speeds of all sections.
class Trapezoid::Planner {
 public:
  Planner(const Coordinates& from, const std::vector<ViaPoint>& list, const MotionLimits& limits, double step)
      : from_(from), list_(list), limits_(limits), step_(step) {
    for (std::size_t k = 0; k < list_.size(); ++k) {
      const Coordinates d = displacement_of(k);
      double time = 0;
      for (int axis = 0; axis < d.size(); ++axis) time = std::max(time, task(k, axis, 0, 0).shortest_time());
      mean_.push_back(time > 0 ? Coordinates(d / time) : Coordinates(Coordinates::Zero(d.size())));
    }
  }

  /// @param arrivals  empty
  std::vector<Section> plan(std::vector<long>& arrivals) {
    std::vector<Section> sections;
    for (std::size_t k = 0; k < list_.size(); ++k) {
      const Planned planned = plan_section(k);
      sections.push_back(planned.section);
      arrivals.push_back((arrivals.empty() ? 0 : arrivals.back()) + planned.macrosteps);
    }
    return sections;
  }

 private:
  struct Planned {
    Section section;
    long macrosteps{};
  };

  [[nodiscard]] const Coordinates& start(std::size_t k) const { return k == 0 ? from_ : list_[k - 1].pose; }
  [[nodiscard]] Coordinates displacement_of(std::size_t k) const { return list_[k].pose - start(k); }

  /// Speed of an axis at the end of section k.
  [[nodiscard]] double speed_after(std::size_t k, int axis) const {
    if (k + 1 >= list_.size() || !list_[k].pass) return 0;
    const double before = mean_[k][axis];
    const double behind = mean_[k + 1][axis];
    if (before * behind <= 0) return 0;
    return std::abs(before) < std::abs(behind) ? before : behind;
  }

  [[nodiscard]] Task task(std::size_t k, int axis, double v0, double v1) const {
    const double d = displacement_of(k)[axis];
    const double sign = d < 0 ? -1 : 1;
    return {sign * d, sign * v0, sign * v1, list_[k].velocity * limits_.velocity[axis],
            list_[k].acceleration * limits_.acceleration[axis]};
  }

  [[nodiscard]] Planned plan_section(std::size_t k) const {
    const auto axes = static_cast<int>(from_.size());
    std::vector<Task> tasks;
    double time = 0;
    for (int axis = 0; axis < axes; ++axis) {
      tasks.push_back(task(k, axis, k == 0 ? 0 : speed_after(k - 1, axis), speed_after(k, axis)));
      time = std::max(time, tasks.back().shortest_time());
    }
    Planned planned;
    planned.macrosteps = static_cast<long>(std::ceil(time / step_ - 1e-9));
    const double T = std::max(time, static_cast<double>(planned.macrosteps) * step_);
    for (int axis = 0; axis < axes; ++axis) {
      const Task& t = tasks[static_cast<std::size_t>(axis)];
      const double sign = displacement_of(k)[axis] < 0 ? -1 : 1;
      planned.section.axes.push_back({start(k)[axis], sign * t.v0, sign * t.speed_for(T), sign * t.v1, t.a});
    }
    return planned;
  }

  Coordinates from_;
  const std::vector<ViaPoint>& list_;
  const MotionLimits& limits_;
  double step_;
  std::vector<Coordinates> mean_;  // speed over each section, if it were made from rest to rest
};

void check_list(const Coordinates& from, const std::vector<ViaPoint>& list, const MotionLimits& limits,
                double macrostep_s) {
  if (list.empty()) refuse("the list has no pose");
  if (!(macrostep_s > 0)) refuse("a macrostep must last");
  check(from, from.size(), "the first pose");
  check(limits.velocity, from.size(), "the limit of velocity");
  check(limits.acceleration, from.size(), "the limit of acceleration");
  if (!(limits.velocity.minCoeff() > 0 && limits.acceleration.minCoeff() > 0))
    refuse("limits must be above zero");
  const auto fraction = [](double f) { return f > 0 && f <= 1; };
  for (const ViaPoint& via : list) {
    check(via.pose, from.size(), "a pose");
    if (!fraction(via.velocity) || !fraction(via.acceleration))
      refuse("fractions of velocity and acceleration must lie above 0 and up to 1");
  }
}

Trapezoid::Trapezoid(const Coordinates& from, std::vector<ViaPoint> list, const MotionLimits& limits,
                     double macrostep_s)
    : macrostep_s_(macrostep_s) {
  check_list(from, list, limits, macrostep_s);
  end_ = list.back().pose;
  sections_ = Planner(from, list, limits, macrostep_s).plan(arrivals_);
}

double Trapezoid::duration() const { return static_cast<double>(arrivals_.back()) * macrostep_s_; }

Coordinates Trapezoid::at(double t) const {
  if (t >= duration()) return end_;
  std::size_t k = 0;
  while (t >= static_cast<double>(arrivals_[k]) * macrostep_s_) ++k;
  const long begin = k == 0 ? 0 : arrivals_[k - 1];
  const double T = static_cast<double>(arrivals_[k] - begin) * macrostep_s_;
  const double tau = std::max(0.0, t - static_cast<double>(begin) * macrostep_s_);
  Coordinates q(end_.size());
  for (int axis = 0; axis < q.size(); ++axis) {
    const Profile& p = sections_[k].axes[static_cast<std::size_t>(axis)];
    const double t1 = std::abs(p.vc - p.v0) / p.a;
    const double t2 = std::max(t1, T - std::abs(p.v1 - p.vc) / p.a);
    const double up = std::copysign(p.a, p.vc - p.v0);
    const double down = std::copysign(p.a, p.v1 - p.vc);
    const double first = std::min(tau, t1);
    q[axis] = p.p0 + first * (p.v0 + up * first / 2);
    if (tau > t1) q[axis] += p.vc * (tau - t1);
    if (tau > t2) q[axis] += down * (tau - t2) * (tau - t2) / 2;
  }
  return q;
}

}  // namespace mrroc::ecp
