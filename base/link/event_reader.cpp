#include "base/link/event_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/big_endian.hpp"
#include "base/fault.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/msg/message_type.hpp"

namespace mrroc::link {
namespace {

constexpr std::array<std::uint8_t, 4> kWord{0xed, 0xa1, 0xda, 0x01};
// An event: the word, its number (8 bytes), its time (8), the lengths of channel and message (4 each), and these two.
constexpr std::size_t kTimeAt = 12, kChannelLengthAt = 20, kMessageLengthAt = 24, kEventHeader = 28;
constexpr std::size_t kRead = 1U << 20U;  // bytes at a time

bool is_printable(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

EventReader::EventReader(const std::filesystem::path& file, std::uintmax_t from, std::uintmax_t to)
    : left_(to - std::min(from, to)) {
  std::error_code error;
  const auto fail = [&](const char* why) {
    throw FaultError(FaultCode::bad_log, fmt::format("cannot read {}: {}", file.string(), why));
  };
  if (!std::filesystem::exists(file, error)) fail("there is no such file");
  // Before it is opened: a process that opens a pipe waits for its other end.
  if (!std::filesystem::is_regular_file(file, error)) fail("this is not a file");
  file_.open(file, std::ios::binary);
  if (!file_ || !file_.seekg(static_cast<std::streamoff>(from))) fail("look at its permissions");
}

bool EventReader::fill(std::size_t bytes) {
  if (buffer_.size() - at_ >= bytes) return true;
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ = 0;
  while (buffer_.size() < bytes && file_ && left_ > 0) {
    const std::size_t before = buffer_.size();
    const auto most = static_cast<std::size_t>(std::min<std::uintmax_t>(kRead, left_));
    buffer_.resize(before + most);
    file_.read(reinterpret_cast<char*>(buffer_.data() + before), static_cast<std::streamsize>(most));
    const auto read = static_cast<std::size_t>(file_.gcount());
    buffer_.resize(before + read);
    left_ -= read;
  }
  return buffer_.size() >= bytes;
}

bool EventReader::word_at(std::size_t offset) {
  return fill(offset + kWord.size()) &&
         std::ranges::equal(std::span(buffer_).subspan(at_ + offset, kWord.size()), kWord);
}

bool EventReader::find_word() {
  while (fill(kWord.size())) {
    const auto begin = buffer_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto found = std::search(begin, buffer_.end(), kWord.begin(), kWord.end());
    if (found != buffer_.end()) {
      at_ = static_cast<std::size_t>(found - buffer_.begin());
      return true;
    }
    at_ = buffer_.size() - (kWord.size() - 1);  // its beginning may be the end of the buffer
  }
  return false;
}

std::optional<LogEvent> EventReader::event_here(std::size_t& size) {
  if (!fill(kEventHeader)) return {};
  const auto number = [&](std::size_t offset, std::size_t length) {
    return static_cast<std::int64_t>(big_endian(std::span(buffer_).subspan(at_ + offset, length)));
  };
  const auto channel = static_cast<std::size_t>(number(kChannelLengthAt, 4));
  const auto message = static_cast<std::size_t>(number(kMessageLengthAt, 4));
  if (channel < 1 || channel > kLongestChannel || message > kLargestDatagram) return {};
  size = kEventHeader + channel + message;
  if (!fill(size)) return {};
  const bool word_follows = word_at(size);  // may move the buffer: from here on it stays
  const std::span<const std::uint8_t> rest = std::span(buffer_).subspan(at_);
  const LogEvent event{number(kTimeAt, 8),
                       {reinterpret_cast<const char*>(rest.data() + kEventHeader), channel},
                       rest.subspan(kEventHeader + channel, message)};
  const bool sound = word_follows || rest.size() == size || type_of(event.bytes) != nullptr;
  return sound && is_printable(event.channel) ? std::optional(event) : std::nullopt;
}

std::optional<LogEvent> EventReader::next() {
  bool skipped = false;
  while (true) {
    if (!word_at(0)) {
      skipped = skipped || buffer_.size() > at_;
      if (!find_word()) break;
    }
    std::size_t size = 0;
    if (const auto event = event_here(size)) {
      damaged_ += skipped ? 1 : 0;
      at_ += size;
      return event;
    }
    skipped = true;
    at_ += kWord.size();
  }
  at_ = buffer_.size();
  damaged_ += skipped ? 1 : 0;
  return {};
}

}  // namespace mrroc::link
