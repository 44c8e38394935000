// Behaviours of a run's arms: their names, and the times of their execution.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/time_chart.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Names of behaviours, as the agents and the task have told them.
class BehaviourNames {
 public:
  explicit BehaviourNames(const RunRecord& run);

  /// @param arm  its key @param m  as in its report: the agent's own number, or the coordinator's where the agent does
  ///             nothing but what the coordinator orders
  /// @return the name; empty: it was not told
  [[nodiscard]] std::string name(const std::string& arm, int m) const;
  /// @return why names are missing: the log's messages that tell them are of another version; empty: they are not
  [[nodiscard]] const std::string& missing() const { return missing_; }

 private:
  void learn(const std::string& arm, int m, const std::string& behaviour);

  std::map<std::pair<std::string, int>, std::string> names_;  // of arm and m
  std::map<int, std::string> coordinator_;
  std::string missing_;
};

/// @return the behaviours that an arm reported, in the order of time; stretches without a number are left out
[[nodiscard]] std::vector<TimeBand> behaviour_bands(const RunRecord& run, const BehaviourNames& names,
                                                    const std::string& arm);

}  // namespace mrroc::ui
