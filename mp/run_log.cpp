#include "mp/run_log.hpp"

#include <fmt/core.h>

#include "base/link/log_reader.hpp"

namespace mrroc::mp {

RunLog::RunLog(const std::filesystem::path& folder, link::Bus& bus, const link::NodeContext& session,
               const Config& config)
    : folder_(folder),
      reserve_(folder),
      log_(folder / link::kEventLog, session.session_id, link::read_log_limit(config)) {
  bus.subscribe_all(session.session + ".", log_);
}

link::LogEnd RunLog::flush() {
  log_.flush();
  return log_.end();
}

std::optional<std::string> RunLog::news(std::int64_t i) {
  if (log_.left_out() == 0 || end_told_) return std::nullopt;
  end_told_ = true;
  return fmt::format(
      "events.lcmlog has reached log.limit_mb and ends in macrostep {}; the run goes on, its last seconds "
      "will be in {}",
      i, link::kEventTail);
}

bool RunLog::close() {
  const bool whole = log_.flush();
  reserve_.release();
  return whole;
}

void RunLog::report_figures(Figures& figures) const {
  if (log_.left_out() > 0) {
    log_.write_tail(folder_ / link::kEventTail);
    figures["log_left_out"] = static_cast<double>(log_.left_out());
  }
  if (log_.gaps() > 0) figures["log_gaps"] = static_cast<double>(log_.gaps());
}

Fault log_fault() { return {.code = FaultCode::cannot_write, .text = "events.lcmlog in the run folder"}; }

}  // namespace mrroc::mp
