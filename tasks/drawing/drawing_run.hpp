// The execution of the coordinator's program, MS fig. 6: teach-in, then reproduction, with a record of all
// events.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "mp/task_run.hpp"
#include "mp/trace_recorder.hpp"
#include "tasks/drawing/belt_record.hpp"
#include "tasks/drawing/hand_operator.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// Results of a run of the coordinator.
struct RunRecord {
  Recording recording;         ///< taught, or as loaded
  std::vector<double> node_t;  ///< when the pen was where each node ends [s]; empty: loaded
  /// Macrosteps of m = 5 and 7 in which an arm's sensor did not say of the pen what the memory says.
  std::array<int, kArms> mismatches{};
  bool whole{};  ///< the teach-in has come to its end, whatever has become of the copies
  std::vector<mp::ArmTrace> traces{
      kArms};  ///< of the arms, and of a conveyor behind them: a row per macrostep
  /// Macrosteps in which each arm began to draw a segment: its driver told that it had executed a command of
  /// m = 5, the first one of the segment.
  std::array<std::vector<std::int64_t>, kArms> segment_starts;
  BeltRecord belt;  ///< of a conveyor that runs by itself
};

/// Writes down when nodes came into being. @param recording  as it is now @param t  when its last node ended [s]
void note_nodes(RunRecord& record, const Recording& recording, double t);

/// The agent a_0 in MP.
class DrawingRun final : public mp::CoordinatorRun {
 public:
  /// @param run     is told of every behaviour that begins; must outlive this object
  /// @param taught  a recording to reproduce without a teach-in
  DrawingRun(mp::TaskRun& run, const std::vector<std::string>& arms, const Parameters& parameters,
             const HandPlan& plan, std::optional<Recording> taught);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return fault_; }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return record_.traces; }
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
  std::size_t effectors_;
  mp::TraceRecorder recorder_;
  RunRecord record_;
  bool taught_here_{};
  Fault fault_;
  std::array<int, kArms> reported_m_{};  // by the agents, in the macrostep before
  std::array<bool, kArms> drawing_{};    // the driver has executed a command of the present m = 5
  int m_{-1};
  int stroke_{};
  bool told_done_{};  // that the present behaviour's trigger may be given
};

}  // namespace mrroc::drawing
