// Child processes: started, watched, and never left behind.
#include "base/link/child.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "test/open_files.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;

/// @return whether it ended within ten seconds
bool await_end(Child& child) {
  for (int k = 0; k < 1000; ++k) {
    if (child.reap()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

bool exists(pid_t pid) { return ::kill(pid, 0) == 0; }

bool await_gone(pid_t pid) {
  for (int k = 0; k < 1000 && exists(pid); ++k) std::this_thread::sleep_for(10ms);
  return !exists(pid);
}

TEST(Child, LeavesNoFileOpenInItsOwner) {
  const auto before = mrroc::test::open_files();
  {
    Child child("/bin/sh", {"-c", "cat > /dev/null"}, {}, "a text");
    EXPECT_EQ(mrroc::test::open_files(), before) << "while it runs";
    EXPECT_TRUE(await_end(child));
  }
  EXPECT_THROW(Child("/no/such/program", {}), FaultError);
  std::string too_long;
  too_long.resize(10'000'000, 'x');
  EXPECT_THROW(Child("/bin/true", {}, {}, too_long), FaultError);
  EXPECT_EQ(mrroc::test::open_files(), before);
}

TEST(Child, TellsHowItEnded) {
  const std::vector<std::tuple<std::string, std::string, bool>> cases{
      {"exit 0", "exit status 0", true},
      {"exit 3", "exit status 3", false},
      {"kill -9 $$", "signal 9 (Killed)", false}};
  for (const auto& [script, how, well] : cases) {
    Child child("/bin/sh", {"-c", script});
    ASSERT_TRUE(await_end(child)) << script;
    EXPECT_EQ(child.ended(), how);
    EXPECT_EQ(child.ended_well(), well);
    EXPECT_FALSE(child.reap());  // no news any more
  }
}

TEST(Child, GetsItsArgumentsAsTheyAre) {
  Child child("/bin/sh", {"-c", R"([ "$1" = "a b" ] && [ "$2" = '*' ] && [ $# = 2 ])", "name", "a b", "*"});
  ASSERT_TRUE(await_end(child));
  EXPECT_TRUE(child.ended_well());
}

TEST(Child, GetsThemAsTheyAreThroughAShellElsewhereToo) {
  std::string pattern = (std::filesystem::temp_directory_path() / "child_test.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  const std::filesystem::path ssh = folder / "ssh";
  std::ofstream(ssh) << "#!/bin/sh\nshift\ncd /\nexec /bin/sh -c \"$*\"\n";
  std::filesystem::permissions(ssh, std::filesystem::perms::owner_all);
  const std::vector<std::string> words{"a b",           "*", "it's", "udpm://239.1.2.3:7667?ttl=1&x=2",
                                       "$HOME; exit 4", ""};
  std::string script = "[ $# = 6 ]";
  for (std::size_t k = 0; k < words.size(); ++k)
    script += " && [ \"${" + std::to_string(k + 1) + "}\" = \"$W" + std::to_string(k + 1) + "\" ]";
  for (std::size_t k = 0; k < words.size(); ++k)
    ::setenv(("W" + std::to_string(k + 1)).c_str(), words[k].c_str(), 1);
  std::vector<std::string> arguments{"-c", script, "name"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  for (const std::vector<std::string>& start : {{ssh.string(), "robot"}, std::vector<std::string>{}}) {
    Child child("/bin/sh", arguments, start);
    ASSERT_TRUE(await_end(child));
    EXPECT_TRUE(child.ended_well()) << start.size();
  }
  std::filesystem::remove_all(folder);
}

TEST(Child, CannotReadWhatIsTypedToItsOwner) {
  int typed[2];
  ASSERT_EQ(::pipe(typed), 0);
  const int before = ::dup(STDIN_FILENO);
  ::dup2(typed[0], STDIN_FILENO);
  Child child("/bin/sh", {"-c", "! read -r line"});  // there is nothing, and it is told at once
  const bool ended = await_end(child);
  ::dup2(before, STDIN_FILENO);
  for (const int file : {before, typed[0], typed[1]}) ::close(file);
  ASSERT_TRUE(ended);
  EXPECT_TRUE(child.ended_well());
}

TEST(Child, WhatCannotBeStartedIsSaidAtOnce) {
  for (const char* program : {"/no/such/program", "/etc/passwd", "/tmp"}) {
    try {
      Child child(program, {});
      ADD_FAILURE() << program;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::start_failed);
      EXPECT_NE(std::string(e.what()).find(program), std::string::npos);
    }
  }
}

TEST(Child, TheReasonIsToldWhenThereIsNoRoomForAnotherProcess) {
  const pid_t poor = ::fork();
  if (poor == 0) {
    const rlimit none{};
    if (::setrlimit(RLIMIT_NPROC, &none) != 0 || (::geteuid() == 0 && ::setuid(54321) != 0)) ::_exit(9);
    try {
      const Child child("/bin/true", {});
    } catch (const FaultError& e) {
      ::_exit(std::string(e.what()).find(std::strerror(EAGAIN)) != std::string::npos ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = -1;
  ::waitpid(poor, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 9) GTEST_SKIP() << "no process can be kept from starting others here";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// @return the error of a child that is started while so many more files can be opened
std::string error_with_free_files(int files) {
  rlimit usual{};
  EXPECT_EQ(::getrlimit(RLIMIT_NOFILE, &usual), 0);
  std::vector<int> taken;
  for (int k = 0; k < files; ++k) taken.push_back(::dup(STDIN_FILENO));
  const rlim_t first_refused = files == 0 ? 0 : static_cast<rlim_t>(taken.back()) + 1;
  for (const int file : taken) ::close(file);
  const rlimit few{first_refused, usual.rlim_max};
  EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  std::exception_ptr thrown;
  try {
    const Child child("/bin/true", {});
  } catch (const FaultError&) {
    thrown = std::current_exception();
  }
  EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  if (!thrown) return {};
  try {
    std::rethrow_exception(thrown);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::start_failed);
    return e.what();
  }
}

TEST(Child, TheReasonIsToldWhenThereIsNoRoomForAPipe) {
  // The sanitizer of types needs a pipe itself when it meets one for the first time.
  const FaultError met(FaultCode::start_failed, "met before", "nothing to do");
  ASSERT_EQ(met.fault().code, FaultCode::start_failed);
  const std::string reason = std::string("cannot make a pipe: ") + std::strerror(EMFILE);
  for (const int files : {0, 2}) {  // neither of the two pipes, and the first one only
    const std::string error = error_with_free_files(files);
    EXPECT_NE(error.find(reason), std::string::npos) << files << ": " << error;
  }
}

TEST(Child, FindsItsInputOnceAndThenItsEnd) {
  for (const char* const start : {"", "env"}) {
    Child child("/bin/sh", {"-c", R"(read -r a; read -r b; [ "$a-$b" = one-two ] && ! read -r c)"},
                *start ? std::vector<std::string>{start} : std::vector<std::string>{}, "one\ntwo\n");
    ASSERT_TRUE(await_end(child));
    EXPECT_TRUE(child.ended_well());
  }
}

TEST(Child, InputThatNobodyWouldReadInTimeIsRefused) {
  const std::string fits(60'000, 'x');
  Child reads("/bin/sh", {"-c", "[ $(wc -c) = 60000 ]"}, {}, fits);
  ASSERT_TRUE(await_end(reads));
  EXPECT_TRUE(reads.ended_well());
  std::string too_long;
  too_long.resize(10'000'000, 'x');
  try {
    const Child child("/bin/true", {}, {}, too_long);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::start_failed);
  }
}

TEST(Child, IsAskedToEndAndEndsBySignal15) {
  Child child("/bin/sh", {"-c", "exec sleep 600"});
  child.terminate();
  ASSERT_TRUE(await_end(child));
  EXPECT_EQ(child.ended(), "signal 15 (Terminated)");
  EXPECT_FALSE(child.ended_well());
  Child obstinate("/bin/sh", {"-c", "trap '' TERM; echo > /dev/null; while :; do sleep 0.05; done"});
  obstinate.kill();
  ASSERT_TRUE(await_end(obstinate));
  EXPECT_EQ(obstinate.ended(), "signal 9 (Killed)");
}

// A Ctrl-C in the terminal is the owner's business.
TEST(Child, IsInAProcessGroupOfItsOwn) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const Child child("/bin/sh", {"-c", "echo $$ > /dev/fd/" + std::to_string(pipe[1]) + "; exec sleep 600"});
  ::close(pipe[1]);
  char text[32]{};
  ASSERT_GT(::read(pipe[0], text, sizeof text - 1), 0);
  const pid_t pid = std::atoi(text);
  EXPECT_EQ(::getpgid(pid), pid);
  EXPECT_NE(::getpgid(pid), ::getpgrp());
  ::close(pipe[0]);
}

TEST(Child, KeepsItsEndWhenItIsMoved) {
  Child child("/bin/sh", {"-c", "exit 0"});
  ASSERT_TRUE(await_end(child));
  const Child moved(std::move(child));
  EXPECT_EQ(moved.ended(), "exit status 0");
  EXPECT_TRUE(moved.ended_well());
}

TEST(Child, EndsWithItsOwner) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  pid_t pid = 0;
  {
    Child child("/bin/sh", {"-c", "echo $$ >&" + std::to_string(pipe[1]) + "; exec sleep 600"});
    char text[32]{};
    ASSERT_GT(::read(pipe[0], text, sizeof text - 1), 0);
    pid = std::atoi(text);
    EXPECT_TRUE(exists(pid));
    EXPECT_FALSE(child.reap());
    EXPECT_FALSE(child.ended());
  }
  EXPECT_FALSE(exists(pid));
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(Child, EndsWhenItsParentIsKilled) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    const Child child("/bin/sh", {"-c", "echo $$ >&" + std::to_string(pipe[1]) + "; exec sleep 600"});
    ::pause();
    ::_exit(0);
  }
  char text[32]{};
  ASSERT_GT(::read(pipe[0], text, sizeof text - 1), 0);
  const pid_t pid = std::atoi(text);
  EXPECT_TRUE(exists(pid));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(await_gone(pid));
  ::close(pipe[0]);
  ::close(pipe[1]);
}

TEST(Child, KillingOneThatHasEndedHurtsNobody) {
  Child child("/bin/sh", {"-c", "exit 0"});
  ASSERT_TRUE(await_end(child));
  child.kill();
  EXPECT_TRUE(child.ended_well());
}

TEST(Child, CanBeMoved) {
  std::vector<Child> children;
  for (int k = 0; k < 4; ++k) children.emplace_back("/bin/sh", std::vector<std::string>{"-c", "exit 0"});
  for (Child& child : children) {
    ASSERT_TRUE(await_end(child));
    EXPECT_TRUE(child.ended_well());
  }
}

}  // namespace
}  // namespace mrroc::link
