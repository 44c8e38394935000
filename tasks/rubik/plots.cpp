#include "tasks/rubik/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tasks/rubik/config.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kForce = 10;      // column of F_x in arm1.csv
constexpr double kAfter = 0.4;  // shown behind the behaviours [s]

constexpr int kHalfTurn = 2;  // quarters
using Rows = mp::ArmTrace;

Rows of(const Rows& trace, int m) {
  Rows rows;
  std::ranges::copy_if(trace, std::back_inserter(rows), [m](const auto& r) { return r.m == m; });
  return rows;
}

Rows during(const Rows& trace, const CycleNote& note) {
  Rows rows;
  std::ranges::copy_if(trace, std::back_inserter(rows),
                       [&](const auto& r) { return r.i >= note.begun && r.i <= note.ended + 4; });
  return rows;
}

std::string script(const std::string& table, Axis axis, const Rows& shown, const std::vector<Mark>& marks,
                   const char* what) {
  std::string text =
      fmt::format("set xlabel 'step of 2 ms'\nset ylabel '{}'\nset key off\nset xrange [{:.0f}:{:.0f}]\n",
                  what, shown.front().t / kPacing.dt, (shown.back().t + kAfter) / kPacing.dt);
  for (const Mark& m : marks)
    text += fmt::format(
        "set label '{}' at {:.0f},{:.4f} point pt 7 ps 0.9 lc rgb '#b3541e' offset character 0.6,0.6 front\n",
        m.letter, m.t / kPacing.dt, m.y);
  return text + fmt::format("plot '{}' skip 1 using ($2/{}):{} with lines lw 1.6 lc rgb '#1f5fa8'\n", table,
                            kPacing.dt, kForce + static_cast<int>(axis));
}

}  // namespace

std::vector<Mark> marks_of_approach(const Rows& worker) {
  const Rows approach = of(worker, 1), settling = of(worker, 2);
  std::vector<Mark> marks;
  // The last row before the force begins to rise for good.
  const auto free = std::ranges::find_if(approach.rbegin(), approach.rend(),
                                         [](const auto& r) { return r.F[Axis::z] < 0.5; });
  if (free != approach.rend()) marks.push_back({'A', free->t, free->F[Axis::z]});
  const auto settled = std::ranges::find_if(settling, [&](const auto& r) {
    return std::all_of(&r, &settling.back() + 1,
                       [](const auto& s) { return std::abs(s.F[Axis::z] - 4) < 1; });
  });
  if (settled != settling.end()) marks.push_back({'B', settled->t, settled->F[Axis::z]});
  return marks;
}

std::vector<Mark> marks_of_turn(const Rows& turning, int quarters) {
  std::vector<Mark> marks;
  const auto mark = [&](char letter, const mp::ArmRow& r) { marks.push_back({letter, r.t, r.F[Axis::az]}); };
  const auto size = [](const mp::ArmRow& r) { return std::abs(r.F[Axis::az]); };
  if (const Rows grasp = of(turning, 3); !grasp.empty()) mark('A', grasp.front());
  if (const Rows held = of(turning, 4); !held.empty()) mark('B', held.back());
  if (const Rows turn = of(turning, 5); turn.size() > 10) {
    mark('C', turn.front());
    const double quarter = static_cast<double>(turn.size()) / quarters;
    const auto half = turn.begin() + static_cast<std::ptrdiff_t>(quarter / 2);
    const auto broken = std::ranges::max_element(turn.begin(), half, {}, size);
    mark('D', *broken);
    const auto dropped = std::ranges::min_element(broken, half, {}, size);
    const auto seat = turn.begin() + static_cast<std::ptrdiff_t>(0.85 * quarter);
    const auto most = std::ranges::max_element(dropped, seat, {}, size);
    mark('E', *most);
    mark('F', *std::ranges::min_element(most, seat, {}, size));
    mark('G', turn.back());
  }
  if (const Rows open = of(turning, 6); !open.empty()) mark('H', open.back());
  return marks;
}

std::vector<std::pair<std::string, std::string>> plots(const RunRecord& record) {
  std::vector<std::pair<std::string, std::string>> all;
  const auto done = [](const CycleNote& n) { return n.turn && n.done && n.ended > 0; };
  auto note = std::ranges::find_if(
      record.journal, [&](const CycleNote& n) { return done(n) && n.turn->quarters() != kHalfTurn; });
  if (note == record.journal.end()) note = std::ranges::find_if(record.journal, done);
  if (note == record.journal.end()) return all;
  const Rows worker = during(record.traces[index(note->comes)], *note);
  const Rows turning = during(record.traces[index(Hand::track)], *note);
  Rows approach = of(worker, 1);
  const Rows settling = of(worker, 2);
  approach.insert(approach.end(), settling.begin(), settling.end());
  if (!approach.empty())
    all.emplace_back("fig16_approach", script(kArmKeys[index(note->comes)] + ".csv", Axis::z, approach,
                                              marks_of_approach(worker), "F_z of the worker [N]"));
  Rows cycle;
  std::ranges::copy_if(turning, std::back_inserter(cycle),
                       [](const auto& r) { return r.m >= 3 && r.m <= 6; });
  if (!cycle.empty())
    all.emplace_back("fig17_turn", script(kArmKeys[index(Hand::track)] + ".csv", Axis::az, cycle,
                                          marks_of_turn(turning, note->turn->quarters() == kHalfTurn ? 2 : 1),
                                          "torque about the axis of the face [N m]"));
  all.emplace_back(
      "turns",
      "set xlabel 'turn'\nset ylabel '[N], [N m]'\nset key outside top right\nset yrange [0:*]\nset xrange "
      "[0.5:*]\n"
      "set style data linespoints\n"
      "set datafile columnheaders\nplot 'moves.csv' using 1:'force_peak_N':xtic(2) pt 7 lc rgb '#1f5fa8' "
      "title 'largest force x, y, z', "
      "'moves.csv' using 1:'torque_peak_Nm' pt 7 lc rgb '#b3541e' title 'largest torque about z'\n");
  return all;
}

}  // namespace mrroc::rubik
