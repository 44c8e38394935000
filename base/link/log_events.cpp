#include "base/link/log_events.hpp"

#include <fmt/format.h>
#include <lcm/eventlog.h>

#include <memory>

#include "base/fault.hpp"

namespace mrroc::link {

std::int64_t pass_events(const std::filesystem::path& file, Sink& sink) {
  const std::unique_ptr<lcm_eventlog_t, decltype(&lcm_eventlog_destroy)> log(
      lcm_eventlog_create(file.c_str(), "r"), &lcm_eventlog_destroy);
  if (!log) throw FaultError(FaultCode::bad_log, fmt::format("cannot read {}", file.string()));
  std::int64_t count = 0;
  while (lcm_eventlog_event_t* const event = lcm_eventlog_read_next_event(log.get())) {
    sink.receive({event->channel, static_cast<std::size_t>(event->channellen)},
                 {static_cast<const std::uint8_t*>(event->data), static_cast<std::size_t>(event->datalen)});
    lcm_eventlog_free_event(event);
    ++count;
  }
  if (count == 0) throw FaultError(FaultCode::bad_log, fmt::format("{} holds no message", file.string()));
  return count;
}

}  // namespace mrroc::link
