// The command `ui_cli replay RUN`: sends the messages of a run again, at their pace, on a session of their
// own, for terminals, viewers, and virtual sensors, whose output is compared with the log.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/link/bus.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/log/log_check.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Order for a replay.
struct ReplayOptions {
  double speed{1};                ///< simulated seconds per second; 0: as fast as possible
  double from{0};                 ///< simulated time at which to begin [s]
  std::set<std::string> without;  ///< channels that somebody else publishes, without the session
  class ReplayCheck* check{};     ///< of what somebody else publishes; none: nothing is compared
};

/// Publishes a log. It never looks at a clock itself.
class Replay {
 public:
  /// @param bus, run  must outlive the replay  @param session  name before the channels
  Replay(link::Bus& bus, const RunRecord& run, const std::string& session, const ReplayOptions& options);

  /// Publishes everything up to a simulated time [s], or up to what is waited for.
  /// @return false when the log is at its end
  bool go_on_to(double time);
  /// @return whether it waits for a message of a process that listens
  [[nodiscard]] bool waits() const { return waits_; }
  /// Publishes what came last once more: some of it may have been lost.
  void repeat();
  /// Goes on without the message that is waited for.
  void give_up();
  /// @return simulated time of the next message, or of the last one [s]
  [[nodiscard]] double time() const { return time_; }
  /// @return messages published, each counted once however often it was repeated
  [[nodiscard]] std::int64_t published() const { return published_; }
  /// @return whether a terminal has ordered stop; every other order is refused
  [[nodiscard]] bool stopped() const;

 private:
  class CommandServer;
  void publish(const link::LoggedMessage& m);

  link::Bus& bus_;
  const RunRecord& run_;
  std::string session_;
  ReplayOptions options_;
  std::shared_ptr<CommandServer> command_server_;
  std::size_t next_{};
  bool waits_{};
  double time_{};
  std::int64_t published_{};
};

/// Sessions, transport and programs that the command uses.
struct ReplayEnvironment {
  std::filesystem::path sessions;  ///< directory of the running sessions
  /// Makes the end of the transport on which is published.
  std::function<std::unique_ptr<link::Bus>(const link::SessionInfo&)> open;
  Prover prove{programs_beside()};  ///< tells which processes messages alone can drive
};

/// Runs the command. @param arguments behind the word replay
/// @return exit status
int run_replay(const std::vector<std::string>& arguments, const ReplayEnvironment& environment,
               std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
