// What a task told about itself at one moment, as the terminal uses it.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::ui {

/// One embodied agent.
struct AgentView {
  std::string name;              ///< key of the arm
  int m{};                       ///< its behaviour, 0: it has none, or one without a number
  std::string behaviour;         ///< its name; empty: it has not told any
  std::string ended_because;     ///< the behaviour before it, and why it ended; may be empty
  std::array<double, 6> T_0E{};  ///< pose of E in the arm's base [m], angle-axis [rad]
  std::array<double, 6> F_a{};   ///< adjusted force in E [N], [N m]
  std::string sensor;            ///< reading of its virtual sensor, such as the pen's state; may be empty

  /// @return whether T_0E is one: before homing it is zeros, which no arm can reach
  [[nodiscard]] bool pose_known() const {
    return std::ranges::any_of(T_0E, [](double x) { return x != 0; });
  }
};

/// One process.
struct ProcessView {
  std::string name;            ///< as in the roster
  link::ProcessState state{};  ///< a number without a name is shown as "?"
  double age{};                ///< [s] since it was last heard
};

/// A task_status_t whose counts, numbers of enumerators and texts have been checked. Values can be anything,
/// also not finite. Texts are printable ASCII.
struct Snapshot {
  std::string session;                 ///< its name
  std::int64_t session_id{};           ///< distinguishes runs with the same name
  std::string task;                    ///< its name
  TaskState state{};                   ///< a number without a name is shown as "?"
  bool waits_for_trigger{};            ///< the operator's trigger ends the present behaviour
  std::string early;                   ///< why a trigger now would come early; empty: it would not
  int m{};                             ///< behaviour of the coordinator, 0: none yet
  std::string behaviour;               ///< its name
  std::string ended_because;           ///< the behaviour before it, and why it ended
  std::int64_t macrostep{};            ///< 0: not told
  double sim_time{};                   ///< [s]
  double speed{};                      ///< simulated time per time
  std::optional<double> progress;      ///< share of the task that is done, at most 1; nothing: unknown
  std::string progress_text;           ///< what is being done; may be empty
  std::vector<AgentView> agents;       ///< at most 4
  std::vector<ProcessView> processes;  ///< at most 16
  FaultCode last_code{};               ///< of last_message; none: information
  std::string last_message;            ///< the last line that a process said
  std::string run_folder;              ///< on the task's host; may be empty
};

/// @param m any bytes that have the size of a message
Snapshot snapshot(const task_status_t& m, const std::string& session);

}  // namespace mrroc::ui
