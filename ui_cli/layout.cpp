#include "ui_cli/layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/command_hint.hpp"
#include "base/wrap.hpp"
#include "ui_cli/layout_tables.hpp"
#include "ui_cli/manual_page.hpp"

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
    case TaskState::ending:
      return Style::warning;
    case TaskState::ended:
      return Style::title;
  }
  return Style::bad;
}

/// Two texts of one row that do not touch: the right one whole, the left one as far as there is room.
void put_both(Canvas& c, int row, const std::string& left, Style left_style, const std::string& right,
              Style right_style) {
  constexpr int kApart = 2;
  const int end = c.size().columns - 1;
  c.put_right(row, end, right, right_style);
  c.put(row, 1, cut(left, end - 1 - (right.empty() ? 0 : static_cast<int>(right.size()) + kApart)),
        left_style);
}

bool stopped_by_operator(FaultCode code) {
  return code == FaultCode::operator_stop || code == FaultCode::interrupted;
}

/// @return how a task ends that was stopped or had a fault
std::string ending_of(FaultCode code) {
  if (code == FaultCode::emergency_stop) return "EMERGENCY STOP";
  if (stopped_by_operator(code)) return code == FaultCode::interrupted ? "interrupted" : "stopped";
  return fmt::format("FAULT {}", to_string(code));
}

void put_title(Canvas& c, const View& v) {
  const std::string task = v.snapshot ? v.snapshot->task : "task";
  std::string state = " NO STATUS YET ";
  Style style = Style::warning;
  if (v.snapshot && v.silence > kSilence && v.snapshot->state != TaskState::ended) {
    state = fmt::format(" NO NEWS FOR {:.0f} s ", v.silence);
    style = Style::bad;
  } else if (v.snapshot) {
    state = fmt::format(" {} ", to_string(v.snapshot->state));
    style = style_of(v.snapshot->state);
  }
  if (v.snapshot && v.snapshot->fault != FaultCode::none) {
    state = fmt::format(" {}, {} ", ending_of(v.snapshot->fault), to_string(v.snapshot->state));
    style = stopped_by_operator(v.snapshot->fault) ? style : Style::bad;
  }
  const int end = c.size().columns;
  c.put(0, 1, cut(fmt::format("{}   session {}", task, v.session), end - 2 - static_cast<int>(state.size())));
  c.paint(0, Style::title);
  c.put_right(0, end, state, style);
}

/// Behaviour, times, why the last behaviour ended and the progress. @return the next free row
int put_task(Canvas& c, const Snapshot& s) {
  const int end = c.size().columns;
  int row = 1;
  std::string behaviour = s.m != 0 ? fmt::format("m {}  {}", s.m, s.behaviour) : s.behaviour;
  std::string times = fmt::format("{} s simulated, {} x", fixed(s.sim_time, 2), fixed(s.speed, 1));
  if (!s.is_current()) {  // what was, when it ended
    if (!behaviour.empty()) behaviour = "ended in " + behaviour;
    times = fixed(s.sim_time, 2) + " s simulated";
  }
  const std::string counted = s.macrostep > 0 ? fmt::format("i {}, {}", s.macrostep, times) : times;
  const auto fits = [&](const std::string& right) {
    return static_cast<int>(behaviour.size() + right.size()) + 4 <= end;
  };
  if (fits(counted))
    times = counted;
  else if (!fits(times))
    times = fixed(s.sim_time, 2) + " s";
  put_both(c, row++, behaviour, s.is_current() ? Style::heading : Style::dim, times, Style::plain);
  std::string wait;
  if (s.waits_for_trigger)
    wait = s.early.empty() ? "waits for your trigger: press t" : "press t later: " + s.early;
  if (s.state == TaskState::paused) wait = resting(s) + ": press r to go on";
  put_both(c, row++, s.ended_because.empty() ? "" : "after " + s.ended_because, Style::dim, wait,
           Style::warning);
  if (s.progress) {
    const int width = std::clamp(end / 2, 10, 60);
    const int done = static_cast<int>(std::lround(*s.progress * width));
    int column = c.put(row, 1, "[");
    column = c.put(row, column, std::string(static_cast<std::size_t>(done), '#'), Style::good);
    column = c.put(row, column, std::string(static_cast<std::size_t>(width - done), '.'), Style::dim);
    column = c.put(row, column, fmt::format("] {:3.0f} %  ", std::floor(100 * *s.progress)));
    c.put(row++, column, cut(s.progress_text, end - column));
  } else {
    c.put(row++, 1, cut(s.progress_text, end - 1));
  }
  return row;
}

/// A key at the lower edge.
struct Key {
  std::string text;
  Style style;
  int rank;  // where there is too little room, the highest goes first
};

void put_ranked(Canvas& c, int row, std::vector<Key> keys, int apart) {
  const auto width = [&] {
    int columns = 1;
    for (const Key& k : keys) columns += static_cast<int>(k.text.size()) + apart;
    return columns - apart;
  };
  while (keys.size() > 1 && width() > c.size().columns) {
    const auto least = std::ranges::max_element(keys.rbegin(), keys.rend(), {}, &Key::rank);
    keys.erase(std::next(least).base());
  }
  int column = 1;
  for (const Key& k : keys) column = c.put(row, column, k.text, k.style) + apart;
}

/// The emergency stop and the help stay to the end; keys that mean nothing now go first.
void put_keys(Canvas& c, const View& v) {
  constexpr std::array<std::string_view, 6> kKeys{"s start",   "p pause", "r resume",
                                                  "t trigger", "x stop",  "e E-STOP"};
  const int row = c.size().rows - 1;
  if (v.snapshot && v.snapshot->state == TaskState::ended) {
    c.put(row, 1, "the task is over   q leave   ? help");
    return;
  }
  const bool manual = v.snapshot && v.snapshot->task == kManualTask;
  constexpr int kWide = 98, kMedium = 76, kNarrow = 66, kManual = 10;  // columns
  const int columns = c.size().columns - (manual ? kManual : 0);
  const int apart = columns >= kMedium ? 2 : 1;
  std::vector<Key> keys;
  for (std::size_t k = 0; k < kKeys.size(); ++k) {
    const bool can = v.snapshot && sensible(kOperatorOrders[k], *v.snapshot);
    const bool emergency = kOperatorOrders[k] == OperatorOrder::emergency_stop;
    keys.push_back({std::string(kKeys[k]), can ? Style::heading : Style::dim, emergency ? 0 : can ? 2 : 4});
  }
  if (manual) keys.push_back({"m manual", Style::heading, 3});
  keys.push_back({columns < kNarrow ? "?" : "? help", Style::plain, 1});
  keys.push_back({columns >= kWide    ? "q leave (task goes on)"
                  : columns < kNarrow ? "q"
                                      : "q leave",
                  Style::plain, 3});
  put_ranked(c, row, std::move(keys), apart);
}

void put_help(Rows& rows) {
  constexpr std::array<std::string_view, 10> kHelp{
      "s  start    begins a task that waits for its operator",
      "p  pause    arms rest with their forces, platforms stand",
      "r  resume   goes on after a pause",
      "t  trigger  ends a behaviour that waits for you",
      "x  stop     ends the task, everything comes to rest; asks",
      "e  e-stop   the drives brake at once; in a text: Ctrl-E",
      "c  charts   F_z F_x F_y, ways x y z; of platforms v, w",
      "m  manual   moves idle arms by hand, in the task `manual`",
      "q  leave    closes this view; the task goes on",
      "m: behaviour  i: macrostep  F_z: force along the tool's z"};
  for (const std::string_view line : kHelp) rows.canvas().put(rows.take(), 1, line);
  rows.canvas().put(rows.take(), 1,
                    "Bright keys mean something now. From a shell: " + typed("ui_cli --help"));
  rows.canvas().put(rows.take(), 1, "Any key goes back.");
}

/// @return the notice in lines, at least one; on a low screen not more
std::vector<std::string> notice_lines(const std::string& text, Size size) {
  constexpr std::size_t kMost = 3;
  constexpr int kLow = 12;
  std::vector<std::string> lines = wrap(text, size.columns - 1);
  const std::size_t most = size.rows < kLow ? 1 : kMost;
  if (lines.size() > most) {
    for (std::size_t k = most; k < lines.size(); ++k) lines[most - 1] += " " + lines[k];
    lines[most - 1] = cut(lines[most - 1], size.columns - 1);
  }
  lines.resize(std::clamp<std::size_t>(lines.size(), 1, most));
  return lines;
}

/// Rows of the body's parts.
struct Plan {
  bool behaviours{};  // of the agents, a row each
  int chart_height{};
  int processes{};
  int gap{};  // blank rows between the parts
};

/// @param processes  rows of theirs
Plan plan(int rows, const Snapshot& s, int processes) {
  const auto agents = static_cast<int>(std::ranges::count_if(s.agents, has_effector));
  int fixed_rows = agent_headings(s) + static_cast<int>(s.agents.size()) + 1 + processes;
  // A chart of more than one row only where this many lines of messages stay.
  constexpr int kMessages = 6;
  constexpr int kFewMessages = 2;
  Plan p{.processes = processes};
  p.behaviours = rows - fixed_rows - agents >= kFewMessages &&
                 std::ranges::any_of(s.agents, [](const AgentView& a) { return !a.behaviour.empty(); });
  if (p.behaviours) fixed_rows += agents;
  for (int height = 1; height <= 4; ++height) {
    const int left = rows - fixed_rows - agents * height;
    if (left >= (height == 1 ? 1 : kMessages)) p.chart_height = height;
  }
  p.gap = rows - fixed_rows - agents * p.chart_height >= 4 ? 1 : 0;
  return p;
}

/// Where charts find no room beside all processes, those that are well are only counted.
Plan plan_with_charts(int rows, const Snapshot& s, int columns) {
  const Plan all = plan(rows, s, process_rows(s, columns));
  if (all.chart_height > 0) return all;
  const Plan counted = plan(rows, s, faulty_process_rows(s, columns));
  return counted.chart_height > 0 ? counted : all;
}

}  // namespace

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
    case OperatorOrder::emergency_stop:
      return s.state < TaskState::ending;
  }
  return false;
}

Canvas lay_out(const View& view, Size size) {
  Canvas c(size);
  put_title(c, view);
  const bool by_hand = view.manual && !view.help;
  const int keys = by_hand ? ManualPage::kKeyRows : 1;
  const std::vector<std::string> notice = notice_lines(view.notice.text, size);
  const int limit = size.rows - keys - static_cast<int>(notice.size());
  if (view.help) {
    Rows body(c, 1, limit);
    if (view.manual)
      ManualPage::draw_help(body);
    else
      put_help(body);
  } else if (by_hand) {
    constexpr int kMessages = 3;
    const int messages = limit > 14 + kMessages ? kMessages + 1 : 0;
    view.manual->draw(c, 1, limit - messages);
    Rows rest(c, limit - messages, limit);
    if (messages > 0) put_messages(rest, view.messages);
  } else if (view.snapshot) {
    const Snapshot& s = *view.snapshot;
    const int row = put_task(c, s);
    const Plan p = plan_with_charts(limit - row, s, size.columns);
    Rows body(c, row + p.gap, limit);
    put_agents(body, view, p.chart_height, p.behaviours);
    body.skip(p.gap);
    put_processes(body, s, p.processes);
    body.skip(p.gap);
    put_messages(body, view.messages);
  }
  // Last, so that on the smallest screens they stand over everything else.
  for (int row = std::max(1, limit); row < size.rows; ++row)
    c.put(row, 0, std::string(static_cast<std::size_t>(std::max(size.columns, 0)), ' '));
  for (std::size_t k = 0; k < notice.size(); ++k)
    if (const int row = limit + static_cast<int>(k); row > 0) c.put(row, 1, notice[k], view.notice.style);
  if (by_hand && size.rows > ManualPage::kKeyRows)
    view.manual->draw_keys(c, size.rows - ManualPage::kKeyRows);
  else if (size.rows > 1)
    put_keys(c, view);
  return c;
}

}  // namespace mrroc::ui
