// What a person is told to type, who called the programs in one way or another.
#include "base/command_hint.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/program.hpp"

namespace mrroc::test {
namespace {

/// The environment of a program that was started by such a command; "": by its own name.
class CalledBy {
 public:
  explicit CalledBy(const char* command) {
    if (const char* const before = std::getenv(kCalledVariable)) before_ = before;
    set(command);
  }
  ~CalledBy() { set(before_); }
  CalledBy(const CalledBy&) = delete;
  CalledBy& operator=(const CalledBy&) = delete;

 private:
  static void set(const std::string& command) {
    if (command.empty())
      ::unsetenv(kCalledVariable);
    else
      ::setenv(kCalledVariable, command.c_str(), 1);
  }
  std::string before_;
};

TEST(CommandHint, InACloneProgramsAreCalledThroughItsScript) {
  const CalledBy clone("./run");
  EXPECT_EQ(typed("ui_cli status"), "./run ui_cli status");
  EXPECT_EQ(command_hint("look with `ui_cli list`, or start `./run press`"),
            "look with `./run ui_cli list`, or start `./run press`");
}

TEST(CommandHint, TheScriptIsCalledAsItWas) {
  const CalledBy elsewhere("../clone/run");
  EXPECT_EQ(typed("./run press --view"), "../clone/run press --view");
  EXPECT_EQ(command_hint("`ui_cli`"), "`../clone/run ui_cli`");
}

TEST(CommandHint, InstalledProgramsAreCalledThroughTheInstalledCommand) {
  const CalledBy installed("mrroc");
  EXPECT_EQ(command_hint("`ui_cli start` after `./run drawing --attended`"),
            "`mrroc ui_cli start` after `mrroc drawing --attended`");
}

TEST(CommandHint, AProgramInThePathIsCalledByItsName) {
  const CalledBy itself("");
  const std::string text = "`ui_cli start` after `./run drawing --attended`";
  EXPECT_EQ(command_hint(text), text);
  EXPECT_EQ(typed("ui_cli"), "ui_cli");
}

TEST(CommandHint, OnlyCommandsAreChanged) {
  const CalledBy clone("./run");
  for (const char* text :
       {"the task `manual`", "`kill 12`", "ui_cli is a program", "`ui_clip`", "one ` alone", "", "`"})
    EXPECT_EQ(command_hint(text), text);
}

TEST(CommandHint, TheRunningProgramNamesItself) {
  const CalledBy clone("./run");
  const std::string own = this_program().filename().string();
  EXPECT_EQ(command_hint("look at `" + own + " --help`"), "look at `./run " + own + " --help`");
  EXPECT_EQ(command_hint("About.\nUsage: " + own + " [OPTIONS]\n\n`ui_cli`"),
            "About.\nUsage: ./run " + own + " [OPTIONS]\n\n`./run ui_cli`");
}

TEST(CommandHint, ASessionIsNamedInWhatSpeaksWithIt) {
  const CalledBy itself("");
  EXPECT_EQ(command_hint("`ui_cli start`", "cell"), "`ui_cli start --session cell`");
  EXPECT_EQ(command_hint("`ui_cli manual home arm1`", "cell"), "`ui_cli manual home arm1 --session cell`");
  EXPECT_EQ(command_hint("`ui_cli trigger --yes`", "cell"), "`ui_cli trigger --yes --session cell`");
  EXPECT_EQ(command_hint("`ui_cli`", "cell"), "`ui_cli --session cell`");
  for (const char* text : {"`ui_cli list`", "`ui_cli log check RUN`", "`ui_cli manual --help`",
                           "`./run press`", "`ui_cli status --session other`"})
    EXPECT_EQ(command_hint(text, "cell"), text);
}

TEST(CommandHint, ErrorLinesAndExamplesAreWhatIsTyped) {
  const CalledBy clone("./run");
  const FaultError error(FaultCode::illegal_in_state, "it waits", "give `ui_cli start`");
  EXPECT_EQ(error.error_line("cell"),
            "error: illegal_in_state: it waits; give `./run ui_cli start --session cell`");
  EXPECT_EQ(explained({{"ui_cli", "look"}, {"./run press --view", "see"}}),
            "  ./run ui_cli         look\n  ./run press --view   see\n");
}

}  // namespace
}  // namespace mrroc::test
