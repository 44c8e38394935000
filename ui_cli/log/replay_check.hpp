// Checks processes that listen to the replay of their own run: compares their messages with the logged ones.
#pragma once
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/link/bus.hpp"
#include "base/link/log_check.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Compares, while a replay goes on, every message of some processes with the logged one, bit for bit. The replay waits
/// for each of them, as the run did in lock-step.
class ReplayCheck {
 public:
  /// @param bus, run   must outlive the check  @param session  name before the channels
  /// @param processes  names, as in the run's processes.json
  /// @throws FaultError bad_usage: the run has no such process, or went by the wall clock; bad_log: it does not tell
  ///         what the process sent
  ReplayCheck(link::Bus& bus, const RunRecord& run, const std::string& session,
              const std::vector<std::string>& processes);
  ~ReplayCheck();
  ReplayCheck(const ReplayCheck&) = delete;
  ReplayCheck& operator=(const ReplayCheck&) = delete;

  /// @return channels that the processes publish, without the session: the replay leaves them out
  [[nodiscard]] const std::set<std::string>& channels() const { return channels_; }
  /// @return whether every process has told that it waits for the beginning
  /// @throws FaultError why one of them cannot
  [[nodiscard]] bool ready() const;
  /// @return whether what the process was to say with this message has come, or never will: the replay may go on
  bool passed(const link::LoggedMessage& m);
  /// The process has ended; what it has not said by now it never will. @param how  as Child::ended()
  void ended(const std::string& process, const std::string& how);
  /// That message is not waited for any more, and none of its process after it.
  void give_up(const link::LoggedMessage& m);
  /// The replay has ended before the log has.
  void cut_short();

  /// @return one per process
  [[nodiscard]] std::vector<link::LogVerdict> verdicts() const;

 private:
  struct ReplayedNode;
  [[nodiscard]] ReplayedNode* sender(const std::string& channel);

  std::set<std::string> channels_;
  std::vector<std::unique_ptr<ReplayedNode>> nodes_;
};

}  // namespace mrroc::ui
