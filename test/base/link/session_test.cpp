// The file of a session: what it lists, who owns its name, and what remains of a dead process.
#include "base/link/session.hpp"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/base/link/session_fixture.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using test::code_of;
using test::Session;
using test::status_of_child;

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

TEST_F(Session, ThatCannotBeListedIsNoneAndLeavesNoKey) {
  const auto entry = directory() / "blocked.json";
  std::filesystem::create_directories(entry / "full");
  std::filesystem::permissions(directory(), std::filesystem::perms::owner_all);
  EXPECT_NE(code_of([&] { const SessionFile file(info("blocked"), directory()); }), FaultCode::none);
  for (const auto& left : std::filesystem::directory_iterator(directory()))
    EXPECT_TRUE(!left.is_regular_file() || std::filesystem::file_size(left) == 0) << left.path();
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

TEST_F(Session, ANameThatIsInUseIsRefusedWithTheTaskThatHasIt) {
  const SessionFile file(info("same"), directory());
  try {
    const SessionFile second(info("same"), directory());
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()),
              "a task 'drawing' runs under the name same (process " + std::to_string(::getpid()) + ")");
  }
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

TEST_F(Session, ItsFileAppearsWhole) {
  fs::create_directory(directory());
  const int watch = ::inotify_init1(IN_NONBLOCK);
  ASSERT_GE(::inotify_add_watch(watch, directory().c_str(), IN_CREATE | IN_MOVED_TO), 0);
  const SessionFile file(info("s"), directory());
  alignas(inotify_event) std::array<char, 4096> bytes{};
  const ssize_t size = ::read(watch, bytes.data(), bytes.size());
  ::close(watch);
  std::map<std::string, std::uint32_t> come;
  for (ssize_t at = 0; at < size;) {
    const auto* const event = reinterpret_cast<const inotify_event*>(bytes.data() + at);
    come[event->name] |= event->mask;
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  EXPECT_EQ(come["s.json"], static_cast<std::uint32_t>(IN_MOVED_TO)) << "it is written elsewhere";
  EXPECT_FALSE(fs::exists(directory() / "s.draft"));
}

TEST_F(Session, IsNotThereWithoutADirectory) { EXPECT_TRUE(names().empty()); }

}  // namespace
}  // namespace mrroc::link
