#include "base/link/session.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "base/fault.hpp"
#include "base/hash.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

constexpr int kFirstPort = 20000;
constexpr int kPortStep = 4;  // a port per Group, and one to spare
constexpr int kPortCount = 2500;
static_assert(kPortStep >= kGroups);

constexpr bool allowed(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// When a living process was started [clock ticks since boot]; nothing for a dead or unreaped one. Together
/// with the process number it names one process for ever.
std::optional<std::uint64_t> start_of(pid_t pid) {
  std::ifstream in(fmt::format("/proc/{}/stat", pid));
  std::string line;
  if (!std::getline(in, line)) return std::nullopt;
  const std::size_t name_end = line.rfind(')');  // the program's name may hold spaces and brackets
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(line.substr(name_end + 1));
  std::string state, skipped;
  fields >> state;
  if (state == "Z" || state == "X") return std::nullopt;
  for (int field = 4; field < 22; ++field) fields >> skipped;
  std::uint64_t start{};
  if (!(fields >> start)) return std::nullopt;
  return start;
}

struct Entry {
  SessionInfo info;
  std::uint64_t start{};

  [[nodiscard]] bool alive() const { return start_of(info.pid) == start; }
};

std::string to_json(const Entry& e) {
  const SessionInfo& s = e.info;
  nlohmann::ordered_json j{{"session", s.name}, {"id", s.id}, {"url", nullptr}, {"pid", s.pid}};
  if (s.address) j["url"] = s.address->url();
  j["start"] = e.start;
  j["task"] = s.task;
  j["run_folder"] = s.run_folder.string();
  return j.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

std::optional<Entry> read(const fs::path& file) {
  try {
    std::ifstream in(file);
    const auto j = nlohmann::json::parse(in);
    Entry e;
    e.info.name = j.at("session").get<std::string>();
    e.info.id = j.at("id").get<std::int64_t>();
    if (!j.at("url").is_null()) e.info.address = LcmAddress::parse(j.at("url").get<std::string>());
    e.info.pid = j.at("pid").get<pid_t>();
    e.start = j.at("start").get<std::uint64_t>();
    e.info.task = j.at("task").get<std::string>();
    e.info.run_folder = j.at("run_folder").get<std::string>();
    if (!valid_session_name(e.info.name) || file.stem() != e.info.name) return std::nullopt;
    return e;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
  throw FaultError(FaultCode::cannot_write, fmt::format("cannot use {}: {}", path.string(), why));
}

/// Held while the directory is looked through or changed, by one process at a time.
class DirectoryLock {
 public:
  explicit DirectoryLock(const fs::path& directory)
      : file_(::open((directory / ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600)) {
    if (file_ < 0) cannot_write(directory / ".lock", std::strerror(errno));
    while (::flock(file_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~DirectoryLock() { ::close(file_); }
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int file_;
};

/// Whoever could write there could send terminals to a task of his own, so nobody else may.
void make_private_directory(const fs::path& directory) {
  if (::mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) cannot_write(directory, std::strerror(errno));
  struct stat s {};
  if (::lstat(directory.c_str(), &s) != 0) cannot_write(directory, std::strerror(errno));
  if (!S_ISDIR(s.st_mode)) cannot_write(directory, "it is not a directory");
  if (s.st_uid != ::geteuid()) cannot_write(directory, "it belongs to another user");
  if ((s.st_mode & 077) != 0 && ::chmod(directory.c_str(), 0700) != 0)
    cannot_write(directory, "it is open to other users");
}

/// Others see no file or the whole file.
void write_at_once(const fs::path& path, const std::string& text) {
  fs::path draft = path;
  draft.replace_extension(".draft");
  std::ofstream out(draft, std::ios::trunc);
  out << text;
  out.close();
  std::error_code error;
  if (out) fs::rename(draft, path, error);
  if (out && !error) return;
  std::error_code ignored;
  fs::remove(draft, ignored);
  cannot_write(path, error ? error.message() : "the disk may be full");
}

}  // namespace

bool valid_session_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= kMaxSessionName && std::ranges::all_of(name, allowed);
}

void check_session_name(std::string_view name) {
  if (valid_session_name(name)) return;
  std::string shown(name.substr(0, 2 * kMaxSessionName));
  std::ranges::replace_if(
      shown, [](char c) { return c < ' ' || c > '~'; }, '?');
  throw FaultError(FaultCode::bad_usage,
                   fmt::format("'{}' cannot name a session: give 1..{} letters, digits, '_' or '-'", shown,
                               kMaxSessionName));
}

std::int64_t random_id() {
  std::random_device device;
  return std::uniform_int_distribution<std::int64_t>(1, std::numeric_limits<std::int64_t>::max())(device);
}

LcmAddress address_for(std::string_view session) {
  Hash hash;
  hash.add(session);
  const auto place = static_cast<int>((hash.value() ^ hash.value() >> 32) % kPortCount);
  LcmAddress address;
  address.port = kFirstPort + kPortStep * place;
  return address;
}

fs::path session_directory() {
  const std::string name = fmt::format("mrroc-{}", ::geteuid());
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  if (runtime != nullptr && fs::path(runtime).is_absolute() && fs::is_directory(runtime, error))
    return fs::path(runtime) / name;
  return fs::path("/tmp") / name;
}

std::string unique_session_name(std::string_view task, const fs::path& directory) {
  constexpr std::size_t kSuffix = 5;
  std::string base(task.substr(0, kMaxSessionName - kSuffix));
  std::ranges::replace_if(
      base, [](char c) { return !allowed(c); }, '-');
  if (base.empty()) base = "task";
  const std::vector<SessionInfo> running = running_sessions(directory);
  for (;;) {
    std::string name = fmt::format("{}-{:04x}", base, random_id() & 0xffff);
    if (std::ranges::find(running, name, &SessionInfo::name) == running.end()) return name;
  }
}

std::vector<SessionInfo> running_sessions(const fs::path& directory) {
  std::vector<SessionInfo> running;
  std::error_code error;
  if (!fs::is_directory(directory, error)) return running;
  make_private_directory(directory);
  const DirectoryLock lock(directory);
  for (const auto& file : fs::directory_iterator(directory)) {
    if (file.path().extension() != ".json") continue;
    const auto entry = read(file.path());
    if (!entry) continue;
    if (entry->alive())
      running.push_back(entry->info);
    else
      fs::remove(file.path(), error);
  }
  std::ranges::sort(running, {}, &SessionInfo::name);
  return running;
}

SessionFile::SessionFile(SessionInfo info, const fs::path& directory) : info_(std::move(info)) {
  check_session_name(info_.name);
  info_.pid = ::getpid();
  path_ = directory / (info_.name + ".json");
  make_private_directory(directory);
  const DirectoryLock lock(directory);
  if (const auto other = read(path_); other && other->alive())
    throw FaultError(FaultCode::session_in_use, fmt::format("a task '{}' runs under the name {} (process {})",
                                                            other->info.task, info_.name, other->info.pid));
  write_at_once(path_, to_json({info_, start_of(info_.pid).value_or(0)}));
}

SessionFile::~SessionFile() {
  if (::getpid() != info_.pid) return;
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace mrroc::link
