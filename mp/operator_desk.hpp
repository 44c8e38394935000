// Where the operator's orders come in: from a terminal, from a script file, or from a scripted operator.
#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::mp {

/// An order and the macrostep in which it is taken: a line `MACROSTEP ORDER` of a script.
struct ScriptedOrder {
  std::int64_t i{};       ///< from 1 on
  OperatorOrder order{};  ///< taken as if a terminal had sent it
};

/// Reads a script: lines `MACROSTEP ORDER`, comments after '#'. Orders are sorted by macrostep.
/// @throws FaultError bad_script that names file and line
std::vector<ScriptedOrder> load_script(const std::filesystem::path& file);

/// Accepts or refuses orders, and hands them over at a macrostep (rule R3). Every order that was taken is
/// written to a script that replays the run.
class OperatorDesk {
 public:
  /// @param record  where taken orders are written; empty: nowhere
  OperatorDesk(link::Process& process, std::vector<ScriptedOrder> script,
               const std::filesystem::path& record);

  /// Answers what has come from terminals. Call it often.
  void poll();

  /// An order from a scripted operator; ignored when it is not allowed.
  /// @return whether it is allowed
  bool give(OperatorOrder order);

  /// Takes the orders for macrostep i.
  /// @return the operator's image
  OperatorImage take(std::int64_t i);

  /// Takes a stop that waits for a macrostep, and nothing else, at once.
  /// @param i  macrostep that a script has to name for the same stop
  /// @return whether one waited
  bool take_stop(std::int64_t i);

  /// What the task is doing now, which decides on what is allowed.
  void set_state(TaskState state, bool waits_for_trigger);
  /// The coordinator is in that behaviour from now on; call it in every macrostep, before take(). A trigger is
  /// for the behaviour in which it was given: one that has not been taken when another behaviour begins is
  /// dropped, and until set_state() says so, the new behaviour does not wait for one.
  void set_behaviour(int m);
  /// @param due  all that the present behaviour does before its trigger is done, and a person gives the trigger; forgotten
  ///             when it is taken, and when another behaviour begins
  void set_trigger_due(bool due) { trigger_due_ = due; }

  /// @return as set_state() has said last
  [[nodiscard]] TaskState state() const { return state_; }
  /// @return whether stop has been ordered
  [[nodiscard]] bool stop_ordered() const { return stop_; }
  /// @return whether stop has been accepted, taken or not: macrosteps may have ceased
  [[nodiscard]] bool stop_accepted() const;
  /// @return whether only a person can go on, with the start, the end of a pause or a trigger that is due: no order is on
  ///         its way, and no script has one
  [[nodiscard]] bool waits_for_a_person() const;
  /// @return whether an emergency stop has been accepted; it does not wait for a macrostep
  [[nodiscard]] bool emergency() const { return emergency_; }
  /// Tells the effector drivers of the emergency stop once more: they may have missed the terminal's message, and
  /// of one in a script nobody else tells them. Does nothing without one, or soon after the last time.
  void repeat_emergency();

 private:
  void answer(const operator_order_t& m);
  [[nodiscard]] std::optional<std::string> objection(OperatorOrder order) const;
  void accept(OperatorOrder order);
  void obey(OperatorOrder order, std::int64_t i);

  link::Process& process_;
  link::Queue<operator_order_t> order_in_;
  link::Outbox<operator_answer_t> answer_out_;
  link::Outbox<operator_order_t> order_out_;  // MP's own, for the drivers
  std::deque<ScriptedOrder> script_;
  std::ofstream record_;
  std::vector<OperatorOrder> waiting_;
  std::deque<operator_answer_t> answers_;  // the last ones, given again when an order is repeated
  OperatorImage image_;
  TaskState state_{TaskState::starting};
  bool waits_for_trigger_{};
  bool trigger_due_{};
  int m_{};           // behaviour of the coordinator
  std::int64_t i_{};  // of the last take()
  bool stop_{};
  bool emergency_{};
  link::Process::Clock::time_point repeated_{};
};

}  // namespace mrroc::mp
