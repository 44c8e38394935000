// The tables of the full-screen view: agents, processes, messages.
#pragma once
#include <string>
#include <vector>

#include "ui_cli/canvas.hpp"
#include "ui_cli/layout.hpp"

namespace mrroc::ui {

/// Rows of a canvas that are given out from the top; after the last one there are none that can be seen.
class Rows {
 public:
  /// @param next first row; @param limit row after the last one
  Rows(Canvas& canvas, int next, int limit) : canvas_(canvas), next_(next), limit_(limit) {}

  /// @return that the rows are of
  [[nodiscard]] Canvas& canvas() { return canvas_; }
  /// @return number of rows that take() can still give
  [[nodiscard]] int left() const { return next_ < limit_ ? limit_ - next_ : 0; }
  /// @return the next row; one outside of the canvas when there is none
  int take() { return next_ < limit_ ? next_++ : -1; }
  /// Leaves rows empty.
  void skip(int count) { next_ += count; }

 private:
  Canvas& canvas_;
  int next_;
  int limit_;
};

/// @return the number with that many decimals, a power of ten when it is too large to be read, or "nan",
/// "inf"
std::string fixed(double value, int decimals);

/// @return rows that put_processes wants below its heading
int process_rows(const Snapshot& s, int columns);
/// @return rows that it needs for the processes that are not well, and for the count of the others
int faulty_process_rows(const Snapshot& s, int columns);

/// @return rows of headings above the agents: arms and platforms have one of their own
int agent_headings(const Snapshot& s);
/// Pose, force or velocity, and sensor of every agent, and below each its behaviour and a chart; of an agent without an effector
/// its behaviour, behind its name.
/// @param behaviours  whether there is a row for them: name, and why the one before ended
void put_agents(Rows& rows, const View& view, int chart_height, bool behaviours);
/// State and age of every process. When there is too little room, those that are not well come first, and the others
/// are counted.
/// @param most  rows below the heading
void put_processes(Rows& rows, const Snapshot& s, int most);
/// The newest messages that there is room for.
void put_messages(Rows& rows, const std::vector<Message>& messages);

}  // namespace mrroc::ui
