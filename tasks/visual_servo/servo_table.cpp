#include "tasks/visual_servo/servo_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::visual_servo {
namespace {

constexpr double kMm = 1e3;
constexpr double kDegrees = 180 / std::numbers::pi;

bool moves(const ServoRow& row) { return row.v != Vector3::Zero(); }

bool blind(const ServoRow& row) { return !row.sac_seen && !row.eih_seen; }

double angle_of(const Pose& e) { return angle_axis_from_rotation(e.R).norm(); }

/// Remaining displacement, along the axes of the base.
Vector3 to_go(const ServoRow& row) { return row.T_0E.R * row.true_e.p; }

/// Mean over rows that count; nan without any.
template <class Counts, class Value>
double mean(const ServoTable& table, Counts counts, Value value) {
  double sum = 0;
  int n = 0;
  for (const ServoRow& row : table)
    if (counts(row)) {
      sum += value(row);
      ++n;
    }
  return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

double overshoot(const ServoTable& table, std::size_t first) {
  const Vector3 way = to_go(table[first]);
  double beyond = 0;
  for (std::size_t k = first; k < table.size(); ++k)
    beyond = std::max(beyond, -to_go(table[k]).dot(way) / way.squaredNorm());
  return 100 * beyond;
}

/// Control steps until the error that the tool's camera can know stays below 2 mm; nan: it does not.
double steps_to_2mm(const ServoTable& table, std::size_t first) {
  std::size_t k = table.size();
  while (k > first && kMm * table[k - 1].known_e.p.norm() < 2) --k;
  return k == table.size() ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(k - first);
}

/// Greatest way of the set pose in a step, after the arm goes by other cameras than before; nan: it does not.
double camera_change(const ServoTable& table) {
  double greatest = std::numeric_limits<double>::quiet_NaN(), until = -1;
  int used = 0;  // none yet
  for (const ServoRow& row : table) {
    if (row.behaviour == 0) continue;
    if (used != 0 && row.behaviour != used) until = row.t + kChange;
    used = row.behaviour;
    if (row.t < until) greatest = std::fmax(greatest, row.set_step);
  }
  return greatest;
}

void of_rest(const ServoTable& table, mp::Figures& figures) {
  const double end = table.back().t - kEnd;
  const auto last = [&](const ServoRow& row) { return row.t > end; };
  figures["final_err_mm"] = mean(table, last, [](const ServoRow& r) { return kMm * r.known_e.p.norm(); });
  figures["final_err_deg"] =
      mean(table, last, [](const ServoRow& r) { return kDegrees * angle_of(r.known_e); });
  figures["true_err_mm"] = mean(table, last, [](const ServoRow& r) { return kMm * r.true_e.p.norm(); });
  if (std::ranges::any_of(table, moves)) return;
  const auto seen = std::ranges::find_if_not(table, blind);
  const auto first = static_cast<std::size_t>(seen - table.begin());
  figures["overshoot_pct"] = overshoot(table, first);
  figures["steps_to_2mm"] = steps_to_2mm(table, first);
}

void of_motion(const ServoTable& table, mp::Figures& figures) {
  double end = 0;
  for (const ServoRow& row : table)
    if (moves(row)) end = row.t;
  const auto following = [&](const ServoRow& r) { return moves(r) && r.t > end - kFollowing; };
  figures["follow_err_mm"] =
      mean(table, following, [](const ServoRow& r) { return kMm * r.true_e.p.norm(); });
  const Vector3 direction = std::ranges::find_if(table, following)->v.normalized();
  const auto turns = [&](const ServoRow& r) {
    return following(r) && r.v.normalized().dot(direction) < 0.999;
  };
  if (std::ranges::any_of(table, turns)) return;
  figures["line_lag_mm"] =
      mean(table, following, [&](const ServoRow& r) { return kMm * to_go(r).dot(direction); });
}

}  // namespace

void write_servo_table(const std::filesystem::path& file, const ServoTable& table) {
  std::string text = "k,t,behaviour,sac_seen,eih_seen,err_x,err_y,err_z,err_angle,true_err_mm,true_err_deg\n";
  for (const ServoRow& r : table) {
    const std::string e = r.behaviour == 0 ? "nan,nan,nan,nan"
                                           : fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", r.e.p.x(), r.e.p.y(),
                                                         r.e.p.z(), angle_of(r.e));
    const std::string true_e =
        r.object_there ? fmt::format("{:.4f},{:.4f}", kMm * r.true_e.p.norm(), kDegrees * angle_of(r.true_e))
                       : "nan,nan";
    text += fmt::format("{},{:.3f},{},{:d},{:d},{},{}\n", r.k, r.t, r.behaviour, r.sac_seen, r.eih_seen, e,
                        true_e);
  }
  mp::write_text(file, text);
}

mp::Figures figures_of(const ServoTable& table) {
  mp::Figures figures;
  if (table.empty()) return figures;
  figures["unseen_pct"] =
      100. * static_cast<double>(std::ranges::count_if(table, blind)) / static_cast<double>(table.size());
  if (const auto refused = std::ranges::count_if(table, &ServoRow::refused); refused > 0)
    figures["refused_steps"] = static_cast<double>(refused);
  double moved = 0;
  for (const ServoRow& row : table) moved = std::max(moved, (row.T_0E.p - table.front().T_0E.p).norm());
  figures["arm_moved_mm"] = kMm * moved;
  if (std::ranges::all_of(table, blind)) return figures;
  if (const double change = camera_change(table); std::isfinite(change))
    figures["camera_change_mm"] = kMm * change;
  if (std::ranges::any_of(table, moves)) of_motion(table, figures);
  if (table.back().object_there && !moves(table.back())) of_rest(table, figures);
  return figures;
}

}  // namespace mrroc::visual_servo
