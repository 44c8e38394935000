#include "tasks/rubik/solver/table_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace mrroc::rubik {
namespace {

namespace fs = std::filesystem;

/// The file's beginning. The table follows at kDataOffset, where a page of memory begins.
struct Header {
  std::array<char, 8> magic{'M', 'R', 'R', 'O', 'C', 'T', 'A', 'B'};
  std::uint32_t version{};
  std::uint32_t name_length{};
  std::uint64_t bytes{};
  std::uint64_t checksum{};
  std::array<char, 32> name{};
};
constexpr std::size_t kDataOffset = 4096;
constexpr std::string_view kExtension = ".table";
static_assert(sizeof(Header) == 64);

Header header_of(const TableKind& kind) {
  Header header;
  header.version = kind.version;
  header.name_length = static_cast<std::uint32_t>(kind.name.size());
  header.bytes = kind.bytes;
  kind.name.copy(header.name.data(), header.name.size());
  return header;
}

/// @return what is wrong with the file; empty: nothing
std::string damage(const Memory& memory, const fs::path& file, const TableKind& kind) {
  if (memory.bytes().size() != kind.bytes) return "its size is wrong";
  Header found;
  std::memcpy(&found, memory.data() - kDataOffset, sizeof found);
  Header wanted = header_of(kind);
  if (found.magic != wanted.magic || found.name != wanted.name) return file.string() + " is no such table";
  if (found.version != wanted.version) return "it is of another version";
  wanted.checksum = checksum(memory.bytes());
  if (std::memcmp(&found, &wanted, sizeof found) != 0) return "its checksum is wrong";
  return {};
}

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 26;
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), std::min(bytes.size(), kAtOnce));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

/// @return where this process writes a file before it has its name
fs::path draft_of(const fs::path& file) { return fmt::format("{}.{}", file.string(), ::getpid()); }

/// @return whether the file is the draft of a process that is there no more
bool is_abandoned(const fs::path& file) {
  if (file.stem().extension() != kExtension) return false;
  const std::string number = file.extension().string();
  pid_t writer = 0;
  const auto [end, error] = std::from_chars(number.data() + 1, number.data() + number.size(), writer);
  if (error != std::errc{} || end != number.data() + number.size() || writer <= 0) return false;
  return ::kill(writer, 0) != 0 && errno == ESRCH;
}

/// Removes what processes that were ended while they wrote have left: it may be gigabytes.
void remove_abandoned_drafts(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator k(folder, error), end; !error && k != end; k.increment(error)) {
    std::error_code ignored;
    if (is_abandoned(k->path())) fs::remove(k->path(), ignored);
  }
}

/// Writes the table beside its place and moves it there.
/// @return what went wrong; empty: nothing
std::string write_table(const fs::path& file, const TableKind& kind, std::span<const std::uint8_t> bytes) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return fmt::format("{}: {}", file.parent_path().string(), error.message());
  remove_abandoned_drafts(file.parent_path());
  std::array<std::uint8_t, kDataOffset> first{};
  Header header = header_of(kind);
  header.checksum = checksum(bytes);
  std::memcpy(first.data(), &header, sizeof header);

  const fs::path draft = draft_of(file);
  const int fd = ::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return fmt::format("{}: {}", draft.string(), std::strerror(errno));
  bool whole = write_all(fd, first) && write_all(fd, bytes);
  const int why = errno;
  // What was written lies in small pages; the next program is to read it back into large ones (Memory::of_file).
  if (whole && ::fdatasync(fd) == 0) ::posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED);
  whole = ::close(fd) == 0 && whole;
  if (whole) fs::rename(draft, file, error);
  if (whole && !error) return {};
  const std::string reason = error ? error.message() : std::strerror(why);
  fs::remove(draft, error);
  return fmt::format("{}: {}", file.string(), reason);
}

}  // namespace

std::uint64_t checksum(std::span<const std::uint8_t> bytes) {
  constexpr std::uint64_t kPrime = 0x9e3779b97f4a7c15;
  std::array<std::uint64_t, 4> lanes{1, 2, 3, 4};
  const auto mix = [](std::uint64_t lane, std::uint64_t word) {
    return std::rotl((lane ^ word) * kPrime, 29);
  };
  std::size_t k = 0;
  for (; k + 32 <= bytes.size(); k += 32) {
    std::array<std::uint64_t, 4> words;
    std::memcpy(words.data(), bytes.data() + k, sizeof words);
    for (std::size_t lane = 0; lane < 4; ++lane) lanes[lane] = mix(lanes[lane], words[lane]);
  }
  for (; k < bytes.size(); ++k) lanes[k % 4] = mix(lanes[k % 4], bytes[k]);
  std::uint64_t sum = bytes.size();
  for (const std::uint64_t lane : lanes) sum = mix(sum, lane);
  return sum;
}

OpenTable open_table(const fs::path& folder, const TableKind& kind,
                     const std::function<void(std::span<std::uint8_t>)>& fill) {
  const fs::path file = folder / fmt::format("{}{}", kind.name, kExtension);
  OpenTable table;
  std::error_code error;
  if (fs::exists(file, error)) {
    table.memory = Memory::of_file(file, kDataOffset);
    table.failure_reason = damage(table.memory, file, kind);
    if (table.failure_reason.empty()) return table;
  }
  table.memory = Memory(kind.bytes);
  fill(table.memory.writable());
  const std::string failure_reason = write_table(file, kind, table.memory.bytes());
  table.source = failure_reason.empty() ? TableSource::made : TableSource::unwritten;
  if (!failure_reason.empty()) table.failure_reason = failure_reason;
  return table;
}

fs::path table_folder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return fs::path(value != nullptr ? value : "");
  };
  if (const fs::path cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "mrroc";
  if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "mrroc";
  std::error_code error;
  return fs::temp_directory_path(error) / "mrroc";
}

}  // namespace mrroc::rubik
