#include "test/system/started_task.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "base/link/lcm_bus.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/session.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Only so that a test ends; nothing is judged by it.
constexpr auto kLongEnough = kSanitized ? 1200s : 800s;
constexpr auto kLook = 3ms;

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

struct Stat {
  char state{};
  pid_t parent{};
  unsigned long long start{};
};

std::optional<Stat> stat_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(in, line)) return std::nullopt;
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  Stat s;
  fields >> s.state >> s.parent;
  std::string skipped;
  for (int field = 5; field < 22; ++field) fields >> skipped;
  fields >> s.start;
  return s;
}

std::string command_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/cmdline", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::ranges::replace(text, '\0', ' ');
  return text;
}

bool waited_for(auto done, Clock::duration timeout) {
  for (const auto end = Clock::now() + timeout; Clock::now() < end; std::this_thread::sleep_for(kLook))
    if (done()) return true;
  return done();
}

/// Every run that a test has made is recomputed from its log, as far as the log goes.
void expect_checked_runs(const Folder& folder) {
  std::vector<fs::path> runs;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (fs::exists(entry.path() / link::kEventLog) && fs::exists(entry.path() / "processes.json"))
      runs.push_back(entry.path());
  for (const fs::path& of : runs) {
    std::string text;
    const Ended ended = run(folder, "ui_cli", {"log", "check", of.string(), "--json"});
    for (const auto& line : ended.out) text += line;
    const auto verdict = nlohmann::json::parse(text, nullptr, false);
    ASSERT_TRUE(verdict.is_object()) << of << "\n" << ended.all();
    if (const auto differences = verdict.value("differences", nlohmann::json()); differences.is_number()) {
      EXPECT_EQ(differences, 0) << of << "\n" << verdict.dump(1);
    }
  }
}

}  // namespace

Folder::Folder(bool recomputed) : recomputed_(recomputed) {
  std::string name = (fs::temp_directory_path() / "mrroc-system-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

Folder::~Folder() {
  if (::testing::Test::HasFailure()) return;  // to look at
  if (recomputed_ && !kSanitized) expect_checked_runs(*this);
  if (::testing::Test::HasFailure()) return;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return (path_ / name).string();
}

bool ProcessId::runs() const {
  const auto s = stat_of(pid);
  return s && s->start == start && s->state != 'Z' && s->state != 'X';
}

std::string Ended::all() const {
  std::string text = "status " + std::to_string(status) + "\n";
  for (const auto& line : out) text += "out: " + line + "\n";
  for (const auto& line : err) text += "err: " + line + "\n";
  return text;
}

fs::path started_program(const std::string& program) { return fs::path(MRROC_BIN) / program; }

Started::Started(const Folder& folder, const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& name)
    : out_(folder / (name + ".out")), err_(folder / (name + ".err")) {
  std::vector<std::string> argv_text{started_program(program).string()};
  argv_text.insert(argv_text.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& a : argv_text) argv.push_back(a.data());
  argv.push_back(nullptr);
  const std::string sessions = folder.path().string();
  pid_ = ::fork();
  if (pid_ != 0) return;
  ::dup2(::open("/dev/null", O_RDONLY), 0);
  ::dup2(::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
  ::dup2(::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
  if (::chdir(sessions.c_str()) != 0 || ::setenv("XDG_RUNTIME_DIR", sessions.c_str(), 1) != 0) ::_exit(126);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

Started::~Started() {
  if (ended_) return;
  signal(SIGKILL);
  reap(true);
}

bool Started::reap(bool wait_for_it) {
  if (ended_) return true;
  int status = 0;
  if (::waitpid(pid_, &status, wait_for_it ? 0 : WNOHANG) != pid_) return false;
  ended_ = true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

bool Started::await_line(const std::string& text) {
  const auto there = [&] {
    return std::ranges::any_of(lines_of(out_), [&](const auto& l) { return l.find(text) != l.npos; });
  };
  return waited_for([&] { return there() || reap(false); }, kLongEnough) && there();
}

std::vector<ProcessId> Started::children() const {
  std::vector<ProcessId> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    const pid_t pid = std::stoi(name);
    const auto s = stat_of(pid);
    if (s && s->parent == pid_ && s->state != 'Z') children.push_back({pid, s->start, command_of(pid)});
  }
  return children;
}

ProcessId Started::child(const std::string& part) const {
  const auto all = children();
  const auto it = std::ranges::find_if(
      all, [&](const auto& c) { return c.command.find("--name " + part + " ") != c.command.npos; });
  if (it == all.end()) throw std::runtime_error("there is no child " + part);
  return *it;
}

void Started::signal(int number) const {
  if (!ended_) ::kill(pid_, number);
}

Ended Started::end() {
  if (!waited_for([&] { return reap(false); }, kLongEnough)) {
    signal(SIGKILL);
    reap(true);
  }
  return {status_, lines_of(out_), lines_of(err_)};
}

Ended run(const Folder& folder, const std::string& program, const std::vector<std::string>& arguments) {
  return Started(folder, program, arguments, "run-" + fs::path(program).filename().string()).end();
}

bool all_gone(const std::vector<ProcessId>& processes) {
  return waited_for([&] { return std::ranges::none_of(processes, &ProcessId::runs); }, 30s);
}

nlohmann::json summary(const fs::path& folder) {
  std::ifstream in(folder / "summary.json");
  return nlohmann::json::parse(in);
}

double figure(const nlohmann::json& summary, const std::string& key) {
  if (!summary.contains("figures")) return std::nan("");
  const auto found = summary.at("figures").value(key, nlohmann::json());
  return found.is_number() ? found.get<double>() : std::nan("");
}

bool multicast() { return link::multicast_works(link::address_for("mrroc-system-test")); }

std::string lines_svg(int count) {
  std::string text = R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 60">)";
  for (int k = 0; k < count; ++k) {
    const std::string y = std::to_string(10 + 10 * k);
    text += R"(<line stroke="black" x1="10" x2="50" y1=")" + y + R"(" y2=")" + y + R"("/>)";
  }
  return text + "</svg>\n";
}

std::vector<std::string> words(std::initializer_list<std::vector<std::string>> lists) {
  std::vector<std::string> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace mrroc::test
