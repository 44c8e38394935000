#include "tasks/box_push/figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::box_push {
namespace {

/// A box that is slower than this stands [m/s].
constexpr double kStands = 0.01;

double mean_push(const PushTable& table) {
  double sum = 0;
  int n = 0;
  for (const PushRow& row : table) {
    if (std::hypot(row.box.speed[0], row.box.speed[1]) < kStands) continue;
    sum += std::hypot(row.box.push[0], row.box.push[1]);
    ++n;
  }
  return n > 0 ? sum / n : 0;
}

double way_of_box(const PushTable& table) {
  double way = 0;
  for (std::size_t n = 1; n < table.size(); ++n) way += distance(table[n - 1].box.p, table[n].box.p);
  return way;
}

}  // namespace

mp::Figures figures_of(const PushResults& results) {
  mp::Figures figures;
  const PushTable& table = results.table;
  if (table.empty()) return figures;
  const PlanarPose e = seen_from(results.k.goal, table.back().box.p);
  figures["box_err_mm"] = {1e3 * std::hypot(e.x, e.y)};
  figures["box_err_deg"] = {std::abs(e.phi) * 180 / std::numbers::pi};
  figures["pushes"] = {static_cast<double>(table.back().stage.push)};
  figures["push_mean_N"] = {mean_push(table)};
  figures["way_m"] = {way_of_box(table)};
  const auto begun = std::ranges::find_if(table, [](const PushRow& row) { return row.stage.m > 0; });
  figures["run_s"] = {static_cast<double>(table.end() - begun) * results.macrostep};
  return figures;
}

}  // namespace mrroc::box_push
