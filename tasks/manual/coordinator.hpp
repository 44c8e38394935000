// The agent a_0 of manual operation, and its program in MP: passes the operator's orders on.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/task_run.hpp"
#include "mrroc/manual_order_t.hpp"
#include "tasks/manual/command_server.hpp"

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

/// Settings of the run.
struct ManualParameters {
  std::vector<ArmInfo> arms;     ///< in the order of the run's arms
  InstructionScript script;      ///< instructions that need no terminal
  std::filesystem::path record;  ///< where instructions go that were taken; empty: nowhere
  double macrostep_s{0.02};      ///< [s]
};

/// MP of the task.
class ManualRun final : public mp::CoordinatorRun {
 public:
  /// @param run  is told of every behaviour that an arm begins; must outlive this object
  ManualRun(mp::TaskRun& run, const ManualParameters& parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return links_.fault(); }

 private:
  class Port;
  void send(const Coordinator::Said& said);
  void read(Coordinator::X& x);
  void show(const Coordinator::X& x);
  /// Reports the drivers that have tripped since the macrostep before.
  void report_trips(const Coordinator::X& x);

  mp::TaskRun& run_;
  ManualParameters k_;
  mp::AutoStartOperator operator_;
  mp::CoordinatorLinks links_;
  CommandServer command_server_;
  std::vector<std::unique_ptr<link::Outbox<manual_order_t>>> manual_out_;
  std::vector<int> m_;         // of the last reports
  std::vector<bool> tripped_;  // drivers whose fault has been told
};

}  // namespace mrroc::manual
