// Lines of progress on a terminal that is too narrow for them.
#include "mp/print_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "base/link/text.hpp"
#include "mrroc/console_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {
namespace {

TEST(PrintLine, ALineOfProgressBreaksBetweenWordsAndGoesOnBehindItsTime) {
  EXPECT_EQ(folded("    0.50 s  solution: 3 turns: R U' F2", 28),
            "    0.50 s  solution: 3\n"
            "            turns: R U' F2");
}

TEST(PrintLine, ALineWithoutTimeGoesOnIndented) {
  EXPECT_EQ(folded("press, session press-1, seed 1", 20),
            "press, session\n"
            "  press-1, seed 1");
}

TEST(PrintLine, ALineThatFitsStaysAsItIs) {
  const std::string line = "    0.50 s  arm1  m = 1  approach";
  EXPECT_EQ(folded(line, static_cast<int>(line.size())), line);
  EXPECT_EQ(folded(line, 0), line) << "no terminal";
}

TEST(PrintLine, AWordThatIsWiderThanTheTerminalIsKept) {
  EXPECT_EQ(folded("run folder: runs/press-20260314-101500", 12),
            "run\n  folder:\n  runs/press-20260314-101500");
}

/// What an announcer prints, and the messages that it sends.
struct Announced {
  std::string out;
  std::vector<std::string> messages;
};

Announced announced(const std::string& text, bool shown) {
  link::test::DirectBus bus;
  link::NodeContext me;
  me.session = "s";
  me.name = "mp";
  me.roster = {"mp"};
  link::Process process(bus, me);
  link::Queue<console_t> lines(bus, process.route("mp.console"), me.session_id);
  ::testing::internal::CaptureStdout();
  Announcer(process, "", shown)(9.3, text);
  Announced a{::testing::internal::GetCapturedStdout(), {}};
  while (const auto line = lines.take()) {
    EXPECT_EQ(link::get_text(line->process), "mp");
    EXPECT_EQ(line->code, 0);
    a.messages.push_back(link::get_text(line->text));
  }
  return a;
}

TEST(Announcer, TellsTheTerminalWithTheTimeAndEverybodyElseByAMessage) {
  const Announced a = announced("arm1  m = 1  approach", true);
  EXPECT_EQ(a.out, "    9.30 s  arm1  m = 1  approach\n");
  EXPECT_EQ(a.messages, std::vector<std::string>{"arm1  m = 1  approach"});
}

TEST(Announcer, IsSilentOnATerminalThatIsNotThere) {
  const Announced a = announced("show U", false);
  EXPECT_EQ(a.out, "");
  EXPECT_EQ(a.messages.size(), 1U);
}

TEST(Announcer, WhatIsLongerThanAMessageBecomesSeveralAndLosesNothing) {
  std::string text, whole;
  for (int k = 0; k < 100; ++k) text += (text.empty() ? "word" : " word") + std::to_string(k);
  const Announced a = announced(text, true);
  EXPECT_GT(a.messages.size(), 2U);
  for (const std::string& m : a.messages) {
    EXPECT_LE(m.size(), sizeof(console_t::text));
    whole += (whole.empty() ? "" : " ") + m;
  }
  EXPECT_EQ(whole, text);
}

TEST(PrintLine, ATimeIsOnlyWhatALineBeginsWith) {
  EXPECT_EQ(folded("12345.67 s  one two three", 20), "12345.67 s  one two\n            three");
  EXPECT_EQ(folded("1234567.89 s  one two three", 20), "1234567.89 s  one\n  two three")
      << "too far in for a time";
  EXPECT_EQ(folded("0 s  a bb cc", 9), "0 s  a bb\n     cc");
  EXPECT_EQ(folded("0 s  a bb c", 11), "0 s  a bb c") << "it fits just so";
  EXPECT_EQ(folded("0 s  a bb c", 10), "0 s  a bb\n     c");
  EXPECT_EQ(folded("one two", -1), "one two");
}

TEST(PrintLine, OnATerminalALineIsBrokenAtItsWidthAndElsewhereItIsNot) {
  const std::string line = "    0.50 s  one two three four five six";
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0)
    GTEST_SKIP() << "there are no pseudo terminals here";
  const int own = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY);
  ASSERT_GE(own, 0);
  termios raw{};
  ::tcgetattr(own, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(own, TCSANOW, &raw);
  const auto printed_at = [&](unsigned short columns) {
    winsize size{};
    size.ws_col = columns;
    ::ioctl(own, TIOCSWINSZ, &size);
    std::fflush(stdout);
    const int before = ::dup(STDOUT_FILENO);
    ::dup2(own, STDOUT_FILENO);
    print_line(line);
    std::fflush(stdout);
    ::dup2(before, STDOUT_FILENO);
    ::close(before);
    std::string text(200, '\0');
    const auto n = ::read(terminal, text.data(), text.size());
    return text.substr(0, n > 0 ? static_cast<std::size_t>(n) : 0);
  };
  EXPECT_EQ(printed_at(24), folded(line, 24) + "\n");
  EXPECT_EQ(printed_at(30), folded(line, 30) + "\n");
  EXPECT_EQ(printed_at(0), line + "\n") << "a terminal that does not say how wide it is";
  ::close(own);
  ::close(terminal);
  ::testing::internal::CaptureStdout();
  print_line(line);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), line + "\n");
}

}  // namespace
}  // namespace mrroc::mp
