#include "tasks/haptic/figures.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::haptic {
namespace {

constexpr double kTouch = 1;    // from this force on the slave has met something [N]
constexpr double kPressed = 3;  // and presses [N]
constexpr double kRest =
    0.0005;  // slower than this an arm rests: the damping of the master takes 0.2 N then [m/s]
constexpr std::size_t kRows =
    150;  // of which the means of the forces are: 0.6 s, in which the noise of friction is gone
constexpr double kBefore = 0.1;  // rows so shortly before a touch do not count as free [s]
constexpr int kFarthest = 25;    // lag that is looked for [macrosteps]
constexpr double kWay = 0.005;   // without such a way in the air there is nothing to follow [m]

using Count = std::ptrdiff_t;

/// @return number of rows before the slave touches
Count free_rows(const HapticRecord& record, double dt) {
  const auto touch =
      std::ranges::find_if(record, [](const HapticRow& row) { return row.F_s.norm() > kTouch; });
  return std::max<Count>(0, touch - record.begin() - std::lround(kBefore / dt));
}

/// @return rms distance of the slave from where the master was some rows before; 0 without rows
double distance(const HapticRecord& record, Count rows, Count shift, double scale) {
  double squares = 0;
  const Count from = kFarthest + std::max<Count>(0, shift);
  for (Count k = from; k < rows - kFarthest; ++k)
    squares +=
        (record[static_cast<std::size_t>(k)].x_s - scale * record[static_cast<std::size_t>(k - shift)].x_m)
            .squaredNorm();
  const Count n = rows - kFarthest - from;
  return n > 0 ? std::sqrt(squares / static_cast<double>(n)) : 0;
}

/// @return where the parabola through three values at -1, 0, 1 has its least
double vertex(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend > 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0;
}

}  // namespace

Following following(const HapticRecord& record, const Law& law) {
  const Count rows = free_rows(record, law.macrostep), delay = std::lround(law.channel.delay / law.macrostep);
  double way = 0;
  for (Count k = 0; k < rows; ++k) way = std::max(way, record[static_cast<std::size_t>(k)].x_m.norm());
  if (way < kWay || rows < 4 * kFarthest + delay) return {NAN, NAN};
  const auto square = [&](Count lag) {
    const double d = distance(record, rows, delay + lag, law.motion_scale);
    return d * d;
  };
  Count best = -kFarthest + 1;
  for (Count lag = best; lag < kFarthest; ++lag)
    if (square(lag) < square(best)) best = lag;
  return {static_cast<double>(best) + vertex(square(best - 1), square(best), square(best + 1)),
          distance(record, rows, delay, law.motion_scale)};
}

double reflection_error(const HapticRecord& record, const Law& law) {
  double error = 0, exerted = 0;
  Vector3 F_m = Vector3::Zero(), F_s = Vector3::Zero();  // sums over the rows of a rest
  for (std::size_t k = 0; k < record.size(); ++k) {
    F_m += record[k].F_m;
    F_s += record[k].F_s;
    if (k < kRows) continue;
    const HapticRow& first = record[k - kRows];
    F_m -= first.F_m;
    F_s -= first.F_s;
    const double way = std::max((record[k].x_m - first.x_m).norm(), (record[k].x_s - first.x_s).norm());
    if (F_s.norm() < kPressed * kRows || way > kRest * law.macrostep * kRows) continue;
    error += (F_m - law.force_scale * F_s).squaredNorm();
    exerted += law.force_scale * law.force_scale * F_s.squaredNorm();
  }
  return exerted > 0 ? 100 * std::sqrt(error / exerted) : NAN;
}

double least_given(const HapticRecord& record, const Law& law) {
  const double scale = law.motion_scale / law.force_scale;
  double given = 0, least = 0;
  for (std::size_t k = 1; k < record.size(); ++k) {
    const HapticRow &row = record[k], &before = record[k - 1];
    given += scale * row.F_m.dot(row.x_m - before.x_m) - row.F_s.dot(row.x_s - before.x_s);
    least = std::min(least, given);
  }
  return least;
}

mp::TaskFigures figures(const HapticRecord& record, const Law& law) {
  const bool good = law.channel.delay == 0 && law.channel.jitter == 0 && law.channel.loss == 0;
  const double any = std::numeric_limits<double>::infinity();
  const Following f = following(record, law);
  double least = record.empty() ? NAN : 0, felt = least, exerted = least, kept = least;
  for (const HapticRow& row : record) {
    least = std::min({least, row.E_m, row.E_s});
    felt = std::max(felt, row.F_m.norm());
    exerted = std::max(exerted, row.F_s.norm());
    kept = row.kept;
  }
  return {
      {{.key = "follow_lag_macrosteps",
        .words = "slave behind the master in the air, beyond the channel's delay",
        .unit = "macrosteps",
        .high = good ? 4 : any},
       f.lag},
      {{.key = "follow_rms_mm", .words = "  their distance, rms", .unit = "mm", .high = good ? 1 : any},
       1e3 * f.rms},
      {{.key = "reflect_err_pct",
        .words = "force felt less force exerted, at rest in contact, rms",
        .unit = "%",
        .high = good ? 5 : any},
       reflection_error(record, law)},
      {{"felt_force_N", "force that the hand feels, largest", "N"}, felt},
      {{"exerted_force_N", "force that the slave exerts, largest", "N"}, exerted},
      {{.key = "energy_min_mJ", .words = "energy of the ports, least", .unit = "mJ", .low = -1}, 1e3 * least},
      {{"given_min_mJ", "  energy that hand and surroundings have given, least", "mJ"},
       record.empty() ? NAN : 1e3 * least_given(record, law)},
      {{"kept_back_mJ", "  energy that the passivity controllers have kept back", "mJ"}, 1e3 * kept}};
}

}  // namespace mrroc::haptic
