#include "tasks/box_push/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/room_plot.hpp"
#include "base/time_chart.hpp"
#include "tasks/box_push/detour.hpp"

namespace mrroc::box_push {
namespace {

constexpr double kBeside = 0.15;  // of a number from the middle of the box [m]
constexpr const char* kFile = "'box.csv' skip 1 using ";

std::string name_of(int m) {
  for (const Motion<Coordinator>* motion : {&kStart, &kLook, &kApproach, &kPush, &kRetreat})
    if (motion->m == m) return std::string(motion->name);
  return {};
}

ChartCurve curve(const std::string& columns, const char* title, std::size_t colour) {
  return {.source = kFile + columns, .title = title, .colour = std::string(curve_colour(colour))};
}

std::string push_script(const PushResults& r) {
  const auto time = [&](const PushRow& row) {
    return static_cast<double>(row.stage.macrostep) * r.macrostep;
  };
  TimeChart c{.output = "plots/push.png", .title = "Two platforms push a box"};
  c.from = time(r.table.front());
  c.to = std::max(c.from + 1, time(r.table.back()));
  const auto bands = time_bands(
      r.table, time, [](const PushRow& row) { return row.stage.m; }, name_of);
  ChartPanel error{.title = "distance of the box from its goal", .y_label = "[mm]", .bands = bands};
  error.curves = {curve(fmt::format("1:{}", +column::error), "", 0)};
  ChartPanel turned{.title = "turn of the box from its goal", .y_label = "[degrees]"};
  turned.curves = {curve(fmt::format("1:{}", column::error + 1), "", 1)};
  ChartPanel force{.title = "force of both platforms on the box", .y_label = "[N]"};
  force.curves = {curve(fmt::format("1:{}", +column::box_push), "along x of the box", 0),
                  curve(fmt::format("1:{}", column::box_push + 1), "along y of the box", 1)};
  c.panels = {error, turned, force};
  c.notes = {
      "Of every macrostep the force of its last step of 2 ms: single peaks are blows of noses that come down "
      "on the box anew."};
  return time_chart_script(c);
}

/// Outlines as a data block, one below the other.
std::string outlines(const char* name, const std::vector<Obstacle>& all) {
  std::string data = fmt::format("${} << EOD\n", name);
  for (const Obstacle& each : all) {
    for (std::size_t k = 0; k <= each.corner.size(); ++k) {
      const RoomPoint& p = each.corner[k % each.corner.size()];
      data += fmt::format("{:.4f},{:.4f}\n", p[0], p[1]);
    }
    data += "\n";
  }
  return data + "NaN,NaN\nEOD\n";
}

/// The box where it began, came to rest after each push, and ended.
std::string box_outlines(const PushResults& r) {
  const Formation& f = r.k.hall.formation;
  std::vector<Obstacle> all{rectangle(r.table.front().box.p, f.box_length, f.box_width)};
  for (std::size_t n = 1; n < r.table.size(); ++n)
    if (r.table[n - 1].stage.m == kPush.m && r.table[n].stage.m != kPush.m)
      all.push_back(rectangle(r.table[n].box.p, f.box_length, f.box_width));
  all.push_back(rectangle(r.table.back().box.p, f.box_length, f.box_width));
  return outlines("box", all);
}

/// The platforms where pushes begin and end.
std::string platform_outlines(const PushResults& r, std::size_t k) {
  const Formation& f = r.k.hall.formation;
  std::vector<Obstacle> all;
  for (std::size_t n = 1; n < r.table.size(); ++n)
    if ((r.table[n - 1].stage.m == kPush.m) != (r.table[n].stage.m == kPush.m))
      all.push_back(rectangle(r.table[n].platform[k], f.platform_length, f.platform_width));
  return outlines(fmt::format("platform{}", k + 1).c_str(), all);
}

/// The number of each push where the box stands when it begins, beside the box's middle.
std::string push_numbers(const PushResults& r) {
  std::string s;
  for (std::size_t n = 1; n < r.table.size(); ++n) {
    const PushRow& row = r.table[n];
    if (row.stage.m == kPush.m && r.table[n - 1].stage.m != kPush.m)
      s += fmt::format("set label '{}' at {:.4f},{:.4f} center font 'sans:Bold,12' front\n", row.stage.push,
                       row.box.p.x, row.box.p.y + kBeside);
  }
  return s;
}

std::string obstacle_key(const Room& room) {
  if (room.obstacles.empty()) return {};
  return fmt::format("keyentry with boxes fillstyle solid 1 fillcolor rgb '{}' title 'obstacle', ",
                     kObstacleColour);
}

std::string path_script(const PushResults& r) {
  const Formation& f = r.k.hall.formation;
  std::string s = gnuplot_head("plots/path.png", 1000, 820);
  s += "set title 'Two platforms push a box, seen from above' font 'sans:Bold,14' textcolor rgb '#1b2a41'\n"
       "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset key below\n";
  s += plot_room(r.k.hall.room) + push_numbers(r);
  s += box_outlines(r) + platform_outlines(r, 0) + platform_outlines(r, 1);
  s += outlines("goal", {rectangle(r.k.goal, f.box_length, f.box_width)});
  s += "plot " + obstacle_key(r.k.hall.room);
  s += fmt::format("$goal with lines lw 4 lc rgb '{}' title 'goal'", kReferenceColour);
  for (std::size_t k = 0; k < kPlatforms; ++k) {
    const auto first = column::platforms + 4 * static_cast<int>(k);
    s += fmt::format(", {}{}:{} with lines lw 1.2 lc rgb '{}' title 'platform {}'", kFile, first, first + 1,
                     curve_colour(k), k + 1);
    s += fmt::format(", $platform{} with lines lw 0.8 dt 2 lc rgb '{}' notitle", k + 1, curve_colour(k));
  }
  s += fmt::format(", $box with lines lw 2 lc rgb '{}' title 'box, with the numbers of pushes'",
                   curve_colour(2));
  s += fmt::format(", {}{}:{} with lines lw 2 lc rgb '{}' notitle\n", kFile, +column::box, column::box + 1,
                   curve_colour(2));
  return s;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots(const PushResults& results) {
  return {{"path", path_script(results)}, {"push", push_script(results)}};
}

}  // namespace mrroc::box_push
