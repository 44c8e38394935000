#include "base/link/log_reader.hpp"

#include <fmt/format.h>
#include <lcm/eventlog.h>

#include <algorithm>
#include <memory>
#include <set>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kHeaderAt = 8;  // behind LCM's fingerprint

std::int64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t number = 0;
  for (const std::uint8_t b : bytes) number = number << 8U | b;
  return static_cast<std::int64_t>(number);
}

}  // namespace

RawHeader header_of(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kHeaderAt + 24) return {};
  return {big_endian(bytes.subspan(kHeaderAt, 8)), big_endian(bytes.subspan(kHeaderAt + 8, 8)),
          big_endian(bytes.subspan(kHeaderAt + 16, 8))};
}

LogReader::LogReader(const std::filesystem::path& where) {
  const std::filesystem::path file = std::filesystem::is_directory(where) ? where / kEventLog : where;
  const std::unique_ptr<lcm_eventlog_t, decltype(&lcm_eventlog_destroy)> log(
      lcm_eventlog_create(file.c_str(), "r"), &lcm_eventlog_destroy);
  if (!log) throw FaultError(FaultCode::bad_log, fmt::format("cannot read {}", file.string()));
  while (lcm_eventlog_event_t* const event = lcm_eventlog_read_next_event(log.get())) {
    const std::string channel(event->channel, static_cast<std::size_t>(event->channellen));
    const auto* const data = static_cast<const std::uint8_t*>(event->data);
    const std::size_t point = channel.find('.');
    if (session_.empty() && point != std::string::npos) session_ = channel.substr(0, point);
    messages_.push_back({event->timestamp, channel.substr(point + 1), {data, data + event->datalen}});
    lcm_eventlog_free_event(event);
  }
  if (messages_.empty())
    throw FaultError(FaultCode::bad_log, fmt::format("{} holds no message", file.string()));
}

std::vector<std::string> LogReader::channels() const {
  std::set<std::string> names;
  for (const LoggedMessage& m : messages_) names.insert(m.channel);
  return {names.begin(), names.end()};
}

std::int64_t LogReader::session_id() const {
  const auto supervisor = std::ranges::find(messages_, "supervisor", &LoggedMessage::channel);
  return header_of((supervisor == messages_.end() ? messages_.front() : *supervisor).bytes).session;
}

}  // namespace mrroc::link
