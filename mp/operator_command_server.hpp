// Receives the operator's orders from a terminal, a script file or a scripted operator.
#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.hpp"
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
class OperatorCommandServer {
 public:
  /// @param record  where taken orders are written; empty: nowhere
  OperatorCommandServer(link::Process& process, std::vector<ScriptedOrder> script,
                        const std::filesystem::path& record);

  /// Answers what has come from terminals. Call it often. A stop has its last answer from settle_stops(); a start, a pause and
  /// a resumption from the next set_state() that tells another state.
  void poll();

  /// An order that no terminal has sent; ignored when it is not allowed.
  /// @param by  who is told to have given a stop: the operator, or the signal that does the same
  /// @return whether it is allowed
  bool give(OperatorOrder order, std::string_view by = "operator");

  /// Takes the orders for macrostep i.
  /// @return the operator's image
  OperatorImage take(std::int64_t i);

  /// Takes a stop that waits for a macrostep, and nothing else, at once.
  /// @param i  macrostep that a script has to name for the same stop
  /// @return whether one waited
  bool take_stop(std::int64_t i);

  /// Present state of the task, which decides which orders are allowed.
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
  /// Tells the terminals what has become of the stops that they have ordered: they wait for it.
  /// @param failure  the process that has not confirmed it, and what was done; code none: all have confirmed
  /// @param who      the processes that have confirmed it, in words
  void settle_stops(const Fault& failure, const std::string& who);
  /// @return whether a terminal waits for that
  [[nodiscard]] bool stop_waits() const;
  /// @return the order without which the present state does not end, such as "trigger 2"; empty: it needs none
  [[nodiscard]] std::string needed() const;
  /// @return macrostep of the script's next order; nothing: there is no script, or it has ended
  [[nodiscard]] std::optional<std::int64_t> next_in_script() const;
  /// @return whether a terminal has given an order in this run, accepted or not
  [[nodiscard]] bool has_terminal() const { return !answers_.empty(); }
  /// @return whether an emergency stop has been accepted; it does not wait for a macrostep
  [[nodiscard]] bool emergency() const { return emergency_; }
  /// Tells the effector drivers of the emergency stop once more: they may have missed the terminal's message, and
  /// of one in a script nobody else tells them. Does nothing without one, or soon after the last time.
  void repeat_emergency();

 private:
  void answer(const operator_order_t& m);
  [[nodiscard]] std::optional<std::string> refusal_reason(OperatorOrder order) const;
  // Gives the last answers to pending orders: to stops, or to all others.
  void settle(bool of_stops, const Fault& failure, const std::string& how);
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
  std::vector<std::pair<std::int64_t, OperatorOrder>> pending_;  // accepted, not yet in force, by their id
  OperatorImage image_;
  TaskState state_{TaskState::starting};
  bool waits_for_trigger_{};
  bool trigger_due_{};
  int m_{};           // behaviour of the coordinator
  std::int64_t i_{};  // of the last take()
  bool stop_{};
  std::string stop_by_{"operator"};
  bool emergency_{};
  link::Process::Clock::time_point repeated_{};
};

}  // namespace mrroc::mp
