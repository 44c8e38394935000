#include "base/link/session.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/fault.hpp"
#include "base/hash.hpp"
#include "base/link/private_folder.hpp"
#include "base/printable.hpp"

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
    std::string ignored;
    const auto text = read_own_file(file, OwnFile::trusted, ignored);
    if (!text) return std::nullopt;
    const auto j = nlohmann::json::parse(*text);
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

/// Others see no file or the whole file.
void write_at_once(const fs::path& path, const std::string& text) {
  fs::path draft = path;
  draft.replace_extension(".draft");
  std::error_code error, ignored;
  fs::remove(draft, ignored);
  std::string why;
  if (write_own_file(draft, text, why)) fs::rename(draft, path, error);
  if (why.empty() && !error) return;
  fs::remove(draft, ignored);
  throw FaultError(FaultCode::cannot_write,
                   fmt::format("cannot use {}: {}", path.string(), error ? error.message() : why));
}

fs::path key_of(fs::path file) { return file.replace_extension(".key"); }

/// @return of a running session; nothing when it has none, or none that can be trusted
std::optional<Key> key_beside(const fs::path& file) {
  std::string ignored;
  const auto text = read_own_file(key_of(file), OwnFile::secret, ignored);
  return text ? Key::parse(std::string_view(*text).substr(0, text->find('\n'))) : std::nullopt;
}

/// A task that was killed leaves files.
void remove_files_of(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
  fs::remove(key_of(file), ignored);
}

/// @return whether some task has entered itself there
bool has_entries(const fs::path& directory) {
  std::error_code error;
  for (const auto& file : fs::directory_iterator(directory, error))
    if (file.path().extension() == ".json") return true;
  return false;
}

/// @return in the user's home, for this host alone; nothing when there is no home
std::optional<fs::path> place_at_home() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  for (const auto& [variable, below] : {std::pair{"XDG_STATE_HOME", ""}, std::pair{"HOME", ".local/state"}}) {
    const char* const home = std::getenv(variable);
    if (home != nullptr && fs::path(home).is_absolute())
      return fs::path(home) / below / "mrroc" / host.data();
  }
  return std::nullopt;
}

}  // namespace

bool valid_session_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= kMaxSessionName && std::ranges::all_of(name, allowed);
}

void check_session_name(std::string_view name) {
  if (valid_session_name(name)) return;
  const std::string shown = without_controls(name.substr(0, 2 * kMaxSessionName));
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

SessionPlace session_place() {
  const std::string name = fmt::format("mrroc-{}", ::geteuid());
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  if (runtime != nullptr && fs::path(runtime).is_absolute() && fs::is_directory(runtime, error))
    return {fs::path(runtime) / name, {}};
  const fs::path usual = fs::path("/tmp") / name;
  const bool taken = is_anothers(usual);
  if (!taken && fs::exists(usual, error)) return {usual, {}};
  const auto home = place_at_home();
  // A process that has taken it can give it back while a task runs.
  if (!home || (!taken && !has_entries(*home))) return {usual, {}};
  return {*home, fmt::format("{} {}: sessions are in {}", usual.string(),
                             taken ? "belongs to another user" : "is not there", home->string())};
}

fs::path session_directory() { return session_place().directory; }

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
  make_private_folder(directory);
  const FolderLock lock(directory);
  for (const auto& file : fs::directory_iterator(directory)) {
    if (file.path().extension() != ".json") continue;
    auto entry = read(file.path());
    if (!entry) continue;
    if (entry->alive()) {
      entry->info.key = key_beside(file.path());
      if (entry->info.key) entry->info.key_file = fs::absolute(key_of(file.path()));
      running.push_back(std::move(entry->info));
    } else {
      remove_files_of(file.path());
    }
  }
  std::ranges::sort(running, {}, &SessionInfo::name);
  return running;
}

std::unique_ptr<Bus> open_session(const SessionInfo& session) {
  if (!session.address) throw std::logic_error("the session has no address");
  if (!session.key)
    throw FaultError(FaultCode::no_such_session,
                     fmt::format("the key of session {} is not known here", session.name),
                     "copy the file that `ui_cli list --json` names on the task's host, and give --key-file");
  return open_lcm(*session.address, *session.key);
}

SessionFile::SessionFile(SessionInfo info, const fs::path& directory) : info_(std::move(info)) {
  check_session_name(info_.name);
  info_.pid = ::getpid();
  path_ = directory / (info_.name + ".json");
  std::error_code ignored;  // make_private_folder() says it
  if (directory == session_directory()) fs::create_directories(directory.parent_path(), ignored);
  make_private_folder(directory);
  const FolderLock lock(directory);
  if (const auto other = read(path_); other && other->alive())
    throw FaultError(FaultCode::session_in_use, fmt::format("a task '{}' runs under the name {} (process {})",
                                                            other->info.task, info_.name, other->info.pid));
  remove_files_of(path_);
  if (info_.address) {
    info_.key = Key::random();
    info_.key_file = fs::absolute(key_of(path_));
    write_key_file(info_.key_file, *info_.key);
  }
  try {
    write_at_once(path_, to_json({info_, start_of(info_.pid).value_or(0)}));
  } catch (const FaultError&) {
    remove_files_of(path_);
    throw;
  }
}

SessionFile::~SessionFile() {
  if (::getpid() == info_.pid) remove_files_of(path_);
}

}  // namespace mrroc::link
