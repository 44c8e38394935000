#include "tasks/rex_drive/figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "base/latency.hpp"
#include "base/statistics.hpp"
#include "tasks/rex_drive/odometry_figures.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr double kMm = 1e3;
constexpr double kMoves = 0.1;          // [m/s], from which on a joint is passed at speed
constexpr double kFrictionKnown = 0.1;  // standard deviation up to which an estimate of friction is one
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

bool drives(const DriveRow& row) { return row.executing > 0; }

/// Root of the mean square, over rows that count; nothing without any.
template <class Counts, class Value>
std::optional<double> rms(const DriveTable& table, Counts counts, Value value) {
  double sum = 0;
  int n = 0;
  for (const DriveRow& row : table)
    if (counts(row)) {
      sum += value(row) * value(row);
      ++n;
    }
  return n > 0 ? std::optional(std::sqrt(sum / n)) : std::nullopt;
}

void set(mp::Figures& figures, const char* key, const std::optional<double>& value) {
  if (value && std::isfinite(*value)) figures[key] = *value;
}

/// Whether the true place is within the 95 % ellipse of the estimate.
bool within_ellipse(const DriveRow& row) {
  constexpr double kChiSquared = 5.991;
  const double x = row.truth.p.x - row.estimate.p.x, y = row.truth.p.y - row.estimate.p.y;
  const auto& P = row.estimate.covariance;
  const double determinant = P[0] * P[4] - P[1] * P[3];
  return determinant > 0 &&
         (P[4] * x * x - (P[1] + P[3]) * x * y + P[0] * y * y) / determinant <= kChiSquared;
}

void of_place(const DriveResults& r, mp::Figures& figures) {
  double most = 0, most_estimate = 0, within = 0, n = 0;
  for (const DriveRow& row : r.table) {
    if (!drives(row)) continue;
    most = std::max(most, tracking_error(row));
    most_estimate = std::max(most_estimate, estimation_error(row));
    within += within_ellipse(row) ? 1 : 0;
    ++n;
  }
  if (n == 0) return;
  figures["track_max_mm"] = kMm * most;
  figures["estimate_max_mm"] = kMm * most_estimate;
  figures["ellipse_95_pct"] = 100 * within / n;
  figures["track_rms_mm"] = kMm * *rms(r.table, drives, tracking_error);
  figures["estimate_rms_mm"] = kMm * *rms(r.table, drives, estimation_error);
  const auto turns = [&](const DriveRow& row) {
    const auto executed = [&](const FragmentRow& f) { return f.fragment.number == row.executing; };
    const auto f = std::ranges::find_if(r.fragments, executed);
    return f != r.fragments.end() && is_pivot(f->fragment);
  };
  if (const auto pivot = rms(r.table, turns, tracking_error)) figures["pivot_rms_mm"] = kMm * *pivot;
}

/// From the end of the way to where the platform is when everything has ended [m].
std::optional<double> end_error(const DriveResults& r) {
  if (r.acked_in == 0 || r.table.empty() || r.fragments.empty()) return {};
  const PlanarPose &end = r.fragments.back().fragment.knot.back().p, &is = r.table.back().truth.p;
  return std::hypot(is.x - end.x, is.y - end.y);
}

/// By how much the speed departs from the planned one within 0.2 s after a position that comes back has got to the driver [m/s].
std::optional<double> kick_of_return(const DriveResults& r) {
  constexpr double kLasts = 0.2, kHalf = kPlatformPeriod / 2;
  constexpr double kReaches =
      kPlatformPeriod * static_cast<double>(latency::kMessage + latency::kCommandToMotion);
  const auto surplus = [&r](std::size_t k) {
    const PlanarPose &a = r.table[k - 1].reference, &b = r.table[k].reference;
    const PlanarVelocity& v = r.table[k].truth.v;
    const double passed = r.table[k].t - r.table[k - 1].t;
    return std::hypot(v.vx, v.vy) - std::hypot(b.x - a.x, b.y - a.y) / passed;
  };
  std::optional<double> most;
  for (const double t : r.map_returns) {
    std::optional<double> before;
    for (std::size_t k = 1; k < r.table.size() && r.table[k].t < t + kReaches + kLasts + kHalf; ++k) {
      if (r.table[k].t < t - kHalf || !drives(r.table[k]) || !drives(r.table[k - 1])) continue;
      if (!before) before = surplus(k);
      most = std::max(most.value_or(0), std::abs(surplus(k) - *before));
    }
  }
  return most;
}

void of_friction(const DriveTable& table, mp::Figures& figures) {
  Statistics mu_x, mu_y, split, true_mu_x, true_mu_y, true_split, split_square, sd, split_sd;
  const auto first = std::ranges::find_if(table, drives);
  const auto half = first + (table.end() - first) / 2;
  if (half == table.end()) return;
  for (auto row = half; row != table.end(); ++row) {
    if (!drives(*row)) continue;
    const Slip is = true_slip(row->truth);
    mu_x.add(row->slip.mu_x);
    mu_y.add(row->slip.mu_y);
    split.add(row->slip.split);
    true_split.add(is.split);
    split_square.add(std::pow(row->slip.split - is.split, 2));
    true_mu_x.add(is.mu_x);
    true_mu_y.add(is.mu_y);
    sd.add(std::max(row->slip_sd.mu_x, row->slip_sd.mu_y));
    split_sd.add(row->slip_sd.split);
  }
  const auto tell = [&figures](const char* key, double error, const Statistics& deviation) {
    if (std::isfinite(error)) figures[key] = deviation.mean() > kFrictionKnown ? kNotMeasured : error;
  };
  tell("friction_err",
       std::max(std::abs(mu_x.mean() - true_mu_x.mean()), std::abs(mu_y.mean() - true_mu_y.mean())), sd);
  tell("split_err", std::abs(split.mean() - true_split.mean()), split_sd);
  tell("split_rms", std::sqrt(split_square.mean()), split_sd);
}

/// Whether the ground changes by a quarter between two rows.
bool ground_changes(const DriveRow& before, const DriveRow& after) {
  constexpr double kChange = 0.25;
  const Slip was = true_slip(before.truth), is = true_slip(after.truth);
  return std::abs(is.mu_x - was.mu_x) > kChange * was.mu_x ||
         std::abs(is.mu_y - was.mu_y) > kChange * was.mu_y || std::abs(is.split - was.split) > kChange;
}

/// Whether the estimate of the slip is within a tenth of what is true.
bool slip_is_found(const DriveRow& row) {
  constexpr double kNear = 0.1;
  const Slip is = true_slip(row.truth);
  return std::abs(row.slip.mu_x - is.mu_x) <= kNear * is.mu_x &&
         std::abs(row.slip.mu_y - is.mu_y) <= kNear * is.mu_y && std::abs(row.slip.split - is.split) <= kNear;
}

/// Time from the first large change of the ground until the estimate is near what is true, and stays so for a second, or to
/// the next large change or the end of the drive [s]; nothing when it does not.
std::optional<double> friction_found(const DriveTable& table) {
  constexpr double kStays = 1;
  const auto before = std::ranges::adjacent_find(table, ground_changes);
  if (before == table.end()) return {};
  const auto begin = before + 1;
  auto end = std::adjacent_find(begin, table.end(), ground_changes);
  if (end != table.end()) ++end;
  std::optional<double> found;
  for (auto row = begin; row != end && !(found && row->t - *found >= kStays); ++row) {
    if (!drives(*row)) continue;
    if (!slip_is_found(*row))
      found.reset();
    else if (!found)
      found = row->t;
  }
  if (found) *found -= begin->t;
  return found;
}

/// Whether the platform was told to be slower than planned shortly before that time [s].
/// @param v  planned speed then [m/s]
bool is_slowed(const DriveTable& table, double t, double v) {
  // From the end of a pause the driver goes to full pace as quickly as it may. The speed is the planned one a second later.
  constexpr double kQuickest = kPlatformPeriod / kPaceChange, kSettles = 1;
  const double from = t - std::max(kQuickest, v / kPaceAcceleration) - kSettles;
  const auto slows = [t, from](const DriveRow& row) { return row.t <= t && row.t > from && row.pace < 1; };
  return std::ranges::any_of(table, slows);
}

/// A joint near a pause is not judged: the pause slows the platform, not the joint.
void of_joints(const DriveResults& r, mp::Figures& figures) {
  const std::vector<Stay> times = stays(r.fragments, r.table);
  std::optional<double> least, least_of_plans;
  const auto take = [](std::optional<double>& kept, double share) {
    if (std::isfinite(share)) kept = std::min(kept.value_or(share), share);
  };
  for (std::size_t k = 0; k + 1 < r.fragments.size(); ++k) {
    const double planned = r.fragments[k].fragment.knot.back().v;
    if (planned <= kMoves || is_slowed(r.table, times[k].ended, planned)) continue;
    const double share = 100 * times[k].speed / planned;
    take(least, share);
    if (r.fragments[k].plan != r.fragments[k + 1].plan) take(least_of_plans, share);
  }
  set(figures, "joint_speed_pct", least);
  set(figures, "plan_joint_speed_pct", least_of_plans);
}

/// From the last ack until the platform stands at the end of everything [s].
std::optional<double> ack_before_rest(const DriveResults& r) {
  if (r.acked_in == 0 || r.table.empty()) return {};
  const auto last = std::ranges::find_if(r.table.rbegin(), r.table.rend(), drives);
  const auto rest = std::find_if(last.base(), r.table.end(), [](const DriveRow& row) { return row.at_rest; });
  if (rest == r.table.end()) return {};
  return rest->t - static_cast<double>(r.acked_in) * kPlatformPeriod;
}

void of_way(const DriveTable& table, mp::Figures& figures) {
  Statistics speed;
  double way = 0;
  for (std::size_t k = 1; k < table.size(); ++k) {
    if (!drives(table[k])) continue;
    const PlanarPose &a = table[k - 1].truth.p, &b = table[k].truth.p;
    speed.add(std::abs(table[k].truth.v.vx));
    way += std::hypot(b.x - a.x, b.y - a.y);
  }
  const auto n = static_cast<double>(std::ranges::count_if(table, drives));
  if (n < 2) return;
  figures["speed_mean_mps"] = speed.mean();
  figures["speed_max_mps"] = speed.most();
  figures["way_m"] = way;
  figures["drive_s"] = n * kPlatformPeriod;
}

void of_counts(const DriveResults& r, mp::Figures& figures) {
  figures["map_rejected"] = static_cast<double>(r.rejected);
  if (!r.table.empty()) figures["solver_failures"] = static_cast<double>(r.table.back().solver_failures);
  // A position from before the estimator began may come when it works: that is no late one of the drive.
  if (const auto first = std::ranges::find_if(r.table, drives); first != r.table.end()) {
    figures["late_map"] = static_cast<double>(r.table.back().late_map - first->late_map);
    if (!r.odometry.empty())
      figures["late_odometry"] = static_cast<double>(r.table.back().late_odometry - first->late_odometry);
  }
  std::vector<std::int32_t> sorted = r.iterations;
  std::ranges::sort(sorted);
  if (!sorted.empty())
    figures["planner_iterations_p95"] = static_cast<double>(sorted[sorted.size() * 95 / 100]);
}

/// What is wanted of a figure at most.
struct Most {
  std::string_view key;
  double high;
};

std::vector<Most> wanted_of(DriveCase drive) {
  switch (drive) {
    case DriveCase::fast:
      return {{"track_rms_mm", 15}, {"track_max_mm", 100}};
    case DriveCase::slippery:
    case DriveCase::ice_right:
      return {{"track_rms_mm", 15}};
    case DriveCase::smooth:
      return {{"friction_err", 0.02}, {"split_err", 0.02}};
    case DriveCase::usual:
    case DriveCase::own_plan:
    case DriveCase::other:
      break;
  }
  return {};
}

/// Whether something is wanted of the figure in every drive.
bool is_of_every_drive(std::string_view key) {
  return key == "planner_iterations_p95" || key == "solver_failures";
}

/// Whether the figure depends on the lengths of a plan's legs.
bool is_of_joints(std::string_view key) {
  return key == "joint_speed_pct" || key == "plan_joint_speed_pct" || key == "ack_before_rest_s";
}

}  // namespace

std::vector<mp::FigureInfo> figures_of_case(DriveCase drive) {
  std::vector<mp::FigureInfo> infos(kFigures.begin(), kFigures.end());
  if (drive == DriveCase::usual) return infos;
  for (mp::FigureInfo& info : infos) {
    const bool kept = drive == DriveCase::own_plan ? !is_of_joints(info.key) : is_of_every_drive(info.key);
    if (!kept) info = {.key = info.key, .words = info.words, .unit = info.unit, .always = info.always};
  }
  for (const Most& most : wanted_of(drive))
    std::ranges::find(infos, most.key, &mp::FigureInfo::key)->high = most.high;
  return infos;
}

std::string wanted_only(DriveCase drive) {
  if (drive != DriveCase::other) return {};
  return "nothing is wanted of this drive but few iterations of the planner and no failure of a solver";
}

mp::Figures figures_of(const DriveResults& results) {
  mp::Figures figures;
  of_place(results, figures);
  if (const auto error = end_error(results)) figures["end_error_mm"] = kMm * *error;
  set(figures, "return_kick_mps", kick_of_return(results));
  of_friction(results.table, figures);
  set(figures, "friction_found_s", friction_found(results.table));
  of_joints(results, figures);
  set(figures, "ack_before_rest_s", ack_before_rest(results));
  of_way(results.table, figures);
  of_counts(results, figures);
  figures.merge(odometry_figures(results.odometry));
  return figures;
}

}  // namespace mrroc::rex_drive
