// The agent a_0 of manual operation, and its program in MP: passes the operator's orders on.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mp/coordinator_links.hpp"
#include "mp/dormant_operator.hpp"
#include "mp/task_run.hpp"
#include "mrroc/manual_order_t.hpp"
#include "tasks/manual/desk.hpp"

namespace mrroc::manual {

/// A part of an image that the coordinator does not have.
struct Nothing {};

/// Images of the coordinator.
struct Coordinator {
  /// c_c: the last order of each arm.
  struct Memory {
    std::vector<ManualOrder> given;  ///< by the number of the arm
  };
  /// x_cT0
  struct Heard {
    std::vector<Report> agent;  ///< x_cT_0j, by the number of the arm
    OperatorImage h;            ///< x_cT_0h
    Hands hands;                ///< what the operator wants from this macrostep on
  };
  /// y_cT0
  struct Said {
    std::vector<Order> order;         ///< y_cT_0j, by the number of the arm
    std::vector<ManualOrder> manual;  ///< what goes with each of them
  };
  /// x: memory c, what is heard T, macrostep i, and i_0 in which the behaviour began; no effector e, no sensors V.
  struct X {
    Memory c;
    Nothing e, V;
    Heard T;
    std::int64_t i{}, i_0{};
  };
  /// y: the new memory c and what is said T.
  struct Y {
    Memory c;
    Nothing e, V;
    Said T;
  };
};

/// m = 1: the operator's orders reach the arms, until he ends it and all have done what they had to.
extern const Motion<Coordinator> kManualOperation;

/// @return the order that ends the task. It also ends a pause: an arm that stands for one hears of nothing else
[[nodiscard]] Coordinator::Said farewell(const Coordinator::X& x);

/// What the run is told.
struct ManualParameters {
  std::vector<ArmInfo> arms;          ///< in the order of the run's arms
  std::vector<ScriptedWords> script;  ///< instructions that need no terminal
  std::filesystem::path record;       ///< where instructions go that were taken; empty: nowhere
  double macrostep_s{0.02};           ///< [s]
};

/// MP of the task.
class ManualRun {
 public:
  /// @param announce  gets a line for every behaviour that an arm begins
  ManualRun(mp::TaskRun& run, const ManualParameters& parameters,
            std::function<void(const std::string&)> announce);

  /// Runs the task to its end. Call TaskRun::start() before.
  Outcome execute();
  /// @return why execute() gave faulted
  [[nodiscard]] const Fault& fault() const { return links_.fault(); }

 private:
  class Port;
  void send(const Coordinator::Said& said);
  void read(Coordinator::X& x);
  void show(const Coordinator::X& x);
  /// Tells of the drivers that have tripped since the macrostep before.
  void tell_trips(const Coordinator::X& x);

  mp::TaskRun& run_;
  ManualParameters k_;
  mp::DormantOperator operator_;
  mp::CoordinatorLinks links_;
  Desk desk_;
  std::vector<std::unique_ptr<link::Outbox<manual_order_t>>> manual_out_;
  std::function<void(const std::string&)> announce_;
  std::vector<int> m_;         // of the last reports
  std::vector<bool> tripped_;  // drivers whose fault has been told
};

}  // namespace mrroc::manual
