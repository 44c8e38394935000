#include "ui_cli/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui_cli/layout_tables.hpp"

namespace mrroc::ui {
namespace {

Style style_of(TaskState s) {
  switch (s) {
    case TaskState::running:
      return Style::good;
    case TaskState::starting:
    case TaskState::waiting_for_start:
    case TaskState::paused:
    case TaskState::stopping:
      return Style::warning;
    case TaskState::ended:
      return Style::title;
  }
  return Style::bad;
}

void put_title(Canvas& c, const View& v) {
  const std::string task = v.snapshot ? v.snapshot->task : "task";
  c.put(0, 1, fmt::format("{}   session {}", task, v.session));
  c.paint(0, Style::title);
  const int end = c.size().columns;
  if (!v.snapshot)
    c.put_right(0, end, " NO STATUS YET ", Style::warning);
  else if (v.silence > kSilence && v.snapshot->state != TaskState::ended)
    c.put_right(0, end, fmt::format(" NO NEWS FOR {:.0f} s ", v.silence), Style::bad);
  else
    c.put_right(0, end, fmt::format(" {} ", to_string(v.snapshot->state)), style_of(v.snapshot->state));
}

/// Behaviour, times, why the last behaviour ended and the progress. @return the next free row
int put_task(Canvas& c, const Snapshot& s) {
  const int end = c.size().columns;
  int row = 1;
  c.put(row, 1, s.m != 0 ? fmt::format("m {}  {}", s.m, s.behaviour) : s.behaviour, Style::heading);
  std::string times = fmt::format("{} s simulated, {} x", fixed(s.sim_time, 2), fixed(s.speed, 1));
  if (s.macrostep > 0) times = fmt::format("i {}, ", s.macrostep) + times;
  c.put_right(row++, end - 1, " " + times);
  const std::string wait = s.waits_for_trigger ? "waits for your trigger: press t" : "";
  if (!s.ended_because.empty()) c.put(row, 1, "after: " + s.ended_because, Style::dim);
  c.put_right(row++, end - 1, wait, Style::warning);
  if (s.progress) {
    const int width = std::clamp(end / 2, 10, 60);
    const int done = static_cast<int>(std::lround(*s.progress * width));
    int column = c.put(row, 1, "[");
    column = c.put(row, column, std::string(static_cast<std::size_t>(done), '#'), Style::good);
    column = c.put(row, column, std::string(static_cast<std::size_t>(width - done), '.'), Style::dim);
    column = c.put(row, column, fmt::format("] {:3.0f} %  ", std::floor(100 * *s.progress)));
    c.put(row++, column, s.progress_text);
  } else {
    c.put(row++, 1, s.progress_text);
  }
  return row;
}

void put_keys(Canvas& c, const View& v) {
  constexpr std::array<std::string_view, 5> kKeys{"s start", "p pause", "r resume", "t trigger", "x stop"};
  const int row = c.size().rows - 1;
  int column = 1;
  for (std::size_t k = 0; k < kKeys.size(); ++k) {
    const bool can = v.snapshot && sensible(kOperatorOrders[k], *v.snapshot);
    column = c.put(row, column, kKeys[k], can ? Style::heading : Style::dim) + 3;
  }
  c.put(row, column, "q leave (the task goes on)");
}

/// Rows of the body's parts.
struct Plan {
  int chart_height{};
  int gap{};  // blank rows between the parts
};

Plan plan(int rows, const Snapshot& s, int columns) {
  const int agents = static_cast<int>(s.agents.size());
  const int fixed_rows = 1 + agents + 1 + process_rows(s, columns);
  // A chart of more than one row only where this many lines of messages stay.
  constexpr int kMessages = 6;
  Plan p;
  for (int height = 1; height <= 4; ++height) {
    const int left = rows - fixed_rows - agents * height;
    if (left >= (height == 1 ? 1 : kMessages)) p.chart_height = height;
  }
  p.gap = rows - fixed_rows - agents * p.chart_height >= 4 ? 1 : 0;
  return p;
}

}  // namespace

void ForceHistory::add(const Snapshot& s) {
  for (const AgentView& a : s.agents) {
    auto& samples = F_z_[a.name];
    samples.push_back(a.F_a[2]);
    if (samples.size() > kKept) samples.pop_front();
  }
}

std::vector<double> ForceHistory::F_z(const std::string& agent) const {
  const auto it = F_z_.find(agent);
  return it == F_z_.end() ? std::vector<double>{} : std::vector<double>(it->second.begin(), it->second.end());
}

bool sensible(OperatorOrder order, const Snapshot& s) {
  switch (order) {
    case OperatorOrder::start:
      return s.state == TaskState::waiting_for_start;
    case OperatorOrder::pause:
      return s.state == TaskState::running;
    case OperatorOrder::resume:
      return s.state == TaskState::paused;
    case OperatorOrder::trigger:
      return s.state == TaskState::running && s.waits_for_trigger;
    case OperatorOrder::stop:
      return s.state < TaskState::stopping;
  }
  return false;
}

Canvas lay_out(const View& view, Size size) {
  Canvas c(size);
  put_title(c, view);
  const int limit = size.rows - 2;  // the notice and the keys
  if (view.snapshot) {
    const Snapshot& s = *view.snapshot;
    const int row = put_task(c, s);
    const Plan p = plan(limit - row, s, size.columns);
    Rows body(c, row + p.gap, limit);
    put_agents(body, view, p.chart_height);
    body.skip(p.gap);
    put_processes(body, s);
    body.skip(p.gap);
    put_messages(body, view.messages);
  }
  // Last, so that on the smallest screens they stand over everything else.
  for (int row = std::max(1, limit); row < size.rows; ++row)
    c.put(row, 0, std::string(static_cast<std::size_t>(std::max(size.columns, 0)), ' '));
  if (size.rows > 2) c.put(limit, 1, view.notice.text, view.notice.style);
  if (size.rows > 1) put_keys(c, view);
  return c;
}

}  // namespace mrroc::ui
