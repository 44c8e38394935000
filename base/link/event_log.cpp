#include "base/link/event_log.hpp"

#include <fmt/core.h>
#include <lcm/eventlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "base/fault.hpp"
#include "base/link/senders.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kSessionAt = 8;  // of header_t::session, behind LCM's fingerprint
constexpr std::size_t kNumberAt = 16;  // of header_t::number, behind the session

std::int64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t number = 0;
  for (const std::uint8_t b : bytes) number = number << 8 | b;
  return static_cast<std::int64_t>(number);
}

}  // namespace

struct EventLog::File {
  lcm_eventlog_t* log;
};

EventLog::EventLog(const std::filesystem::path& file, std::int64_t session)
    : file_(std::make_unique<File>(File{lcm_eventlog_create(file.c_str(), "w")})), session_(session) {
  if (!file_->log) throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}", file.string()));
}

EventLog::~EventLog() { lcm_eventlog_destroy(file_->log); }

bool EventLog::note(std::int64_t number, Heard& heard) noexcept {
  if (number <= heard.last) {
    if (heard.missing.erase(number) == 0) return false;
    --gaps_;
    return true;
  }
  // A stranger's number must not fill the memory.
  constexpr std::int64_t kRemembered = 1000;
  for (std::int64_t n = std::max(heard.last + 1, number - kRemembered); n < number; ++n)
    heard.missing.insert(n);
  gaps_ += number - heard.last - 1;
  heard.last = number;
  return true;
}

void EventLog::receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kNumberAt + 8 || big_endian(bytes.subspan(kSessionAt, 8)) != session_) return;
  const std::int64_t number = big_endian(bytes.subspan(kNumberAt, 8));
  auto it = heard_.find(channel);
  if (it == heard_.end()) it = heard_.emplace(channel, Heard{}).first;
  if (!has_several_senders(channel) && !note(number, it->second)) return;

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
