#include "tasks/haptic/plots.hpp"

#include <fmt/core.h>

#include <array>
#include <string>

#include "tasks/haptic/record.hpp"

namespace mrroc::haptic {
namespace {

// Axes of the base in words: x is away from the arm.
constexpr std::array kAway{"away from the arm", "to its left", "up"};

ChartCurve curve(int column, double scale, const char* title, std::size_t colour, double width = 1.4) {
  return {.source = fmt::format("'{}' skip 1 using 1:({:g}*column({}))", kRecordFile, scale, column),
          .title = title,
          .colour = std::string(curve_colour(colour)),
          .width = width};
}

}  // namespace

TimeChart motion_chart(const Law& law) {
  TimeChart chart{.title = "ways of master and slave"};
  for (int axis = 0; axis < 3; ++axis) {
    ChartPanel panel{.title = kAway[static_cast<std::size_t>(axis)], .y_label = "[mm]"};
    panel.curves = {curve(column::x_m + axis, law.motion_scale, "master, in the scale of the slave", 1, 2.4),
                    curve(column::x_s + axis, 1, "slave", 0)};
    chart.panels.push_back(panel);
  }
  return chart;
}

TimeChart force_chart(const Law& law) {
  TimeChart chart{.title = "force that the hand feels, and force that the slave exerts"};
  for (const int axis : {0, 2}) {
    ChartPanel panel{.title = kAway[static_cast<std::size_t>(axis)], .y_label = "[N]"};
    panel.curves = {
        curve(column::F_m + axis, 1, "felt by the hand", 1, 2.0),
        curve(column::F_s + axis, law.force_scale, "exerted by the slave, in the scale of the hand", 0)};
    chart.panels.push_back(panel);
  }
  return chart;
}

TimeChart energy_chart() {
  TimeChart chart{.title = "energy of the channel at its ports"};
  ChartPanel ports{.title = "heard of the other side less come out here", .y_label = "[mJ]"};
  ports.curves = {curve(column::E_m, 1, "master's port", 1), curve(column::E_s, 1, "slave's port", 0)};
  ChartPanel kept{.title = "kept back by both passivity controllers", .y_label = "[mJ]"};
  kept.curves = {curve(column::kept, 1, "", 2)};
  ChartPanel age{.title = "age of what the slave knows of the master", .y_label = "[ms]"};
  age.curves = {curve(column::age, 1, "", 3)};
  chart.panels = {ports, kept, age};
  return chart;
}

}  // namespace mrroc::haptic
