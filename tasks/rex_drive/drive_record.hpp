// Records what a platform and its simulation tell, and joins it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "base/msg/convert_platform.hpp"
#include "tasks/rex_drive/drive_table.hpp"

namespace mrroc::rex_drive {

/// Messages of a run, in the order of their stamps.
struct DriveMessages {
  std::vector<platform_reply_t> replies;        ///< of the driver
  std::vector<platform_telemetry_t> telemetry;  ///< of the driver
  std::vector<platform_truth_t> truths;         ///< of the simulation; none: the platform is real
  std::vector<map_report_t> poses;              ///< of the map agent

  /// Forgets what is stamped with a later macrostep: how much of the end comes before MP looks for the last time differs
  /// from run to run.
  void cut_after(std::int64_t macrostep);
};

/// @return a row for every reply that has a telemetry of its reading and a truth about it
[[nodiscard]] DriveTable join(const DriveMessages& messages, double dt, int n_s);

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
  /// @return the fragments, in their order
  [[nodiscard]] const FragmentTable& fragments() const { return fragments_; }

 private:
  void collect_fragments(std::int64_t plan);

  std::unique_ptr<link::Inbox<platform_command_t>> command_in_;
  std::unique_ptr<link::Inbox<platform_reply_t>> reply_in_;
  std::unique_ptr<link::Inbox<platform_telemetry_t>> telemetry_in_;
  std::unique_ptr<link::Inbox<platform_truth_t>> truth_in_;
  std::unique_ptr<link::Inbox<map_report_t>> pose_in_;
  DriveMessages messages_;
  FragmentTable fragments_;
  std::int64_t commands_until_{-1};  // stamp
};

}  // namespace mrroc::rex_drive
