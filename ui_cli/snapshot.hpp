// The status of a task at one moment, as the terminal uses it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/effector_kind.hpp"
#include "base/fault.hpp"
#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::ui {

/// One embodied agent.
struct AgentView {
  std::string name;           ///< key of the arm or platform
  EffectorKind effector{};    ///< what it has
  int m{};                    ///< its behaviour, 0: it has none, or one without a number
  std::string behaviour;      ///< its name; empty: it has not told any
  std::string ended_because;  ///< the behaviour before it, and why it ended; may be empty
  bool position_known{};  ///< its motors have been synchronised; without it T_0E, F_a and velocity are zeros
  std::array<double, 6>
      T_0E{};  ///< pose of E in the arm's base, of a platform on the map [m], angle-axis [rad]
  std::array<double, 6> F_a{};       ///< adjusted force in E [N], [N m]
  std::array<double, 3> velocity{};  ///< of a platform along B: vx, vy [m/s], w [rad/s]
  std::string sensor;                ///< reading of its virtual sensor, such as the pen's state; may be empty
};

/// @return whether it has an arm or a platform
[[nodiscard]] inline bool has_effector(const AgentView& a) {
  return a.effector == EffectorKind::arm || a.effector == EffectorKind::platform;
}

/// One process.
struct ProcessView {
  std::string name;            ///< as in the roster
  link::ProcessState state{};  ///< a number without a name is shown as "?"
  double age{};                ///< [s] since it was last heard
};

/// A task_status_t whose counts, numbers of enumerators and texts have been checked. Values can be anything,
/// also not finite. Texts have no control characters.
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
  FaultCode fault{};                   ///< that ends the task, also a stop; none: nothing has ended it
  FaultCode last_code{};               ///< of last_message; none: information
  std::string last_message;            ///< the last line that a process said
  std::string run_folder;              ///< on the task's host; may be empty

  /// @return whether poses, forces and behaviours are of now: after an emergency stop, and when the task has ended, they
  ///         are those of the last macrostep that was reported
  [[nodiscard]] bool is_current() const {
    return state != TaskState::ended && fault != FaultCode::emergency_stop;
  }
};

/// @return what a pause does with what the agents have: "arms rest and keep their forces", "platforms stand", or both
[[nodiscard]] std::string resting(const Snapshot& s);

/// @param m any bytes that have the size of a message
Snapshot snapshot(const task_status_t& m, const std::string& session);

}  // namespace mrroc::ui
