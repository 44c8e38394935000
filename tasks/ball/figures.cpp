#include "tasks/ball/figures.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mrroc::ball {
namespace {

/// Sums around the circle.
struct Sums {
  double force{}, force_error{}, peak{}, off{}, farthest{}, turned{};
  int rows{};
};

Sums sums_of(const std::vector<BodyRow>& rows, const Parameters& k) {
  Sums s;
  const std::optional<Pose> lifted = lifted_pose(rows);
  for (const BodyRow& row : rows) {
    if (row.m != kCircle) continue;
    const double inner = std::min(row.press[0], row.press[1]);
    ++s.rows;
    s.force += inner;
    s.force_error += (inner - k.force) * (inner - k.force);
    s.peak = std::max({s.peak, row.press[0], row.press[1]});
    const Vector3 way = row.T_UO.p - lifted->p;
    const double off = (way - row.wanted).norm();
    s.off += off * off;
    s.farthest = std::max(s.farthest, off);
    s.turned = std::max(s.turned, angle_axis_from_rotation(lifted->R.transpose() * row.T_UO.R).norm());
  }
  return s;
}

bool fell(const std::vector<BodyRow>& rows) {
  return std::ranges::any_of(
      rows, [](const BodyRow& row) { return row.on_floor || (row.m == kCircle && row.on_pedestal); });
}

}  // namespace

std::optional<Pose> lifted_pose(const std::vector<BodyRow>& rows) {
  const auto first = std::ranges::find(rows, kCircle, &BodyRow::m);
  if (first == rows.end()) return {};
  return Pose{first->T_UO.R, first->T_UO.p - first->wanted - first->yielded};
}

mp::TaskFigures figures(const std::vector<BodyRow>& rows, const Parameters& k, bool pushed) {
  const Sums s = sums_of(rows, k);
  const double n = s.rows > 0 ? static_cast<double>(s.rows) : std::nan("");
  const auto rms = [&](double squares) { return std::sqrt(squares / n); };
  const double any = n / n;
  mp::TaskFigures all{
      {{"inner_force_N", "inner force around the circle, mean", "N", k.force - 0.5, k.force + 0.5},
       s.force / n},
      {{"inner_force_rms_N", "  off what is wanted", "N rms"}, rms(s.force_error)},
      {{"inner_force_peak_N", "  largest of a palm", "N"}, any * s.peak},
      {{"turned_deg", "the object turned between the palms, largest", "deg"}, any * s.turned * 180 / M_PI},
  };
  if (pushed) {
    all.push_back({{"yielded_mm", "arms and object yielded to the hand", "mm"}, any * 1e3 * s.farthest});
  } else {
    all.push_back({{.key = "circle_rms_mm", .words = "object off the circle", .unit = "mm rms", .high = 2},
                   1e3 * rms(s.off)});
    all.push_back({{"circle_max_mm", "  largest", "mm"}, any * 1e3 * s.farthest});
  }
  all.push_back({{.key = "falls", .words = "falls of the object", .unit = "", .high = 0, .always = true},
                 fell(rows) ? 1.0 : 0.0});
  return all;
}

}  // namespace mrroc::ball
