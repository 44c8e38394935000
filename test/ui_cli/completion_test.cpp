// The completion of words in a shell, in bash itself: whichever way ui_cli is called.
#include "ui_cli/completion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

const std::vector<ui::CompletedCommand> kCommands{{"log", "Look: at runs", {"check", "--json"}},
                                                  {"list", "What's there", {"--json"}},
                                                  {"view", "A page", {"--port"}}};

class Completion : public ::testing::Test {
 protected:
  Completion() {
    std::string pattern = (fs::temp_directory_path() / "completion.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Completion() override { fs::remove_all(folder_); }

  /// A program that prints the text, whatever it is asked.
  void program(const fs::path& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "#!/bin/sh\ncat <<'TEXT'\n" << text << "\nTEXT\n";
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  /// @param words  as bash takes them apart; the last one is being typed @return what bash offers for it
  std::string complete(const std::string& words) const {
    const fs::path file = folder_ / "completion.sh";
    std::ofstream(file) << ui::bash_completion(kCommands) << "set -u\nCOMP_WORDS=(" << words
                        << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                           "name=${COMP_WORDS[0]##*/}\n"
                           "set -- $(complete -p \"$name\")\n"  // complete -o .. -o .. -F FUNCTION NAME
                           "shift 6\n\"$1\"\necho \"${COMPREPLY[@]-}\"\n";
    std::string result;
    FILE* const pipe =
        ::popen(("cd '" + folder_.string() + "' && bash " + file.string() + " 2>&1").c_str(), "r");
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) result += static_cast<char>(c);
    ::pclose(pipe);
    if (!result.empty() && result.back() == '\n') result.pop_back();
    return result;
  }
  fs::path folder_;
};

TEST_F(Completion, CompletesCommandsAndTheirWords) {
  EXPECT_EQ(complete("ui_cli l"), "log list");
  EXPECT_EQ(complete("ui_cli log c"), "check");
  EXPECT_EQ(complete("ui_cli list --"), "--json");
  EXPECT_EQ(complete("build/release/bin/ui_cli log c"), "check");
  EXPECT_EQ(complete("ui_cli --h"), "--help");
  EXPECT_NE(ui::zsh_completion(kCommands).find("'log:Look\\: at runs'"), std::string::npos);
}

TEST_F(Completion, CompletesACommandBehindOptions) {
  EXPECT_EQ(complete("ui_cli --json --session log v"), "view");
  EXPECT_EQ(complete("ui_cli --session log view --"), "--port");
  EXPECT_EQ(complete("ui_cli --session = log view --"), "--port");
  EXPECT_EQ(complete("ui_cli --url udpm : //1.2.3.4 : 7667 view --"), "--port");
}

TEST_F(Completion, AsksTheProgramThatWasTypedForItsSessions) {
  program("bin/ui_cli", R"([{"session": "red"},)"
                        "\n"
                        R"({"session": "blue"}])");
  EXPECT_EQ(complete("bin/ui_cli view --session ''"), "red blue");
  EXPECT_EQ(complete(folder_.string() + "/bin/ui_cli --session = b"), "blue");
  EXPECT_EQ(complete("nowhere/ui_cli --session ''"), "");
}

TEST_F(Completion, WorksBehindTheInstalledCommand) {
  program("bin/mrroc", "Names:\n  press\n  ui_cli\n{\"session\": \"red\"}");
  EXPECT_EQ(complete("bin/mrroc u"), "ui_cli");
  EXPECT_EQ(complete("bin/mrroc ui_cli log c"), "check");
  EXPECT_EQ(complete("bin/mrroc ui_cli --session r"), "red");
  EXPECT_EQ(complete("bin/mrroc press c"), "");
}

TEST_F(Completion, WorksBehindTheRunOfAClone) {
  program("clone/run", "");
  program("clone/build/release/bin/ui_cli", "{\"session\": \"red\"}");
  fs::create_directories(folder_ / "clone/ui_cli");
  program("clone/tasks/press/main.cpp", "");
  EXPECT_EQ(complete("clone/run p"), "package press");
  EXPECT_EQ(complete("clone/run ui_cli log c"), "check");
  EXPECT_EQ(complete("clone/run ui_cli stop --session ''"), "red");
  program("run", "");
  EXPECT_EQ(complete("./run u"), "") << "some other run";
}

}  // namespace
}  // namespace mrroc::test
