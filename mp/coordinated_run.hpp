// MP of a task whose coordinator has behaviours of its own (MG 5: continuous coordination): executes its
// program, reports to the operator, and records what the arms report.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/task_run.hpp"
#include "mp/trace_recorder.hpp"

namespace mrroc::mp {

/// Settings of such a run.
struct CoordinatedParameters {
  std::vector<std::string> arms;         ///< keys, e.g. arm1
  double dt{0.002};                      ///< duration of a step [s]
  int n_s{10};                           ///< steps of a macrostep
  bool gives_start{true};                ///< false: a person or a script gives it
  TaskClock clock{TaskClock::ramped()};  ///< how the task obeys a pause
  /// Makes the operator, who gives start and triggers unless gives_start is false. Empty: an AutoStartOperator.
  std::function<std::unique_ptr<OperatorAgent>(TaskRun&, bool gives_start)> make_operator{};
  std::vector<int> by_trigger{};  ///< behaviours that his trigger ends
};

/// Common part of every coordinator of that kind, besides its behaviours. m = 0 waits for the start.
class CoordinatedLinks {
 public:
  /// @param run  is told of every behaviour that begins; must outlive this object
  CoordinatedLinks(TaskRun& run, const CoordinatedParameters& parameters);

  /// @return MP's links to the arms and the operator
  [[nodiscard]] CoordinatorLinks& links() { return links_; }
  [[nodiscard]] const CoordinatorLinks& links() const { return links_; }
  /// Publishes the messages of the first macrostep, and receives the first images.
  Outcome begin();
  /// Takes note of a macrostep. Call it after the images have been read.
  /// @param m  of the behaviour that is executed  @param name, until  see Motion
  void observe(int m, std::string_view name, std::string_view until, std::span<const Report> reports);
  /// Tells the arms that the task is over.
  void finish();
  /// @return a row per arm and macrostep; m is the coordinator's behaviour that was being executed
  [[nodiscard]] const std::vector<ArmTrace>& traces() const { return traces_; }

 private:
  TaskRun& run_;
  CoordinatedParameters k_;
  std::unique_ptr<OperatorAgent> operator_;
  CoordinatorLinks links_;
  TraceRecorder recorder_;
  std::vector<ArmTrace> traces_;
  int m_{};  // that was shown last
};

/// The coordinator. @tparam A  its images, see CoordinatorAgent
template <Images A>
class CoordinatedRun final : public CoordinatorRun {
 public:
  using X = typename A::X;                                           ///< images of the coordinator
  using Observer = std::function<void(const Motion<A>&, const X&)>;  ///< of every macrostep
  using Port = CoordinatorPort<A, Observer>;                         ///< where its images come from and go to
  using Program = std::function<Outcome(X& x, Port& port)>;          ///< its Move instructions

  /// @param begin    memory at the beginning
  /// @param program  begins with the behaviour that waits for the start
  /// @param watch    is shown every macrostep, for a record; may be empty
  CoordinatedRun(TaskRun& run, const CoordinatedParameters& parameters, const decltype(X::c)& begin,
                 Program program, Observer watch = {})
      : links_(run, parameters), begin_(begin), program_(std::move(program)), watch_(std::move(watch)) {}

  Outcome execute() override {
    Port port(links_.links(), [this](const Motion<A>& motion, const X& x) {
      links_.observe(motion.m, motion.name, motion.until, x.T.agent);
      if (watch_) watch_(motion, x);
    });
    X x;
    x.c = begin_;
    if (const Outcome o = links_.begin(); o != Outcome::terminated) return o;
    port.read(x);
    const Outcome o = program_(x, port);
    if (o == Outcome::terminated) links_.finish();
    return o;
  }
  [[nodiscard]] const Fault& fault() const override { return links_.links().fault(); }
  [[nodiscard]] std::span<const ArmTrace> traces() const override { return links_.traces(); }

 private:
  CoordinatedLinks links_;
  decltype(X::c) begin_;
  Program program_;
  Observer watch_;
};

}  // namespace mrroc::mp
