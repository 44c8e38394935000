#include "tasks/move/figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tasks/move/agent.hpp"

namespace mrroc::any_motion {
namespace {

int number_of(Row r) { return row(r).m; }

bool keeps_to_its_way(const PlannedMotion& m) { return m.spec.contact.empty(); }

PoseError error_of(const Pose& measured, const Pose& wanted) {
  return {1e3 * (measured.p - wanted.p).norm(),
          180 / std::numbers::pi * angle_axis_from_rotation(wanted.R.transpose() * measured.R).norm()};
}

double distance_to_line(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 d = b - a;
  const double length = d.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0;
  return (p - a - share * d).norm();
}

/// The arm is behind its set points by less than this [macrosteps].
constexpr std::int64_t kLag = 12;

double distance_to_way(const Vector3& p, const std::vector<Pose>& way, std::int64_t k) {
  const auto last = static_cast<std::int64_t>(way.size()) - 1;
  double least = INFINITY;
  for (std::int64_t j = std::clamp<std::int64_t>(k - kLag, 0, last);
       j <= std::clamp<std::int64_t>(k, 0, last); ++j) {
    const auto here = static_cast<std::size_t>(j);
    const std::size_t next = std::min(here + 1, way.size() - 1);
    least = std::min(least, distance_to_line(p, way[here].p, way[next].p));
  }
  return least;
}

}  // namespace

std::vector<Stretch> stretches_of(const mp::ArmTrace& trace, int m) {
  std::vector<Stretch> found;
  for (std::size_t k = 0; k < trace.size(); ++k) {
    if (trace[k].m != m) continue;
    if (k == 0 || trace[k - 1].m != m) found.push_back({k, k});
    found.back().last = k;
  }
  return found;
}

std::vector<PoseError> goal_errors(const mp::ArmTrace& trace, const ArmPlan& plan) {
  std::vector<PoseError> errors;
  const std::vector<Stretch> rests = stretches_of(trace, number_of(Row::rest));
  for (std::size_t k = 0; k + 1 < rests.size() && k < plan.motions.size();
       ++k)  // the first one is at the start
    if (keeps_to_its_way(plan.motions[k]))
      errors.push_back(
          error_of(pose_from_angle_axis(trace[rests[k + 1].last].pose), plan.motions[k].poses.back()));
  return errors;
}

double path_error_mm(const mp::ArmTrace& trace, const ArmPlan& plan) {
  const std::vector<Stretch> moves = stretches_of(trace, number_of(Row::move));
  double most = NAN;
  for (std::size_t k = 0; k < moves.size() && k < plan.motions.size(); ++k) {
    if (!keeps_to_its_way(plan.motions[k])) continue;
    for (std::size_t j = moves[k].first; j <= moves[k].last; ++j)
      most = std::fmax(most, 1e3 * distance_to_way(trace[j].pose.head<3>(), plan.motions[k].poses,
                                                   static_cast<std::int64_t>(j - moves[k].first)));
  }
  return most;
}

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Plan& plan) {
  std::vector<double> mm, deg, way, speed, acceleration, time;
  for (std::size_t arm = 0; arm < plan.arms.size(); ++arm) {
    const ArmPlan& p = plan.arms[arm];
    if (p.motions.empty()) continue;  // it has no figures
    double most_mm = NAN, most_deg = NAN, v = 0, a = 0, T = 0;
    for (const PoseError& e : goal_errors(arms[arm], p)) {
      most_mm = std::fmax(most_mm, e.mm);
      most_deg = std::fmax(most_deg, e.deg);
    }
    for (const PlannedMotion& m : p.motions) {
      v = std::max(v, largest(m.rates.velocity));
      a = std::max(a, largest(m.rates.acceleration));
      T += static_cast<double>(m.path.macrosteps()) * kPacing.macrostep_s();
    }
    mm.push_back(most_mm);
    deg.push_back(most_deg);
    way.push_back(path_error_mm(arms[arm], p));
    speed.push_back(100 * v);
    acceleration.push_back(100 * a);
    time.push_back(T);
  }
  if (mm.empty()) return {};
  return {
      {{.key = "goal_error_mm", .words = "error at the ends of motions, largest", .unit = "mm", .high = 0.1},
       mm},
      {{"goal_error_deg", "  of the orientation", "deg"}, deg},
      {{"path_error_mm", "distance from the way of the set points, largest", "mm"}, way},
      {{.key = "speed_pct",
        .words = "speed of the set points, largest share of the limit",
        .unit = "%",
        .high = 100},
       speed},
      {{.key = "acceleration_pct", .words = "  their acceleration", .unit = "%", .high = 100}, acceleration},
      {{"motion_s", "time of the motions", "s"}, time}};
}

}  // namespace mrroc::any_motion
