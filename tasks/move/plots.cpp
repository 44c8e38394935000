#include "tasks/move/plots.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tasks/move/agent.hpp"

namespace mrroc::any_motion {
namespace {

constexpr int kSlots = kMaxAxes;  // columns of one quantity

/// The numbers of a row, and NaN where there are none.
std::string columns(const std::vector<ecp::Coordinates>& rows, std::size_t k, double scale) {
  std::string text;
  for (Eigen::Index slot = 0; slot < kSlots; ++slot)
    text += k < rows.size() && slot < rows[k].size() ? fmt::format(",{:.6g}", scale * rows[k][slot]) : ",NaN";
  return text;
}

/// A line per set point: time, joints, speeds and accelerations in percent of their limits.
std::string table_of(const mp::ArmTrace& trace, const ArmPlan& plan) {
  const std::vector<Stretch> moves = stretches_of(trace, row(Row::move).m);
  std::string text = "$motions << EOD\n";
  for (std::size_t n = 0; n < std::min(moves.size(), plan.motions.size()); ++n) {
    const PlannedMotion& m = plan.motions[n];
    const double begin = trace[moves[n].first].t;
    const std::size_t executed = std::min(m.joints.size(), moves[n].last - moves[n].first + 2);
    for (std::size_t k = 0; k < executed; ++k)
      text += fmt::format("{:.4f}{}{}{}\n", begin + static_cast<double>(k) * kPacing.macrostep_s(),
                          columns(m.joints, k, 1), columns(m.rates.velocity, k, 100),
                          columns(m.rates.acceleration, k, 100));
    text += "\n";  // the curve has a gap
  }
  return text + "EOD\n";
}

/// @return columns of speeds that have numbers: poses have two, motors and joints one per axis
int rate_columns(const mp::ArmTrace& trace, const ArmPlan& plan) {
  const std::size_t executed = std::min(stretches_of(trace, row(Row::move).m).size(), plan.motions.size());
  Eigen::Index most = 0;
  for (std::size_t n = 0; n < executed; ++n)
    if (const auto& rates = plan.motions[n].rates.acceleration; !rates.empty())
      most = std::max(most, rates[0].size());
  return static_cast<int>(most);
}

ChartPanel panel(const char* title, const char* y_label, const char* symbol, int quantity, int slots) {
  ChartPanel p{.title = title, .y_label = y_label};
  for (int k = 0; k < slots; ++k)
    p.curves.push_back({.source = fmt::format("$motions using 1:{}", 2 + quantity * kSlots + k),
                        .title = fmt::format("{}_{}", symbol, k + 1),
                        .colour = std::string(curve_colour(static_cast<std::size_t>(k)))});
  return p;
}

ChartPanel with_limits(ChartPanel p) {
  for (const int limit : {-100, 100})
    p.curves.push_back({.source = fmt::format("{}", limit),
                        .title = limit > 0 ? "limit" : "",
                        .colour = std::string(kReferenceColour),
                        .style = CurveStyle::dashes});
  p.y.add(-110);
  p.y.add(110);
  return p;
}

}  // namespace

TimeChart motion_chart(const mp::ArmTrace& trace, const ArmPlan& plan) {
  TimeChart chart{.output = "", .title = plan.arm + ", set points of its motions against their limits"};
  const auto axes = static_cast<int>(plan.start.size());
  const int rates = rate_columns(trace, plan);
  chart.panels = {panel("positions of the joints", "[rad], track [m]", "q", 0, axes),
                  with_limits(panel("speeds in the space of the motion", "[% of the limit]", "v", 1, rates)),
                  with_limits(panel("accelerations", "[% of the limit]", "a", 2, rates))};
  chart.notes.emplace_back(
      "limits:  motors 200 rad/s, 150 rad/s^2;  joints 1.5 rad/s, 7 rad/s^2;  "
      "poses (1 along, 2 about) 0.5 m/s, 2 rad/s, 5 m/s^2, 5 rad/s^2");
  chart.data = table_of(trace, plan);
  return chart;
}

}  // namespace mrroc::any_motion
