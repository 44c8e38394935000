// MP of a task whose arms work on their own (coordination "none" or sporadic, MG 5): starts them, pauses
// them, records what they report, and ends when all are done.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/msg/convert.hpp"
#include "mp/arm_trace.hpp"
#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/task_run.hpp"
#include "mp/trace_recorder.hpp"

namespace mrroc::mp {

/// f_cT of a coordinator that lets its arms work and tells each what it cannot know of the others (sporadic coordination,
/// MG 5): a pure function of what the arms have reported in this macrostep.
/// @param agents  x_cT_0j, one per arm
/// @param orders  y_cT_0j, one per arm: go_on and variant are the coordinator's to set
using Coordinate = void(std::span<const Report> agents, std::span<Order> orders);

/// f_cV of such a coordinator: what it asks of a sensor of its own, a pure function of what the arms have reported.
using Ask = SensorSetting(std::span<const Report> agents);

/// A behaviour of the arms, in words for the operator.
struct BehaviourWords {
  std::string name;     ///< what it does
  std::string until{};  ///< what it waits for; may be empty
  bool by_trigger{};    ///< the operator's trigger ends it: the first arm is told go_on[0] then
};

/// Settings of the run.
struct SoloParameters {
  std::vector<std::string> arms;           ///< keys, e.g. arm1
  std::vector<BehaviourWords> behaviours;  ///< m = 1, 2, ...
  std::int64_t
      lasts{};  ///< macrosteps of work, in task time; 0: until the behaviours have been, one after another
  double dt{0.002};               ///< duration of a step [s]
  int n_s{10};                    ///< steps of a macrostep
  bool gives_start{true};         ///< false: a person or a script gives it
  Coordinate* coordinate{};       ///< null: the coordinator is dormant
  Ask* ask{};                     ///< null: the coordinator asks nothing of any sensor
  std::string sensor{};           ///< channel on which it asks, when it does
  link::OtherLinks others{};      ///< beside those to the arms, the operator and that sensor
  std::function<void()> watch{};  ///< called in every macrostep; may be empty
  /// Makes the operator, who gives start and triggers unless gives_start is false. Empty: an AutoStartOperator.
  std::function<std::unique_ptr<OperatorAgent>(TaskRun&, bool gives_start)> make_operator{};
};

/// The coordinator.
class SoloRun final : public CoordinatorRun {
 public:
  /// @param run  is told of every behaviour that an arm begins; must outlive this object
  SoloRun(TaskRun& run, const SoloParameters& parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return links_.fault(); }
  /// @return a row per arm and macrostep; m is the behaviour that was being executed
  [[nodiscard]] std::span<const ArmTrace> traces() const override { return traces_; }

 private:
  struct DormantMemory;
  struct Dormant;
  void observe(std::span<const Report> reports, bool working);
  void show(bool working);
  /// @return links beside those to the arms and the operator
  link::OtherLinks others();
  [[nodiscard]] bool waits_for_trigger(int m) const;
  [[nodiscard]] double progress(bool working);

  TaskRun& run_;
  SoloParameters k_;
  std::unique_ptr<OperatorAgent> operator_;
  std::optional<link::OutgoingLink<SensorSetting>> setting_out_;  // none: it asks nothing
  CoordinatorLinks links_;
  TraceRecorder recorder_;
  std::vector<ArmTrace> traces_;
  std::vector<int> m_;                   // of the reports that were shown last
  std::optional<double> working_since_;  // task time; nothing: not yet
};

}  // namespace mrroc::mp
