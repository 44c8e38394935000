// The folder of a run, for the log commands.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/link/log_reader.hpp"
#include "base/msg/message_type.hpp"

namespace mrroc::ui {

/// One process of a run, from processes.json.
struct LoggedProcess {
  std::string name;                    ///< in the roster
  std::string program;                 ///< beside ui_cli
  std::vector<std::string> arguments;  ///< beyond those that every node gets
  std::string build_id{};              ///< of the program that ran; empty: not known
};

/// What an agent moves.
enum class Effector : std::uint8_t { arm, platform, none };

/// A run folder.
class RunRecord {
 public:
  /// @throws FaultError bad_log: it is no run folder
  explicit RunRecord(const std::filesystem::path& folder);

  /// @return as given to the constructor
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// @return all messages of the run
  [[nodiscard]] const link::LogReader& log() const { return log_; }
  /// @return duration of a macrostep [s]; of a step [s]
  [[nodiscard]] double macrostep_s() const { return macrostep_s_; }
  [[nodiscard]] double step_s() const { return step_s_; }
  /// @return "step" or "wall"
  [[nodiscard]] const std::string& clock() const { return clock_; }
  /// @return name of the task
  [[nodiscard]] const std::string& task() const { return task_; }
  /// @return what ran; empty when the folder does not tell
  [[nodiscard]] const std::vector<LoggedProcess>& processes() const { return processes_; }
  /// @return keys of the agents, in order: those of which there are reports
  [[nodiscard]] std::vector<std::string> agents() const;
  /// @return what the agent moves; an agent of a log without platforms is one of an arm
  [[nodiscard]] Effector effector_of(const std::string& agent) const;

  /// @return simulated time that the message is for [s], or nothing: it is for none, ends its link, or is of
  ///         another version. Its definition says how it tells the time
  [[nodiscard]] std::optional<double> time_of(const link::LoggedMessage& m) const;

 private:
  std::filesystem::path folder_;
  link::LogReader log_;
  double step_s_{};
  double macrostep_s_{};
  std::string clock_{"step"};
  std::string task_;
  std::vector<LoggedProcess> processes_;
  std::vector<std::string> platforms_;  // keys
  std::vector<std::string> arms_;       // those of the configuration
};

/// @throws FaultError bad_usage when the log has no such channel, naming the nearest
void check_channel(const RunRecord& run, const std::string& channel);

/// @return whether the messages of a channel are made by the clock of the wall: signs of life, answers, what
///         the supervisor repeats. They differ from run to run
[[nodiscard]] bool by_wall_clock(std::string_view channel);

/// @return a message in a line: "header.stamp=12 m=3 ...", what is zero left out
[[nodiscard]] std::string message_text(const link::LoggedMessage& m);

}  // namespace mrroc::ui
