// Recognition of a document's commands, and agreement of the list of trials with the documents.
#include "test/docs/commands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

namespace mrroc::test {
namespace {

std::vector<std::string> texts(const std::string& document) {
  std::vector<std::string> found;
  for (const Command& c : commands_in("d.md", document)) found.push_back(c.text);
  return found;
}

TEST(DocumentCommands, AreLinesOfShellBlocksWithoutPromptAndRemark) {
  EXPECT_EQ(texts("```\n./run press        # a remark\n$ ui_cli status\n  output 1\nui_cli view      what "
                  "runs now\n```\n"),
            (std::vector<std::string>{"./run press", "ui_cli status", "ui_cli view"}));
  EXPECT_EQ(texts("1. so:\n   ```sh\n   git clone there\n   ```\n"),
            std::vector<std::string>{"git clone there"});
  EXPECT_TRUE(texts("```cpp\n./run press\n```\n```toml\nui_cli = 1\n```\n").empty());
}

TEST(DocumentCommands, AreWordsInCodeMarksWithArguments) {
  EXPECT_EQ(texts("Type `./run press` or `ui_cli log check RUN`; `ui_cli` and `press` are names, `x := 1` is "
                  "none.\n"),
            (std::vector<std::string>{"./run press", "ui_cli log check RUN"}));
  EXPECT_EQ(texts("| `ui_cli completion bash\\|zsh` |\n"),
            std::vector<std::string>{"ui_cli completion bash|zsh"});
}

TEST(DocumentCommands, KnowWhereTheyStand) {
  const auto found = commands_in("d.md", "a\n\n```\n./run press\n```\n`./run weigh`\n");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].line, 4);
  EXPECT_EQ(found[1].line, 6);
}

TEST(DocumentCommands, EveryTrialIsOfACommandThatIsThere) {
  std::set<std::string> there;
  for (const Command& c : document_commands(MRROC_SOURCE_DIR)) there.insert(c.text);
  EXPECT_GT(there.size(), 60U);
  std::set<std::string> tried;
  for (const Trial& t : read_trials(MRROC_SOURCE_DIR)) {
    EXPECT_TRUE(there.contains(t.command)) << "no document has: " << t.command;
    EXPECT_TRUE(tried.insert(t.command).second) << "twice: " << t.command;
    EXPECT_TRUE(t.script.empty() || t.not_run.empty()) << t.command;
    const bool typed = t.script.empty() || t.script.find('@') != std::string::npos ||
                       t.script.find(first_words(t.command)) != std::string::npos;
    EXPECT_TRUE(typed || !t.not_run.empty() || !t.stand_in.empty())
        << t.command << ": its script does not type it, and no stand-in is told:\n"
        << t.script;
  }
}

/// @return whether the script types another command, or does not wait for the end of a task
bool stands_for_another(const Trial& t) {
  static const std::regex placeholder(R"([A-Z]{3}| [A-Z]( |$)|[\[|]|\.\.\.|runs/)");
  if (t.script.find("@ --") != std::string::npos) return true;
  if (t.script.find('@') == std::string::npos && t.script.find(t.command) == std::string::npos &&
      !std::regex_search(t.command, placeholder))
    return true;
  return t.command.starts_with("./run ") && !t.command.starts_with("./run ui_cli") &&
         t.script.find("background @") != std::string::npos &&
         t.script.find("run folder:") == std::string::npos;
}

TEST(DocumentCommands, AreStandInsWhenTheyAreAlteredOrCutOff) {
  EXPECT_TRUE(stands_for_another({"./run a", "@ --short\n", {}, {}}));
  EXPECT_TRUE(stands_for_another({"./run a", "background @\nawait 3 there\n", {}, {}}));
  EXPECT_TRUE(stands_for_another({"./run a --as \"R\"", "./run a --as \"U\"\n", {}, {}}));
  EXPECT_FALSE(stands_for_another({"./run a FILE", "./run a my.svg\n", {}, {}}));
  EXPECT_FALSE(stands_for_another({"./run a", "@ | grep well\n", {}, {}}));
  for (const Trial& t : read_trials(MRROC_SOURCE_DIR))
    EXPECT_TRUE(t.script.empty() || !t.stand_in.empty() || !stands_for_another(t))
        << t.command << ": no line \"~ WHY\" tells that it is not run as it stands:\n"
        << t.script;
}

TEST(DocumentCommands, BeginWithWordsThatStandForNothingElse) {
  EXPECT_EQ(first_words("ui_cli log show RUN [--m]"), "ui_cli log show");
  EXPECT_EQ(first_words("./run bench --json FILE"), "./run bench");
  EXPECT_EQ(first_words("sudo apt install ./build/x.deb"), "sudo apt install");
}

TEST(DocumentCommands, ATrialStandsForTheCommand) {
  const std::vector<Trial> trials{{"./run a", "cd there\n@ --short\n", {}, {}},
                                  {"./run b", {}, "it is long", {}}};
  EXPECT_EQ(trial_of(trials, "./run a").script, "cd there\n./run a --short\n");
  EXPECT_EQ(trial_of(trials, "./run b").not_run, "it is long");
  EXPECT_EQ(trial_of(trials, "./run c").script, "./run c");
}

}  // namespace
}  // namespace mrroc::test
