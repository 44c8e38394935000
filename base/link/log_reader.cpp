#include "base/link/log_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "base/big_endian.hpp"
#include "base/fault.hpp"
#include "base/link/event_reader.hpp"
#include "base/link/senders.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kHeaderAt = 8;  // behind LCM's fingerprint

}  // namespace

RawHeader header_of(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kHeaderAt + 24) return {};
  const auto number = [&](std::size_t at) {
    return static_cast<std::int64_t>(big_endian(bytes.subspan(kHeaderAt + at, 8)));
  };
  return {number(0), number(8), number(16)};
}

LogReader::LogReader(const std::filesystem::path& where) {
  const std::filesystem::path file = std::filesystem::is_directory(where) ? where / kEventLog : where;
  EventReader reader(file);
  while (const auto event = reader.next()) {
    const std::string_view channel = event->channel;
    const std::size_t point = channel.find('.');
    if (session_.empty() && point != std::string_view::npos) session_ = channel.substr(0, point);
    messages_.push_back(
        {event->time_us, std::string(channel.substr(point + 1)), {event->bytes.begin(), event->bytes.end()}});
  }
  damaged_ = reader.damaged();
  if (messages_.empty())
    throw FaultError(FaultCode::bad_log, fmt::format("{} holds no message", file.string()));
  put_late_ones_in_their_place();
}

void LogReader::put_late_ones_in_their_place() {
  struct Place {
    std::size_t at;       // of the first message of the channel with this number or a higher one
    std::int64_t number;  // of the message; the same for all where numbers tell no order
    std::size_t written;
  };
  std::map<std::string_view, std::vector<Place>> by_channel;
  for (std::size_t k = 0; k < messages_.size(); ++k) {
    const LoggedMessage& m = messages_[k];
    const bool ordered = !has_several_senders("." + m.channel);
    by_channel[m.channel].push_back({k, ordered ? header_of(m.bytes).number : 0, k});
  }
  std::vector<Place> places;
  for (auto& [name, channel] : by_channel) {
    std::ranges::stable_sort(channel, {}, &Place::number);
    for (std::size_t k = channel.size(); k-- > 1;)
      channel[k - 1].at = std::min(channel[k - 1].at, channel[k].at);
    places.insert(places.end(), channel.begin(), channel.end());
  }
  std::ranges::stable_sort(places, {}, &Place::at);
  std::vector<LoggedMessage> sorted;
  sorted.reserve(messages_.size());
  for (const Place& p : places) sorted.push_back(std::move(messages_[p.written]));
  messages_ = std::move(sorted);
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
