#include "base/link/event_log.hpp"

#include <fmt/format.h>
#include <lcm/eventlog.h>

#include <chrono>
#include <cstdio>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kNumberAt = 16;  // of header_t::number, behind LCM's fingerprint and header_t::session

std::int64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t number = 0;
  for (const std::uint8_t b : bytes) number = number << 8 | b;
  return static_cast<std::int64_t>(number);
}

}  // namespace

struct EventLog::File {
  lcm_eventlog_t* log;
};

EventLog::EventLog(const std::filesystem::path& file, Channels several_senders)
    : file_(std::make_unique<File>(File{lcm_eventlog_create(file.c_str(), "w")})),
      several_senders_(std::move(several_senders)) {
  if (!file_->log) throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}", file.string()));
}

EventLog::~EventLog() { lcm_eventlog_destroy(file_->log); }

void EventLog::receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kNumberAt + 8) return;
  const std::int64_t number = big_endian(bytes.subspan(kNumberAt, 8));
  auto it = last_.find(channel);
  if (it == last_.end()) it = last_.emplace(channel, 0).first;
  if (!several_senders_.contains(channel)) {
    if (number <= it->second) return;
    gaps_ += number - it->second - 1;
    it->second = number;
  }

  using namespace std::chrono;
  lcm_eventlog_event_t event{};
  event.eventnum = events_++;
  event.timestamp = duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
  event.channellen = static_cast<int>(channel.size());
  event.datalen = static_cast<int>(bytes.size());
  event.channel = const_cast<char*>(it->first.c_str());
  event.data = const_cast<std::uint8_t*>(bytes.data());
  failed_ = lcm_eventlog_write_event(file_->log, &event) != 0 || failed_;
}

bool EventLog::flush() noexcept {
  failed_ = std::fflush(file_->log->f) != 0 || failed_;
  return !failed_;
}

}  // namespace mrroc::link
