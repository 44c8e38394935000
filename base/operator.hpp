// The orders that the operator can give to a running task, and the states in which the task accepts them.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace mrroc {

/// Orders of the operator to a task (UI -> MP). trigger is the papers' signal that ends a behaviour which
/// waits for it. emergency_stop goes to MP and to every effector driver: the drives brake in the next step.
enum class OperatorOrder : std::uint8_t { start, pause, resume, trigger, stop, emergency_stop };
/// All orders, by number.
inline constexpr std::array kOperatorOrders{OperatorOrder::start,  OperatorOrder::pause,
                                            OperatorOrder::resume, OperatorOrder::trigger,
                                            OperatorOrder::stop,   OperatorOrder::emergency_stop};

/// @return name of the order, as terminals and scripts have it; "?" for a number without a name
constexpr std::string_view to_string(OperatorOrder o) {
  switch (o) {
    case OperatorOrder::start:
      return "start";
    case OperatorOrder::pause:
      return "pause";
    case OperatorOrder::resume:
      return "resume";
    case OperatorOrder::trigger:
      return "trigger";
    case OperatorOrder::stop:
      return "stop";
    case OperatorOrder::emergency_stop:
      return "e-stop";
  }
  return "?";
}

/// State of a task as the operator sees it.
/// ending: the arms rest and the processes are gone; figures, tables and pictures are being made.
enum class TaskState : std::uint8_t { starting, waiting_for_start, running, paused, stopping, ending, ended };

/// @return name of the state, as terminals show it; "?" for a number without a name
constexpr std::string_view to_string(TaskState s) {
  switch (s) {
    case TaskState::starting:
      return "starting";
    case TaskState::waiting_for_start:
      return "waiting for start";
    case TaskState::running:
      return "running";
    case TaskState::paused:
      return "paused";
    case TaskState::stopping:
      return "stopping";
    case TaskState::ending:
      return "ending";
    case TaskState::ended:
      return "ended";
  }
  return "?";
}

/// x_cT_0h: the operator as the coordinator sees him (MS 23).
struct OperatorImage {
  std::int64_t trigger{};  ///< number of triggers given so far; an edge is a larger number
  bool started{};          ///< start has been given
  bool paused{};           ///< task time is to stand still
};

}  // namespace mrroc
