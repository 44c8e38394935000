// What the operator's terminals see of a running task.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "base/transmission.hpp"
#include "mp/supervisor.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::mp {

/// Publishes task_status_t ten times a second of wall time.
class StatusBoard {
 public:
  StatusBoard(link::Process& process, const Supervisor& supervisor, const std::string& task,
              const std::vector<std::string>& arms);

  void set_behaviour(int m, std::string_view name);
  void set_state(TaskState state);
  /// @param share  of the task that is done, 0..1
  void set_progress(double share, const std::string& text);
  void set_time(double sim_s);
  /// @param sensor_text  name of the sensor's reading
  void set_arm(std::size_t arm, const Report& report, std::string_view sensor_text);

  /// Publishes when it is time.
  void poll();
  /// Publishes now.
  void publish();

 private:
  const Supervisor& supervisor_;
  link::Outbox<task_status_t> out_;
  task_status_t status_{};
  link::Process::Clock::time_point last_{};
  double last_sim_s_{};
};

}  // namespace mrroc::mp
