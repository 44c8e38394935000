// Records what a platform and its simulation tell, and joins it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/link/log_reader.hpp"
#include "base/link/process.hpp"
#include "base/msg/convert_platform.hpp"
#include "tasks/rex_drive/drive_table.hpp"

namespace mrroc::rex_drive {

/// Pace that was commanded for a macrostep.
struct CommandedPace {
  std::int64_t macrostep{};  ///< in which it is obeyed
  double pace{1};            ///< PlatformCommand::pace
};

/// Messages of a run, in the order of their stamps.
struct DriveMessages {
  std::vector<platform_reply_t> replies;        ///< of the driver
  std::vector<platform_telemetry_t> telemetry;  ///< of the driver
  std::vector<platform_truth_t> truths;         ///< of the simulation; none: the platform is real
  std::vector<map_report_t> poses;              ///< of the map agent
  std::vector<odometry_reading_t> odometry;     ///< of the visual odometry; none: the platform has no eyes
  std::vector<CommandedPace> paces;             ///< of the commands; the paces of others are 1

  /// Forgets what is stamped with a later macrostep: how much of the end comes before MP looks for the last time differs
  /// from run to run. Of the odometry it forgets what need not have come by then.
  /// @param odometry_latency  steps that its readings take
  void cut_after(std::int64_t macrostep, std::int64_t odometry_latency = 0);
  /// Adds what came later than the messages here: MP does not listen while a platform that was stopped comes to rest.
  /// @param log  of the run @param platform  key
  void add_rest(const link::LogReader& log, const std::string& platform);
};

/// @return a row for every reply that has a telemetry of its reading and a truth about it
[[nodiscard]] DriveTable join(const DriveMessages& messages, double dt, int n_s);

/// @return when the map was valid again after it had been lost, or believed after it had jumped: after two positions in a row
///         that were not [s]
[[nodiscard]] std::vector<double> map_returns(const DriveMessages& messages, double dt, int n_s);

/// Collects the messages of a run. Used by MP's thread.
class DriveRecord {
 public:
  /// Make this before the process assembles. @param platform  key
  DriveRecord(link::Process& process, const std::string& platform);

  /// Takes what has come; to be called at least every ten macrosteps.
  /// @param plan  number of the plan that is being executed
  void collect(std::int64_t plan);
  /// @return everything that has come
  [[nodiscard]] const DriveMessages& messages() const { return messages_; }
  /// @return the newest reading of the odometry; null: there is none
  [[nodiscard]] const odometry_reading_t* newest_odometry() const {
    return messages_.odometry.empty() ? nullptr : &messages_.odometry.back();
  }
  /// @return the fragments, in their order
  [[nodiscard]] const FragmentTable& fragments() const { return fragments_; }

 private:
  void collect_commands(std::int64_t plan);

  std::unique_ptr<link::Inbox<platform_command_t>> command_in_;
  std::unique_ptr<link::Inbox<platform_reply_t>> reply_in_;
  std::unique_ptr<link::Inbox<platform_telemetry_t>> telemetry_in_;
  std::unique_ptr<link::Inbox<platform_truth_t>> truth_in_;
  std::unique_ptr<link::Inbox<map_report_t>> pose_in_;
  std::unique_ptr<link::Inbox<odometry_reading_t>> odometry_in_;
  DriveMessages messages_;
  FragmentTable fragments_;
  std::int64_t commands_until_{-1};  // stamp
};

}  // namespace mrroc::rex_drive
