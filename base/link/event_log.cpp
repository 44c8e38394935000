#include "base/link/event_log.hpp"

#include <fmt/core.h>
#include <lcm/eventlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>

#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/senders.hpp"
#include "base/msg/message_type.hpp"

namespace mrroc::link {
namespace {

constexpr std::size_t kHead = 28;  // of an event of LCM's log

/// @return whether it could be written
bool write(lcm_eventlog_t& log, const std::string& channel, std::int64_t number, std::int64_t time_us,
           std::span<const std::uint8_t> bytes) {
  lcm_eventlog_event_t event{};
  event.eventnum = number;
  event.timestamp = time_us;
  event.channellen = static_cast<int>(channel.size());
  event.datalen = static_cast<int>(bytes.size());
  event.channel = const_cast<char*>(channel.c_str());
  event.data = const_cast<std::uint8_t*>(bytes.data());
  return lcm_eventlog_write_event(&log, &event) == 0;
}

}  // namespace

struct EventLog::File {
  lcm_eventlog_t* log;
};

EventLog::EventLog(const std::filesystem::path& file, std::int64_t session, std::uintmax_t limit)
    : file_(std::make_unique<File>(File{lcm_eventlog_create(file.c_str(), "w")})),
      session_(session),
      limit_(limit) {
  if (!file_->log) throw FaultError(FaultCode::cannot_write, fmt::format("cannot write {}", file.string()));
}

EventLog::~EventLog() { lcm_eventlog_destroy(file_->log); }

std::size_t EventLog::largest() const noexcept {
  static const std::size_t size = std::ranges::max(message_types(), {}, &MessageType::size).size;
  return size;
}

bool EventLog::note(std::int64_t number, Heard& heard) {
  if (number <= heard.last) {
    if (heard.missing.erase(number) == 0) return false;
    --gaps_;
    return true;
  }
  // A number that jumps must not fill the memory.
  constexpr std::int64_t kRemembered = 1000;
  for (std::int64_t n = std::max(heard.last + 1, number - kRemembered); n < number; ++n)
    heard.missing.insert(n);
  gaps_ += number - heard.last - 1;
  heard.last = number;
  return true;
}

void EventLog::receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  try {
    take(channel, bytes);
  } catch (const std::bad_alloc&) {
    failed_ = true;
  }
}

void EventLog::take(std::string_view channel, std::span<const std::uint8_t> bytes) {
  const RawHeader header = header_of(bytes);
  if (header.session != session_) return;
  auto it = heard_.find(channel);
  const std::int64_t last = it == heard_.end() ? 0 : it->second.last;
  const bool numbered = !has_several_senders(channel);
  if (numbered && !plausible({header.session, header.number, header.stamp}, last)) return;
  if (it == heard_.end()) it = heard_.emplace(channel, Heard{}).first;
  if (numbered && !note(header.number, it->second)) return;

  using namespace std::chrono;
  const std::int64_t time = duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
  const std::uintmax_t size = kHead + channel.size() + bytes.size();
  if (left_out_ > 0 || size_ + size > limit_) return keep(channel, time, bytes);
  if (failed_) return;
  failed_ = !write(*file_->log, it->first, events_++, time, bytes);
  size_ += size;
}

void EventLog::keep(std::string_view channel, std::int64_t time_us, std::span<const std::uint8_t> bytes) {
  const auto size = [](const LeftOut& m) { return kHead + m.channel.size() + m.bytes.size(); };
  tail_.push_back(
      std::make_shared<LeftOut>(LeftOut{std::string(channel), time_us, {bytes.begin(), bytes.end()}}));
  ++left_out_;
  tail_size_ += size(*tail_.back());
  for (; tail_size_ > kTail; tail_.pop_front()) tail_size_ -= size(*tail_.front());
}

void EventLog::write_tail(const std::filesystem::path& file) const {
  if (tail_.empty()) return;
  const std::unique_ptr<lcm_eventlog_t, decltype(&lcm_eventlog_destroy)> log(
      lcm_eventlog_create(file.c_str(), "w"), &lcm_eventlog_destroy);
  std::int64_t number = 0;
  for (const auto& m : tail_)
    if (!log || !write(*log, m->channel, number++, m->time_us, m->bytes)) return;
}

bool EventLog::flush() noexcept {
  failed_ = std::fflush(file_->log->f) != 0 || failed_;
  return !failed_;
}

}  // namespace mrroc::link
