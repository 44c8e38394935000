// MP of a task whose arms work on their own (coordination "none" or sporadic, MG 5): starts them, pauses them, writes
// down what they report, and ends when all are done.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/dormant_operator.hpp"
#include "mp/task_run.hpp"

namespace mrroc::mp {

/// f_cT of a coordinator that lets its arms work and tells each what it cannot know of the others (sporadic coordination,
/// MG 5): a pure function of what the arms have reported in this macrostep.
/// @param agents  x_cT_0j, one per arm
/// @param orders  y_cT_0j, one per arm: go_on and variant are the coordinator's to set
using Coordinate = void(std::span<const Report> agents, std::span<Order> orders);

/// A behaviour of the arms, in words for the operator.
struct BehaviourWords {
  std::string name;     ///< what it does
  std::string until{};  ///< what it waits for; may be empty
};

/// What the run is told.
struct SoloParameters {
  std::vector<std::string> arms;           ///< keys, e.g. arm1
  std::vector<BehaviourWords> behaviours;  ///< m = 1, 2, ...
  std::int64_t lasts{};      ///< macrosteps of work; 0: until the behaviours have been, one after another
  double dt{0.002};          ///< duration of a step [s]
  int n_s{10};               ///< steps of a macrostep
  bool gives_start{true};    ///< false: a person or a script gives it
  Coordinate* coordinate{};  ///< null: the coordinator is dormant
  std::function<void()> watch{};  ///< called in every macrostep; may be empty
};

/// The coordinator.
class SoloRun {
 public:
  /// @param announce  gets a line for every behaviour that an arm begins
  SoloRun(TaskRun& run, const SoloParameters& parameters, std::function<void(const std::string&)> announce);

  /// Runs the task to its end. Call TaskRun::start() before.
  Outcome execute();

  /// @return why execute() gave faulted
  [[nodiscard]] const Fault& fault() const { return links_.fault(); }
  /// @return a row per arm and macrostep; m is the behaviour that was being executed
  [[nodiscard]] const std::vector<ArmTrace>& traces() const { return traces_; }

 private:
  struct Dormant;
  void observe(bool working);
  void show(bool working);
  [[nodiscard]] double progress(bool working);

  TaskRun& run_;
  SoloParameters k_;
  DormantOperator operator_;
  CoordinatorLinks links_;
  std::function<void(const std::string&)> announce_;
  std::vector<ArmTrace> traces_;
  std::vector<std::array<int, 3>> m_;  // of the last reports, newest first
  std::int64_t working_since_{};       // macrostep; 0: not yet
};

}  // namespace mrroc::mp
