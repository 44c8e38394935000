// The coordinator's program, MS fig. 6: teach-in, then reproduction, while everything that happens is written
// down.
#pragma once
#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "mp/task_run.hpp"
#include "tasks/drawing/hand_operator.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// What a run of the coordinator has left.
struct RunRecord {
  Recording recording;  ///< taught, or as loaded
  bool whole{};         ///< the teach-in has come to its end, whatever has become of the copies
  std::array<mp::ArmTrace, kArms> traces;  ///< a row per macrostep
  /// Macrosteps in which each arm began to draw a segment: its driver told that it had executed a command of
  /// m = 5, the first one of the segment.
  std::array<std::vector<std::int64_t>, kArms> segment_starts;
};

/// The agent a_0 in MP.
class DrawingRun {
 public:
  /// @param taught    a recording to reproduce without a teach-in
  /// @param announce  gets a line for every behaviour that begins
  DrawingRun(mp::TaskRun& run, const std::vector<std::string>& arms, const Parameters& parameters,
             const HandPlan& plan, std::optional<Recording> taught,
             std::function<void(const std::string&)> announce);

  /// Runs the task to its end. Call TaskRun::start() before.
  Outcome execute();

  /// @return why execute() gave faulted
  [[nodiscard]] const Fault& fault() const { return fault_; }
  /// @return what there is so far
  [[nodiscard]] const RunRecord& record() const { return record_; }

 private:
  using X = Coordinator::X;
  void observe(const Motion<Coordinator>& motion, const X& x);
  void note_rows(const X& x);
  void show(const Motion<Coordinator>& motion, const X& x);
  [[nodiscard]] double seconds(std::int64_t macrosteps) const;

  mp::TaskRun& run_;
  Parameters k_;
  HandOperator operator_;
  mp::CoordinatorLinks links_;
  std::function<void(const std::string&)> announce_;
  RunRecord record_;
  Fault fault_;
  std::deque<int> ordered_;              // m of the last orders, newest first
  std::array<int, kArms> reported_m_{};  // by the agents, in the macrostep before
  std::array<bool, kArms> drawing_{};    // the driver has executed a command of the present m = 5
  int m_{-1};
  int stroke_{};
  bool told_done_{};  // that the present behaviour's trigger may be given
};

}  // namespace mrroc::drawing
