#include "launch/force_picture.hpp"

#include <fmt/core.h>

namespace mrroc::launch {

std::vector<Picture> force_picture(Axis axis, double desired) {
  constexpr int kColumnOfForce = 10;  // in arm1.csv
  const char name = "xyz"[static_cast<int>(axis)];
  ChartPanel panel{.title = fmt::format("force F_{} along the tool's {}", name, name),
                   .y_label = fmt::format("F_{} [N]", name),
                   .height = 380};
  panel.curves = {
      {.source = fmt::format("{:g}", desired),
       .title = fmt::format("desired: {:g} N", desired),
       .colour = std::string(kReferenceColour),
       .style = CurveStyle::dashes,
       .width = 1.4},
      {.source = fmt::format("'arm1.csv' skip 1 using 2:{}", kColumnOfForce + static_cast<int>(axis)),
       .title = "measured",
       .colour = std::string(curve_colour(0))}};
  return {{.name = "force",
           .chart = TimeChart{.output = "", .title = "contact force over time", .panels = {panel}},
           .arms = {0}}};
}

}  // namespace mrroc::launch
