#include "base/link/session.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

class Session : public ::testing::Test {
 protected:
  Session() {
    std::string pattern = (fs::temp_directory_path() / "session_test.XXXXXX").string();
    home_ = ::mkdtemp(pattern.data());
  }
  ~Session() override { fs::remove_all(home_); }

  [[nodiscard]] fs::path directory() const { return home_ / "mrroc"; }
  static SessionInfo info(const std::string& name) {
    return {name, 42, address_for(name), "drawing", "/runs/drawing-1", 0};
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const SessionInfo& s : running_sessions(directory())) result.push_back(s.name);
    return result;
  }

  fs::path home_;
};

/// @return the code with which f fails, none when it does not
template <class F>
FaultCode code_of(F f) {
  try {
    f();
  } catch (const FaultError& e) {
    return e.fault().code;
  }
  return FaultCode::none;
}

/// Runs f in a child that then ends without destructors.
template <class F>
int status_of_child(F f) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(f());
  int status{};
  ::waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST_F(Session, IsListedWithEverythingItSaidWhileItLives) {
  {
    const SessionFile file(info("drawing-1a2b"), directory());
    const auto running = running_sessions(directory());
    ASSERT_EQ(running.size(), 1U);
    EXPECT_EQ(running[0].name, "drawing-1a2b");
    EXPECT_EQ(running[0].id, 42);
    ASSERT_TRUE(running[0].address);
    EXPECT_EQ(running[0].address->url(), address_for("drawing-1a2b").url());
    EXPECT_EQ(running[0].task, "drawing");
    EXPECT_EQ(running[0].run_folder, "/runs/drawing-1");
    EXPECT_EQ(running[0].pid, ::getpid());
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(Session, CanSayThatItTalksToNobodyOutsideItsProcess) {
  SessionInfo quiet = info("quiet");
  quiet.address.reset();
  const SessionFile file(quiet, directory());
  EXPECT_FALSE(running_sessions(directory()).at(0).address);
}

TEST_F(Session, StandsBesideOthersInTheOrderOfTheirNames) {
  const SessionFile b(info("b"), directory());
  const SessionFile a(info("a"), directory());
  EXPECT_EQ(names(), (std::vector<std::string>{"a", "b"}));
}

TEST_F(Session, IsRefusedANameThatALivingProcessHas) {
  const SessionFile file(info("same"), directory());
  EXPECT_EQ(code_of([this] { SessionFile second(info("same"), directory()); }), FaultCode::session_in_use);
  EXPECT_EQ(names(), std::vector<std::string>{"same"}) << "the refused one must not remove the other's file";
}

/// Lets processes try the same name at the same time; those who get it keep it until all have tried.
/// @return how many have been told what: none for success
std::map<FaultCode, int> contest(const SessionInfo& info, const fs::path& directory, int processes) {
  // Reading from start or finish waits until this process closes the other end.
  int start[2], verdicts[2], finish[2];
  if ((::pipe(start) | ::pipe(verdicts) | ::pipe(finish)) != 0) return {};
  std::vector<pid_t> children;
  for (int k = 0; k < processes; ++k) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    ::close(start[1]);
    ::close(finish[1]);
    char end{};
    (void)!::read(start[0], &end, 1);
    std::unique_ptr<SessionFile> file;
    const FaultCode code = code_of([&] { file = std::make_unique<SessionFile>(info, directory); });
    (void)!::write(verdicts[1], &code, sizeof code);
    (void)!::read(finish[0], &end, 1);
    ::_exit(0);
  }
  ::close(start[1]);
  std::map<FaultCode, int> counts;
  for (int k = 0; k < processes; ++k) {
    FaultCode code{};
    if (::read(verdicts[0], &code, sizeof code) == sizeof code) ++counts[code];
  }
  ::close(finish[1]);
  for (const pid_t child : children) ::waitpid(child, nullptr, 0);
  for (const int file : {start[0], verdicts[0], verdicts[1], finish[0]}) ::close(file);
  return counts;
}

TEST_F(Session, IsWonByOneOfManyProcessesThatTryTheSameNameAtOnce) {
  for (int round = 0; round < 10; ++round) {
    // From the second round on, a dead owner's file is there, which everybody wants to replace.
    const auto counts = contest(info("contested"), directory(), 12);
    EXPECT_EQ(counts, (std::map<FaultCode, int>{{FaultCode::none, 1}, {FaultCode::session_in_use, 11}}));
  }
}

TEST_F(Session, OfADeadProcessIsNotListedAndItsFileIsDeleted) {
  EXPECT_EQ(status_of_child([this] {
              new SessionFile(info("dead"), directory());
              return fs::exists(directory() / "dead.json") ? 7 : 0;
            }),
            7);
  EXPECT_TRUE(fs::exists(directory() / "dead.json"));
  EXPECT_TRUE(names().empty());
  EXPECT_FALSE(fs::exists(directory() / "dead.json"));
}

TEST_F(Session, OfADeadProcessGivesItsNameToTheNext) {
  status_of_child([this] {
    new SessionFile(info("heir"), directory());
    return 0;
  });
  const SessionFile file(info("heir"), directory());
  EXPECT_EQ(running_sessions(directory()).at(0).pid, ::getpid());
}

TEST_F(Session, OfAProcessThatIsNotReapedYetIsDead) {
  const pid_t child = ::fork();
  if (child == 0) {
    new SessionFile(info("zombie"), directory());
    ::_exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_TRUE(names().empty());
  ::waitpid(child, nullptr, 0);
}

TEST_F(Session, IsDeadWhenItsProcessNumberBelongsToALaterProcess) {
  { const SessionFile make_the_directory(info("x"), directory()); }
  std::ofstream(directory() / "late.json") << R"({"session":"late","id":1,"url":null,"pid":)" << ::getpid()
                                           << R"(,"start":1,"task":"drawing","run_folder":"/runs"})";
  EXPECT_TRUE(names().empty());
  EXPECT_FALSE(fs::exists(directory() / "late.json"));
}

TEST_F(Session, LeavesFilesAloneThatAreNotSessions) {
  const SessionFile file(info("good"), directory());
  const std::vector<std::string> contents{"", "{", "[]", "{\"session\":7}", std::string(5, '\0')};
  for (std::size_t k = 0; k < contents.size(); ++k)
    std::ofstream(directory() / ("bad" + std::to_string(k) + ".json")) << contents[k];
  fs::copy_file(file.path(), directory() / "other.json");  // says another name than it has
  EXPECT_EQ(names(), std::vector<std::string>{"good"});
  EXPECT_TRUE(fs::exists(directory() / "bad0.json"));
}

TEST_F(Session, EndsWithItsOwnProcessAndNotWithAForkedChild) {
  const auto file = std::make_unique<SessionFile>(info("parent"), directory());
  status_of_child([&file] {
    file->~SessionFile();
    return 0;
  });
  EXPECT_EQ(names(), std::vector<std::string>{"parent"});
}

TEST_F(Session, KeepsItsDirectoryFromOtherUsers) {
  fs::create_directory(directory());
  ::chmod(directory().c_str(), 0777);
  const SessionFile file(info("private"), directory());
  EXPECT_EQ(fs::status(directory()).permissions(), fs::perms::owner_all);
}

TEST_F(Session, RefusesADirectoryThatIsNoneOrALink) {
  fs::create_directory(home_ / "elsewhere");
  fs::create_symlink(home_ / "elsewhere", directory());
  EXPECT_EQ(code_of([this] { SessionFile file(info("a"), directory()); }), FaultCode::cannot_write);
  EXPECT_EQ(code_of([this] { SessionFile file(info("a"), home_ / "no" / "parent"); }),
            FaultCode::cannot_write);
}

TEST_F(Session, IsNotThereWithoutADirectory) { EXPECT_TRUE(names().empty()); }

TEST_F(Session, RefusesNamesThatCannotBePartOfAChannelAndAFile) {
  for (const std::string name : {"a", "A_b-9", "abcdefghijklmnopqrstuvwx"}) {
    EXPECT_TRUE(valid_session_name(name)) << name;
    EXPECT_NO_THROW(check_session_name(name));
  }
  for (const std::string name :
       {"", "abcdefghijklmnopqrstuvwxy", "a b", "a.b", "../a", "a/b", "\xc3\xa9", "a\n"}) {
    EXPECT_FALSE(valid_session_name(name)) << name;
    EXPECT_EQ(code_of([&] { check_session_name(name); }), FaultCode::bad_usage) << name;
    EXPECT_EQ(code_of([&] { SessionFile file(info(name), directory()); }), FaultCode::bad_usage) << name;
  }
}

TEST_F(Session, GetsAValidNameThatNobodyHas) {
  std::set<std::string> seen;
  for (const std::string task : {"drawing", "", "a task with a very long name", "../x"}) {
    const std::string name = unique_session_name(task, directory());
    EXPECT_TRUE(valid_session_name(name)) << name;
    EXPECT_TRUE(seen.insert(name).second);
  }
  EXPECT_EQ(unique_session_name("drawing", directory()).substr(0, 8), "drawing-");
}

TEST_F(Session, TalksAtPortsThatDifferForAlmostAllNames) {
  std::map<int, int> used;
  constexpr int kNames = 1000;
  for (int k = 0; k < kNames; ++k) {
    const LcmAddress address = address_for("drawing-" + std::to_string(k));
    EXPECT_EQ(address.ttl, 0);
    EXPECT_EQ(address.port % 4, 0);
    EXPECT_GE(address.port, 20000);
    EXPECT_LE(address.port + kGroups - 1, 29999);
    ++used[address.port];
  }
  // 2500 (1 - (1 - 1/2500)^1000) = 824 different ports are expected of a fair hash.
  EXPECT_GT(used.size(), 780U);
  EXPECT_EQ(address_for("a").port, address_for("a").port);
}

TEST_F(Session, LooksInTheUsersRuntimeDirectoryIfThereIsOne) {
  const std::string user = "mrroc-" + std::to_string(::geteuid());
  const char* const before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before ? before : "";
  ::setenv("XDG_RUNTIME_DIR", home_.c_str(), 1);
  EXPECT_EQ(session_directory(), home_ / user);
  ::setenv("XDG_RUNTIME_DIR", (home_ / "missing").c_str(), 1);
  EXPECT_EQ(session_directory(), fs::path("/tmp") / user);
  before ? ::setenv("XDG_RUNTIME_DIR", kept.c_str(), 1) : ::unsetenv("XDG_RUNTIME_DIR");
}

}  // namespace
}  // namespace mrroc::link
