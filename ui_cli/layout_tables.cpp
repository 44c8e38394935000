#include "ui_cli/layout_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/wrap.hpp"

namespace mrroc::ui {
namespace {

// Columns after the last character of a table's entry, counted from 0.
constexpr int kName = 10;
constexpr int kNumber = 8;
constexpr int kForce = kName + 3 * kNumber + 9;
constexpr int kSensor = kForce + 2;  // first column
constexpr int kRotation = kSensor + 14;
constexpr int kAngle = 7;
constexpr int kSideForce = kRotation + 3 * kAngle;
// Of platforms.
constexpr int kHeading = kName + 2 * kNumber + 11;
constexpr int kSpeed = kHeading + 9;
constexpr int kSeen = kSpeed + 2;  // first column
constexpr int kSeenWidth = 31;
constexpr int kTurn = kSeen + kSeenWidth + 11;

// Upper edge of a chart at least.
constexpr double kLeastForce = 2;    // [N]; the pen's force is 1 N
constexpr double kLeastWay = 1;      // [mm]
constexpr double kLeastSpeed = 0.1;  // [m/s], [rad/s]

constexpr int kProcessWidth = 40;
constexpr double kOldAge = 2;  // [s]; processes tell that they live twice a second

bool too_old(const ProcessView& p) { return p.state != link::ProcessState::done && p.age > kOldAge; }

bool usual(const ProcessView& p) {
  const bool alive = p.state == link::ProcessState::running || p.state == link::ProcessState::ready ||
                     p.state == link::ProcessState::starting;
  return p.state == link::ProcessState::done || (alive && !too_old(p));
}

Style style_of(const ProcessView& p) {
  if (p.state == link::ProcessState::done) return Style::dim;
  if (!usual(p)) return Style::bad;
  return p.state == link::ProcessState::running ? Style::good : Style::warning;
}

bool has(const Snapshot& s, EffectorKind kind) {
  return std::ranges::count(s.agents, kind, &AgentView::effector) > 0;
}

int rows_for(std::size_t processes, int columns) {
  const int beside = std::max(1, columns / kProcessWidth);
  return (static_cast<int>(processes) + beside - 1) / beside;
}

/// Text in place of processes that are not shown.
std::string hidden_text(std::size_t count, bool all, bool well) {
  return fmt::format("{} {}{}{}", all ? "all" : "and", count, all ? "" : " more", well ? " are well" : "");
}

Style style_of(FaultCode code) {
  if (code == FaultCode::none) return Style::plain;
  return class_of(code) == FaultClass::non_fatal ? Style::warning : Style::bad;
}

/// A column that there is no room for is left out.
void put_column(Canvas& c, int row, int end, std::string_view text, Style style = Style::plain) {
  if (end <= c.size().columns) c.put_right(row, end, text, style);
}

/// @return the number, or a dash where there is none
std::string told(bool is_told, double value, int decimals) { return is_told ? fixed(value, decimals) : "-"; }

void put_headings(Canvas& c, int row) {
  c.put(row, 1, "AGENT", Style::heading);
  constexpr std::array<std::string_view, 2> kAxes{"x [mm]", "y [mm]"};
  for (int k = 0; k < 2; ++k)
    put_column(c, row, kName + (k + 1) * kNumber, kAxes[static_cast<std::size_t>(k)], Style::heading);
}

void put_arm_headings(Canvas& c, int row) {
  put_headings(c, row);
  put_column(c, row, kName + 3 * kNumber, "z [mm]", Style::heading);
  put_column(c, row, kForce, "F_z [N]", Style::heading);
  c.put(row, kSensor, "SENSOR", Style::heading);
  put_column(c, row, kRotation + 3 * kAngle, "rotation [rad]", Style::heading);
  put_column(c, row, kSideForce + kNumber, "F_x [N]", Style::heading);
  put_column(c, row, kSideForce + 2 * kNumber, "F_y [N]", Style::heading);
}

void put_platform_headings(Canvas& c, int row) {
  put_headings(c, row);
  put_column(c, row, kHeading, "phi [deg]", Style::heading);
  put_column(c, row, kSpeed, "v [m/s]", Style::heading);
  c.put(row, kSeen, "SENSOR", Style::heading);
  put_column(c, row, kTurn, "w [rad/s]", Style::heading);
}

/// @param current  false: what was measured is over
void put_arm(Canvas& c, int row, const AgentView& a, bool current) {
  const bool posed = current && a.position_known;
  c.put(row, 1, a.name.substr(0, kName - 1));
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    put_column(c, row, kName + (k + 1) * kNumber, told(posed, 1e3 * a.T_0E[axis], 1));
    put_column(c, row, kRotation + (k + 1) * kAngle, told(posed, a.T_0E[axis + 3], 3));
  }
  put_column(c, row, kForce, told(current, a.F_a[2], 2), Style::heading);
  c.put(row, kSensor, cut(current ? a.sensor : "", std::min(kRotation, c.size().columns) - kSensor));
  for (int k = 0; k < 2; ++k)
    put_column(c, row, kSideForce + (k + 1) * kNumber, told(current, a.F_a[static_cast<std::size_t>(k)], 2));
}

/// @param current  false: what was measured is over
void put_platform(Canvas& c, int row, const AgentView& a, bool current) {
  constexpr double kDegree = std::numbers::pi / 180;
  const bool posed = current && a.position_known;
  c.put(row, 1, a.name.substr(0, kName - 1));
  put_column(c, row, kName + kNumber, told(posed, 1e3 * a.T_0E[0], 1));
  put_column(c, row, kName + 2 * kNumber, told(posed, 1e3 * a.T_0E[1], 1));
  put_column(c, row, kHeading, told(posed, a.T_0E[5] / kDegree, 1));
  put_column(c, row, kSpeed, told(posed, a.velocity[0], 2), Style::heading);
  c.put(row, kSeen, cut(current ? a.sensor : "", std::min(kSeen + kSeenWidth, c.size().columns) - kSeen));
  put_column(c, row, kTurn, told(posed, a.velocity[2], 2));
}

void put_behaviour(Canvas& c, int row, const AgentView& a, bool current) {
  std::string now = a.m != 0 ? fmt::format("m {}  {}", a.m, a.behaviour) : a.behaviour;
  if (!current && !now.empty()) now = "ended in " + now;
  const int column =
      c.put(row, kName, cut(now, c.size().columns - 1 - kName), current ? Style::heading : Style::dim) + 3;
  if (a.ended_because.empty()) return;
  c.put(row, column, cut("after " + a.ended_because, c.size().columns - 1 - column), Style::dim);
}

void put_chart(Rows& rows, const View& view, const AgentView& a, int height, bool with_m) {
  const std::size_t numbers =
      a.effector == EffectorKind::platform ? 11 : 9;  // such as " -0.5..0.5 ", " -20..20 "
  constexpr std::size_t kUnit = 2;                    // of most units
  const auto quantities = quantities_of(a.effector);
  const Quantity shown = quantities[view.chart % quantities.size()];
  const auto scale = static_cast<int>(numbers + std::max(kUnit, unit_of(shown).size()));
  const int width = rows.canvas().size().columns - kName - scale;
  const double least = unit_of(shown) == "N" ? kLeastForce : unit_of(shown) == "mm" ? kLeastWay : kLeastSpeed;
  const StripChart chart =
      strip_chart(view.history.samples(a.name, shown, width), width, height, view.glyphs, least);
  for (std::size_t k = 0; k < chart.rows.size(); ++k) {
    const int row = rows.take();
    const std::string_view name = to_string(shown);
    if (k == 0)
      rows.canvas().put(row, 1, with_m && a.m != 0 ? fmt::format("{} m {}", name, a.m) : std::string(name),
                        Style::dim);
    const int end = rows.canvas().put(row, kName, chart.rows[k], Style::good);
    std::string edge = k == 0 ? fmt::format("{:g}", chart.high) : "";
    if (k + 1 == chart.rows.size())
      edge = fmt::format("{}{}{} {}", fmt::format("{:g}", chart.low), height == 1 ? ".." : "",
                         height == 1 ? edge : "", unit_of(shown));
    rows.canvas().put(row, end + 1, edge, Style::dim);
  }
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (std::isfinite(value) && std::abs(value) >= 1e6) return fmt::format("{:.0e}", value);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = std::isfinite(value) && text.find_first_of("123456789") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

int agent_headings(const Snapshot& s) {
  return std::max(1, has(s, EffectorKind::arm) + has(s, EffectorKind::platform));
}

int process_rows(const Snapshot& s, int columns) { return rows_for(s.processes.size(), columns); }

int faulty_process_rows(const Snapshot& s, int columns) {
  const auto troubled =
      static_cast<std::size_t>(std::ranges::count_if(s.processes, [](const auto& p) { return !usual(p); }));
  return rows_for(std::min(troubled + 1, s.processes.size()), columns);
}

void put_agents(Rows& rows, const View& view, int chart_height, bool behaviours) {
  Canvas& c = rows.canvas();
  const Snapshot& s = *view.snapshot;
  const auto put = [&](EffectorKind kind, const auto& put_agent) {
    for (const AgentView& a : s.agents) {
      if (a.effector != kind) continue;
      put_agent(c, rows.take(), a, s.is_current());
      if (behaviours) put_behaviour(c, rows.take(), a, s.is_current());
      put_chart(rows, view, a, chart_height, !behaviours);
    }
  };
  const bool platforms = has(s, EffectorKind::platform);
  if (has(s, EffectorKind::arm) || !platforms) put_arm_headings(c, rows.take());
  put(EffectorKind::arm, put_arm);
  if (platforms) put_platform_headings(c, rows.take());
  put(EffectorKind::platform, put_platform);
  for (const AgentView& a : s.agents) {
    if (has_effector(a)) continue;
    const int row = rows.take();
    c.put(row, 1, a.name.substr(0, kName - 1));
    put_behaviour(c, row, a, s.is_current());
  }
}

void put_processes(Rows& rows, const Snapshot& s, int most) {
  Canvas& c = rows.canvas();
  const int columns = std::max(1, c.size().columns / kProcessWidth);
  const int title = rows.take();
  for (int k = 0; k < columns; ++k)
    c.put(title, k * kProcessWidth + 1, "PROCESS               STATE      HEARD", Style::heading);
  const int available = std::min(rows.left(), most);
  const std::size_t places = static_cast<std::size_t>(available) * static_cast<std::size_t>(columns);
  std::vector<ProcessView> shown = s.processes;
  const std::size_t hidden = places < shown.size() ? shown.size() - (places > 0 ? places - 1 : 0) : 0;
  bool well = true;  // those that are hidden
  if (hidden > 0) {
    std::stable_partition(shown.begin(), shown.end(), [](const ProcessView& p) { return !usual(p); });
    well = std::all_of(shown.end() - static_cast<std::ptrdiff_t>(hidden), shown.end(), usual);
    shown.resize(shown.size() - hidden);
  }
  int row = -1;
  for (std::size_t k = 0; k < places; ++k) {
    const auto place = static_cast<int>(k) % columns;
    if (place == 0) row = rows.take();
    const int left = place * kProcessWidth + 1;
    if (k == shown.size() && hidden > 0)
      c.put(row, left, hidden_text(hidden, shown.empty(), well), Style::dim);
    if (k >= shown.size()) continue;
    const ProcessView& p = shown[k];
    c.put(row, left, p.name.substr(0, 21));
    c.put(row, left + 22, to_string(p.state), style_of(p));
    c.put_right(row, left + kProcessWidth - 2, fixed(p.age, 1) + " s", too_old(p) ? Style::bad : Style::dim);
  }
}

void put_messages(Rows& rows, const std::vector<Message>& messages) {
  constexpr int kTime = 9, kText = kTime + 2;  // ends, begins
  if (rows.left() > 1) {
    const int title = rows.take();
    rows.canvas().put_right(title, kTime, "t [s]", Style::heading);
    rows.canvas().put(title, kText, "MESSAGES", Style::heading);
  }
  const std::size_t count = std::min(messages.size(), static_cast<std::size_t>(rows.left()));
  for (std::size_t k = messages.size() - count; k < messages.size(); ++k) {
    const Message& m = messages[k];
    std::string text = m.process.empty() ? "" : m.process + ": ";
    if (m.code != FaultCode::none) text += std::string(to_string(m.code)) + ": ";
    const int row = rows.take();
    if (m.time) rows.canvas().put_right(row, kTime, fixed(*m.time, 2), Style::dim);
    rows.canvas().put(row, kText, cut(text + m.text, rows.canvas().size().columns - kText), style_of(m.code));
  }
}

}  // namespace mrroc::ui
