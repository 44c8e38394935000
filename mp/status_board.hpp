// The status of a running task, as the operator's terminals show it.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/effector_kind.hpp"
#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "base/platform_path.hpp"
#include "base/transmission.hpp"
#include "mp/supervisor.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::mp {

/// Publishes task_status_t ten times a second of wall time. Behind the agents with arms and platforms it tells those without
/// an effector, of which the roster has a process ecp-AGENT, as far as there is room.
class StatusBoard {
 public:
  /// @param supervisor  must outlive the board  @param arms  keys of the agents' arms, in order; at most as many as the
  /// message has room for are told
  StatusBoard(link::Process& process, const Supervisor& supervisor, const std::string& task,
              const std::vector<std::string>& arms, const std::string& run_folder);

  /// A new behaviour is told at the next poll(): terminals and viewers learn the name of a short one, too. So are those
  /// of the agents, which the supervisor hears of.
  /// @param until  what it waits for, in words: why it will have ended; empty: it is told how long it has lasted
  void set_behaviour(int m, std::string_view name, std::string_view until);
  /// @param waits_for_trigger  whether the present behaviour ends with the operator's trigger
  void set_state(TaskState state, bool waits_for_trigger);
  /// @param why  why a trigger now would come early, such as "the hand is still drawing: 33 %"; empty: it would not
  void set_early(std::string_view why);
  /// @param share  of the task that is done, 0..1; negative: unknown
  void set_progress(double share, const std::string& text);
  /// @param macrostep  of the coordinator, 0: none yet  @param sim_s  simulated time [s]
  void set_time(std::int64_t macrostep, double sim_s);
  /// An agent is told to have an arm unless this says that it has something else.
  /// @param agent  one that the message has no room for is not told
  void set_effector(std::size_t agent, EffectorKind kind);
  /// @param arm  below the number that the message has room for  @param sensor_text  name of the sensor's reading
  void set_arm(std::size_t arm, const Report& report, std::string_view sensor_text);
  /// @param agent  that has a platform; one that the message has no room for is not told  @param v  of B, along B
  void set_velocity(std::size_t agent, const PlanarVelocity& v);

  /// @return number, name and end of the present behaviour, as they were set
  [[nodiscard]] int m() const { return status_.m; }
  [[nodiscard]] std::string behaviour() const;
  [[nodiscard]] const std::string& until() const { return until_; }
  /// @return share of the task that is done, 0..1
  [[nodiscard]] double progress() const { return status_.progress; }
  /// @return what changes while the run goes on: behaviour, progress and the drivers' states, in no words for people.
  /// While a driver homes it changes always: that ends by itself, no axis goes farther than its range
  [[nodiscard]] std::string watched() const;

  /// Publishes when it is time.
  void poll();
  /// Publishes now.
  void publish();

 private:
  void take_processes();
  /// @return place of the agent in the message, a new one if it has none yet; nothing: there is no room
  [[nodiscard]] std::optional<int> place_of(std::string_view agent);

  const Supervisor& supervisor_;
  link::Outbox<task_status_t> out_;
  task_status_t status_{};
  link::Process::Clock::time_point last_{};
  std::int64_t macrostep_{};
  double last_sim_s_{};
  bool news_{};                       // to be told at once
  std::vector<DriverState> drivers_;  // one per agent
  std::string until_;                 // of the present behaviour
  double begun_s_{};                  // simulated time at which it began [s]
  std::int64_t agents_begun_{};       // behaviours that the agents had begun when they were told
};

}  // namespace mrroc::mp
