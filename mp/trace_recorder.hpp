// Makes the rows of the arms' traces from the agents' reports, macrostep by macrostep.
#pragma once
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "base/transmission.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::mp {

/// Whose number a row's behaviour m has.
enum class TraceNumbers : std::uint8_t {
  coordinator,  ///< that of the coordinator's behaviour, which ordered the motion
  agents        ///< that of the agent's own behaviour, which commanded it
};

/// A row of macrostep i is about the motion that the reports of macrostep i are about (base/latency.hpp): its time is
/// that of the reading, and its m is the behaviour that was being executed then.
class TraceRecorder {
 public:
  /// @param dt   duration of a step [s]  @param n_s  steps of a macrostep, of which step n_s - 1 is that of the reading
  TraceRecorder(std::size_t arms, TraceNumbers numbers, double dt, int n_s);

  /// Takes note of macrostep i. Call it once per macrostep.
  /// @param m        coordinator: its behaviour, which sent the orders that are used in macrostep i
  /// @param reports  x_cT_0j of macrostep i, by the number of the arm
  void note(std::int64_t i, int m, std::span<const Report> reports);

  /// @return m of the motion that the arm's last report is about; 0: nothing was ordered so early
  [[nodiscard]] int executed(std::size_t arm) const;
  /// Adds a row of the last macrostep for every arm that is ready. @param traces  by the number of the arm
  void add_rows(std::span<ArmTrace> traces) const;

  /// @return simulated time of the readings that the reports of macrostep i have [s]
  [[nodiscard]] double measured_at(std::int64_t i) const;

 private:
  TraceNumbers numbers_;
  double dt_;
  int n_s_;
  std::size_t kept_;                   // of what was told, the last numbers of each arm
  std::vector<std::deque<int>> told_;  // by the number of the arm, newest first
  std::vector<Report> reports_;
  std::int64_t i_{};
};

}  // namespace mrroc::mp
