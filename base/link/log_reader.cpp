#include "base/link/log_reader.hpp"

#include <fmt/format.h>
#include <lcm/eventlog.h>

#include <memory>

#include "base/fault.hpp"

namespace mrroc::link {

LogReader::LogReader(const std::filesystem::path& file) {
  const std::unique_ptr<lcm_eventlog_t, decltype(&lcm_eventlog_destroy)> log(
      lcm_eventlog_create(file.c_str(), "r"), &lcm_eventlog_destroy);
  if (!log) throw FaultError(FaultCode::bad_log, fmt::format("cannot read {}", file.string()));
  while (lcm_eventlog_event_t* const event = lcm_eventlog_read_next_event(log.get())) {
    const std::string channel(event->channel, static_cast<std::size_t>(event->channellen));
    const auto* const data = static_cast<const std::uint8_t*>(event->data);
    bytes_[channel.substr(channel.find('.') + 1)].emplace_back(data, data + event->datalen);
    lcm_eventlog_free_event(event);
  }
  if (bytes_.empty()) throw FaultError(FaultCode::bad_log, fmt::format("{} holds no message", file.string()));
}

std::vector<std::string> LogReader::channels() const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : bytes_) names.push_back(name);
  return names;
}

}  // namespace mrroc::link
