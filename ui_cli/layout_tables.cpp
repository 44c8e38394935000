#include "ui_cli/layout_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

// Upper edge of a chart at least.
constexpr double kLeastForce = 2;  // [N]; the pen's force is 1 N
constexpr double kLeastWay = 1;    // [mm]

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

/// @param current  false: what was measured is over
void put_agent(Canvas& c, int row, const AgentView& a, bool current) {
  const bool posed = current && a.position_known;
  const bool arm = a.effector == EffectorKind::arm;
  c.put(row, 1, a.name.substr(0, kName - 1));
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    put_column(c, row, kName + (k + 1) * kNumber,
               posed && (arm || k < 2) ? fixed(1e3 * a.T_0E[axis], 1) : "-");
    put_column(c, row, kRotation + (k + 1) * kAngle,
               posed && (arm || k == 2) ? fixed(a.T_0E[axis + 3], 3) : "-");
  }
  put_column(c, row, kForce, current && arm ? fixed(a.F_a[2], 2) : "-", Style::heading);
  c.put(row, kSensor, cut(current ? a.sensor : "", std::min(kRotation, c.size().columns) - kSensor));
  for (int k = 0; k < 2; ++k)
    put_column(c, row, kSideForce + (k + 1) * kNumber,
               current && arm ? fixed(a.F_a[static_cast<std::size_t>(k)], 2) : "-");
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
  constexpr int kScale = 11;  // such as " -0.5..20 N"
  const int width = rows.canvas().size().columns - kName - kScale;
  const bool force = view.chart <= Quantity::F_y;
  const StripChart chart = strip_chart(view.history.samples(a.name, view.chart, width), width, height,
                                       view.glyphs, force ? kLeastForce : kLeastWay);
  for (std::size_t k = 0; k < chart.rows.size(); ++k) {
    const int row = rows.take();
    const std::string_view name = to_string(view.chart);
    if (k == 0)
      rows.canvas().put(row, 1, with_m && a.m != 0 ? fmt::format("{} m {}", name, a.m) : std::string(name),
                        Style::dim);
    const int end = rows.canvas().put(row, kName, chart.rows[k], Style::good);
    std::string edge = k == 0 ? fmt::format("{:g}", chart.high) : "";
    if (k + 1 == chart.rows.size())
      edge = fmt::format("{}{}{} {}", fmt::format("{:g}", chart.low), height == 1 ? ".." : "",
                         height == 1 ? edge : "", unit_of(view.chart));
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

int process_rows(const Snapshot& s, int columns) { return rows_for(s.processes.size(), columns); }

int faulty_process_rows(const Snapshot& s, int columns) {
  const auto troubled =
      static_cast<std::size_t>(std::ranges::count_if(s.processes, [](const auto& p) { return !usual(p); }));
  return rows_for(std::min(troubled + 1, s.processes.size()), columns);
}

void put_agents(Rows& rows, const View& view, int chart_height, bool behaviours) {
  Canvas& c = rows.canvas();
  const int title = rows.take();
  c.put(title, 1, "AGENT", Style::heading);
  constexpr std::array<std::string_view, 3> kAxes{"x [mm]", "y [mm]", "z [mm]"};
  for (int k = 0; k < 3; ++k)
    put_column(c, title, kName + (k + 1) * kNumber, kAxes[static_cast<std::size_t>(k)], Style::heading);
  put_column(c, title, kForce, "F_z [N]", Style::heading);
  c.put(title, kSensor, "SENSOR", Style::heading);
  put_column(c, title, kRotation + 3 * kAngle, "rotation [rad]", Style::heading);
  put_column(c, title, kSideForce + kNumber, "F_x [N]", Style::heading);
  put_column(c, title, kSideForce + 2 * kNumber, "F_y [N]", Style::heading);
  for (const AgentView& a : view.snapshot->agents) {
    put_agent(c, rows.take(), a, view.snapshot->is_current());
    if (behaviours) put_behaviour(c, rows.take(), a, view.snapshot->is_current());
    put_chart(rows, view, a, chart_height, !behaviours);
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
