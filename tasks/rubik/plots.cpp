#include "tasks/rubik/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/latency.hpp"
#include "base/time_chart.hpp"
#include "mp/behaviour_bands.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/coordinator.hpp"

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

Rows during(const Rows& trace, const CycleRecord& entry) {
  Rows rows;
  std::ranges::copy_if(trace, std::back_inserter(rows), [&](const auto& r) {
    return r.i >= entry.begun && r.i <= entry.ended + latency::kLoop;
  });
  return rows;
}

std::string name_of(int m) {
  const auto row = std::ranges::find(kCycle, m, &Motion<Coordinator>::m);
  return row == kCycle.end() ? "" : std::string(row->name);
}

/// Meaning of the letters of a figure.
const std::map<char, std::string> kApproachWords{{'A', "free motion ends, impact"},
                                                 {'B', "the force has settled"}};
const std::map<char, std::string> kTurnWords{{'A', "the grasp begins"},
                                             {'B', "the jaws hold"},
                                             {'C', "the turn begins"},
                                             {'D', "the face breaks away"},
                                             {'E', "friction at its largest behind it"},
                                             {'F', "friction at its least"},
                                             {'G', "the turn ends"},
                                             {'H', "the jaws have opened"}};

/// A force of one arm over time with its marked points.
struct Figure {
  std::string name, title;
  std::string panel, y_label;
  std::string arm;  // its key
  Axis axis{};
};

std::string script(const Figure& f, const Rows& shown, const std::vector<Mark>& marks,
                   const std::map<char, std::string>& words) {
  ChartPanel panel{.title = f.panel, .y_label = f.y_label, .height = 380};
  panel.bands = mp::behaviour_bands(shown, name_of);
  panel.curves = {
      {.source = fmt::format("'{}.csv' skip 1 using 2:{}", f.arm, kForce + static_cast<int>(f.axis)),
       .colour = std::string(curve_colour(0))}};
  for (const mp::ArmRow& r : shown) panel.y.add(r.F[f.axis]);
  panel.y = panel.y.with_room(0.06, 0.12);
  for (const Mark& m : marks) panel.marks.push_back({std::string(1, m.letter), m.t, m.y, words.at(m.letter)});
  return time_chart_script({.output = "plots/" + f.name + ".png",
                            .title = f.title,
                            .from = shown.front().t,
                            .to = shown.back().t + kAfter,
                            .panels = {panel}});
}

/// Largest force and torque of every turn, from moves.csv, a bar each.
std::string turns_script(std::size_t turns) {
  std::string text = gnuplot_head("plots/turns.png", 1200, 640);
  text += fmt::format(
      "set datafile columnheaders\nset style fill solid 0.85 noborder\nset boxwidth 0.6\nunset key\n"
      "set xrange [0.4:{}]\nset yrange [0:*]\nset xtics scale 0\n"
      "set multiplot layout 2,1 title 'rubik: what the turns took' font 'sans:Bold,15' textcolor rgb "
      "'#1b2a41'\n",
      static_cast<double>(turns) + 0.6);
  const auto panel = [&](const char* title, const char* y_label, const char* column, std::size_t colour) {
    text += fmt::format(
        "set title '{}' font 'sans:Bold,11'\nset ylabel '{}'\n"
        "plot 'moves.csv' using 1:'{}':xtic(2) with boxes lc rgb '{}'\n",
        title, y_label, column, curve_colour(colour));
  };
  panel("largest force along x, y or z", "force [N]", "force_peak_N", 0);
  text += "set xlabel 'turn'\n";
  panel("largest torque about the axis of the face", "torque [N m]", "torque_peak_Nm", 1);
  return text + "unset multiplot\n";
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
  const auto done = [](const CycleRecord& n) { return n.turn && n.done && n.ended > 0; };
  auto entry = std::ranges::find_if(
      record.execution_log, [&](const CycleRecord& n) { return done(n) && n.turn->quarters() != kHalfTurn; });
  if (entry == record.execution_log.end()) entry = std::ranges::find_if(record.execution_log, done);
  if (entry == record.execution_log.end()) return all;
  const Rows worker = during(record.traces[index(entry->comes)], *entry);
  const Rows turning = during(record.traces[index(Hand::track)], *entry);
  Rows approach = of(worker, 1);
  const Rows settling = of(worker, 2);
  approach.insert(approach.end(), settling.begin(), settling.end());
  const std::string turned = to_string(*entry->turn);
  if (!approach.empty())
    all.emplace_back("fig16_approach",
                     script({.name = "fig16_approach",
                             .title = "MG fig. 16: the worker comes to the cube",
                             .panel = fmt::format("{}, before turn {}", kArmKeys[index(entry->comes)],
                                                  gnuplot_literal(turned)),
                             .y_label = "F_z of the worker [N]",
                             .arm = kArmKeys[index(entry->comes)],
                             .axis = Axis::z},
                            approach, marks_of_approach(worker), kApproachWords));
  Rows cycle;
  std::ranges::copy_if(turning, std::back_inserter(cycle),
                       [](const auto& r) { return r.m >= 3 && r.m <= 6; });
  if (!cycle.empty())
    all.emplace_back(
        "fig17_turn",
        script({.name = "fig17_turn",
                .title = "MG fig. 17: the turn of a face",
                .panel = fmt::format("{}, turn {}", kArmKeys[index(Hand::track)], gnuplot_literal(turned)),
                .y_label = "torque about the axis of the face [N m]",
                .arm = kArmKeys[index(Hand::track)],
                .axis = Axis::az},
               cycle, marks_of_turn(turning, entry->turn->quarters() == kHalfTurn ? 2 : 1), kTurnWords));
  all.emplace_back("turns",
                   turns_script(static_cast<std::size_t>(std::ranges::count_if(record.execution_log, done))));
  return all;
}

}  // namespace mrroc::rubik
