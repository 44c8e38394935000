#include "tasks/rubik/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cube/facelets.hpp"
#include "base/representation.hpp"
#include "base/statistics.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kSolution = 5;  // turns from which on their mean is one: the only one may need two re-grasps
constexpr double kHalfWay =
    0.57;  // of a quarter turn: also a face that is behind the tool is nearest to the seat to which it goes
// From its seat, by which the face is drawn in [rad]: as the simulator has it (sim::kDetent), which tasks do
// not know.
constexpr double kDrawnIn = 0.061;

double seconds(std::int64_t macrosteps) { return static_cast<double>(macrosteps) * kPacing.macrostep_s(); }

Pose pose_of(const mp::ArmRow& row) { return pose_from_angle_axis(row.pose); }

/// @return rows of an arm in the macrosteps of one cycle, of behaviour m
mp::ArmTrace part(const mp::ArmTrace& trace, const CycleRecord& entry, std::initializer_list<int> m) {
  mp::ArmTrace rows;
  for (const mp::ArmRow& row : trace)
    if (row.i >= entry.begun && row.i <= entry.ended + 4 && std::ranges::find(m, row.m) != m.end())
      rows.push_back(row);
  return rows;
}

/// Way of the cube in the track arm's jaws. What its arm measures would have in it that the wrist sags, 0.6 mm, and that
/// the hand turns under it.
double slip(const mp::ArmTrace& turning, const CubeRecord& cube) {
  std::optional<Vector3> first;
  double most = 0;
  for (const mp::ArmRow& row : turning) {
    const CubeRow* const c = cube.at(row.i - 1);  // as it was at the macrostep's begin
    if (!c) continue;
    const Vector3& p = c->in_hand[index(Hand::track)];
    if (!first) first = p;
    most = std::max(most, (p - *first).norm());
  }
  return most;
}

/// @return by which the face is behind the tool of the track arm, largest between half of a quarter turn and the seat to
///         which it goes [rad]; of half and three quarter turns the last quarter counts
double behind(const mp::ArmTrace& turning, const CubeRecord& cube) {
  double most = 0, tool = 0;
  for (const mp::ArmRow& row : turning) {
    const CubeRow* const c = cube.at(row.i - 1);
    if (!c) continue;
    tool = angle_about_z(pose_of(turning.front()), pose_of(row), tool);
    const double left = std::abs(c->angle);  // of the face from the nearest seat
    const double quarters = std::abs(tool) / kQuarter;
    const double seat = kQuarter * std::ceil(quarters);
    if (quarters - std::floor(quarters) > kHalfWay && left > kDrawnIn)
      most = std::max(most, std::abs(std::abs(tool) - (seat - left)));
  }
  return most;
}

double largest(const mp::ArmTrace& rows, std::initializer_list<Axis> axes) {
  double most = 0;
  for (const mp::ArmRow& row : rows)
    for (const Axis axis : axes) most = std::max(most, std::abs(row.F[axis]));
  return most;
}

/// @return the largest of the axes' standard deviations
double largest_deviation(const mp::ArmTrace& rows, std::initializer_list<Axis> axes) {
  double most = 0;
  for (const Axis axis : axes) {
    Statistics force;
    for (const mp::ArmRow& row : rows) force.add(row.F[axis]);
    most = std::max(most, force.deviation());
  }
  return most;
}

/// @return share of the turns that needed no second attempt at a grip since the last turn, nor at the turn itself
std::optional<double> first_try_share(const ExecutionLog& log) {
  double turns = 0, at_once = 0;
  bool first = true;
  for (const CycleRecord& entry : log) {
    first &= entry.grips <= 1 && entry.attempts <= 1;
    if (!entry.turn) continue;
    ++turns;
    at_once += first && entry.done;
    first = true;
  }
  return turns > 0 ? std::optional(at_once / turns) : std::nullopt;
}

}  // namespace

TurnRow turn_of(const CycleRecord& entry, int k, const RunRecord& record, const CubeRecord& cube) {
  const mp::ArmTrace turning = part(record.traces[index(Hand::track)], entry, {5});
  TurnRow r;
  r.k = k;
  r.turn = *entry.turn;
  r.t_start = seconds(entry.begun);
  r.t_end = seconds(entry.ended);
  r.attempts = entry.attempts;
  r.tool_deg = kDegrees * entry.tool;
  const CubeRow* const before = cube.at(entry.turn_begun);
  if (const CubeRow* const c = cube.at(entry.turn_ended)) {
    // A face that the pads only slipped over is where it was.
    const bool turned = before && c->facelets != before->facelets;
    const double seat = turned ? kQuarter * std::round(std::abs(entry.tool) / kQuarter) : 0;
    r.face_deg = std::copysign(kDegrees * (seat - std::abs(c->angle)), entry.tool);
  }
  r.behind_deg = kDegrees * behind(turning, cube);
  r.slip_mm = 1e3 * slip(turning, cube);
  r.force_peak_N = largest(turning, {Axis::x, Axis::y, Axis::z});
  r.torque_peak_Nm = largest(turning, {Axis::az});
  r.force_std_N = largest_deviation(turning, {Axis::x, Axis::y, Axis::z});
  return r;
}

std::vector<TurnRow> turns_of(const RunRecord& record, const CubeRecord& cube) {
  std::vector<TurnRow> rows;
  for (const CycleRecord& entry : record.execution_log)
    if (entry.turn) rows.push_back(turn_of(entry, static_cast<int>(rows.size()) + 1, record, cube));
  return rows;
}

void write_turns(const std::filesystem::path& file, const std::vector<TurnRow>& turns) {
  std::string text =
      "k,turn,t_start,t_end,attempts,tool_deg,face_deg,behind_deg,slip_mm,force_peak_N,torque_peak_Nm,force_"
      "std_N\n";
  for (const TurnRow& r : turns)
    text += fmt::format("{},{},{:.2f},{:.2f},{},{:.2f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f}\n", r.k,
                        to_string(r.turn), r.t_start, r.t_end, r.attempts, r.tool_deg, r.face_deg,
                        r.behind_deg, r.slip_mm, r.force_peak_N, r.torque_peak_Nm, r.force_std_N);
  mp::write_text(file, text);
}

mp::Figures figures_of(const RunRecord& record, const CubeRecord& cube, const std::vector<TurnRow>& turns) {
  mp::Figures f;
  double regrasps = 0, retries = 0, given_up = 0;
  double settled = 0, peak = 0;
  int approaches = 0;
  for (const CycleRecord& entry : record.execution_log) {
    if (entry.grips == 0) continue;
    regrasps += !entry.turn;
    given_up += entry.given_up;
    retries += entry.grips - 1 + std::max(0, entry.attempts - 1) + entry.given_up;
    const mp::ArmTrace& worker = record.traces[index(entry.comes)];
    peak = std::max(peak, largest(part(worker, entry, {1, 2}), {Axis::z}));
    const mp::ArmTrace settling = part(worker, entry, {2});
    if (settling.empty()) continue;
    settled += mp::mean_force(settling, Axis::z, 2, 0.25);
    ++approaches;
  }
  const double moves = static_cast<double>(std::ranges::count_if(record.execution_log, &CycleRecord::done));
  f["moves"] = moves;
  f["regrasps"] = regrasps;
  f["retries"] = retries;
  f["other_way"] = given_up;
  if (const auto share = first_try_share(record.execution_log)) f["first_try_share"] = *share;
  if (approaches > 0) {
    f["approach_settled_N"] = settled / approaches;
    f["approach_peak_N"] = peak;
  }
  if (!turns.empty()) {
    const auto most = [&](double TurnRow::*figure) { return std::ranges::max(turns, {}, figure).*figure; };
    f["turn_lateral_peak_N"] = most(&TurnRow::force_peak_N);
    f["turn_lateral_std_N"] = most(&TurnRow::force_std_N);
    f["turn_torque_peak_Nm"] = most(&TurnRow::torque_peak_Nm);
    f["turn_slip_mm"] = most(&TurnRow::slip_mm);
    f["turn_angle_err_deg"] = most(&TurnRow::behind_deg);
    if (moves >= kSolution) f["sim_s_per_turn"] = seconds(record.turning) / moves;
  }
  if (record.verified) f["verified"] = *record.verified ? 1. : 0.;
  if (!cube.rows().empty()) {
    f["squeeze_N"] = std::ranges::max(cube.rows(), {}, &CubeRow::squeeze).squeeze;
    f["solved"] = cube.rows().back().facelets == to_facelets(Cube{}) ? 1. : 0.;
  }
  return f;
}

mp::Figures write_results(const std::filesystem::path& folder, const RunRecord& record,
                          const CubeRecord& cube) {
  const auto turns = turns_of(record, cube);
  write_turns(folder / "moves.csv", turns);
  if (!cube.rows().empty()) {
    mp::write_text(folder / "cube_start.txt", cube.rows().front().facelets + "\n");
    mp::write_text(folder / "cube_end.txt", cube.rows().back().facelets + "\n");
  }
  const auto& all = record.readings;
  if (const auto read = std::ranges::find_if(all, [](const StateReading& r) { return r.cube.has_value(); });
      !all.empty())
    mp::write_text(folder / "cube_read.txt", (read == all.end() ? all.back() : *read).facelets + "\n");
  return figures_of(record, cube, turns);
}

}  // namespace mrroc::rubik
