// The log of a run: every message of its processes, with room reserved for what is written at the end.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/config.hpp"
#include "base/link/bus.hpp"
#include "base/link/event_log.hpp"
#include "base/link/process.hpp"
#include "mp/room_reserve.hpp"
#include "mp/run_folder.hpp"

namespace mrroc::mp {

/// events.lcmlog of a run folder, while the run goes on.
class RunLog {
 public:
  /// Hears everything of a session from now on.
  /// @param bus  must outlive this object  @param config  of the run
  /// @throws FaultError cannot_write
  RunLog(const std::filesystem::path& folder, link::Bus& bus, const link::NodeContext& session,
         const Config& config);

  /// Writes down what has been received. @return the moment up to which a reader finds it
  link::LogEnd flush();
  /// @return whether it cannot be written
  [[nodiscard]] bool failed() const { return log_.failed(); }
  /// @param i  present macrostep @return a line, once, when the log has reached its bound
  [[nodiscard]] std::optional<std::string> news(std::int64_t i);

  /// The run is over: writes down the rest, and frees the room that was kept. @return false: the log is not whole
  bool close();
  /// Writes what came after the end of the log to a file of its own, and reports that and gaps in figures.
  void report_figures(Figures& figures) const;

 private:
  std::filesystem::path folder_;
  RoomReserve reserve_;
  link::EventLog log_;
  bool end_told_{};
};

/// @return the error of a log that cannot be written
[[nodiscard]] Fault log_fault();

}  // namespace mrroc::mp
