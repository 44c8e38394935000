#include "base/link/log_tail.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "base/fault.hpp"
#include "base/link/event_reader.hpp"

namespace mrroc::link {

LogTail read_tail(const std::filesystem::path& file, std::uintmax_t most, std::uintmax_t end) {
  LogTail tail;
  std::error_code error;
  const std::uintmax_t size = std::min(std::filesystem::file_size(file, error), end);
  if (error) return tail;
  tail.whole = size <= most;
  try {
    EventReader reader(file, size - std::min(size, most), size);
    while (const auto event = reader.next()) {
      // Behind the session's name.
      const auto channel = event->channel.substr(event->channel.find('.') + 1);
      tail.messages.push_back(
          {event->time_us, std::string(channel), {event->bytes.begin(), event->bytes.end()}});
    }
  } catch (const FaultError&) {
    return {};
  }
  return tail;
}

}  // namespace mrroc::link
