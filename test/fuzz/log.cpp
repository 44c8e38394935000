// Logs of runs: what is read and written again as a log without damage reads as the same, and the viewer can show it.
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/replay_bus.hpp"
#include "test/fuzz/fuzz.hpp"
#include "ui_cli/view/listener.hpp"

using namespace mrroc;

namespace {

/// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content) : file_(::memfd_create("log", MFD_CLOEXEC)) {
    fuzz::require(
        file_ >= 0 && ::write(file_, content.data(), content.size()) == static_cast<ssize_t>(content.size()),
        "there is memory");
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

void put(std::string& bytes, std::uint64_t value, int size) {
  for (int k = size - 1; k >= 0; --k) bytes += static_cast<char>(value >> (8 * k));
}

std::string written(const link::LogReader& log) {
  std::string bytes;
  for (const link::LoggedMessage& m : log.messages()) {
    put(bytes, 0xEDA1DA01, 4);
    put(bytes, 0, 8);
    put(bytes, static_cast<std::uint64_t>(m.time_us), 8);
    put(bytes, m.channel.size(), 4);
    put(bytes, m.bytes.size(), 4);
    bytes += m.channel;
    bytes.append(m.bytes.begin(), m.bytes.end());
  }
  return bytes;
}

void show(const link::LogReader& log) {
  view::Record record;
  view::Listener listener(record, {}, log.session(), 0);
  for (const link::LoggedMessage& m : log.messages()) listener.receive("s." + m.channel, m.bytes);
  listener.publish_count();
  view::Record::Cursor cursor;
  for (std::string news = record.news(cursor); !news.empty(); news = record.news(cursor))
    fuzz::require(nlohmann::json::accept(news), "news is JSON");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const MemoryFile file(fuzz::text_of(data, size));
    const link::LogReader log(file.path());
    for (const link::LoggedMessage& m : log.messages())
      for (const char c : m.channel) fuzz::require(c > ' ' && c <= '~', "the name of a channel can be shown");
    const MemoryFile copy(written(log));
    std::size_t found = 0;
    try {
      const link::LogReader again(copy.path());
      fuzz::require(again.damaged() == 0, "a log that is written anew has no damage");
      found = again.messages().size();
    } catch (const FaultError&) {  // every name was nothing but the session's
    }
    fuzz::require(found == log.messages().size(), "all that was read is written");
    show(log);
    const link::ReplayBus replay(log);
    (void)replay.missing();
  } catch (const FaultError& e) {
    fuzz::require(e.fault().code == FaultCode::bad_log, "what is no log is a bad log");
  }
  return 0;
}
