// Every command that README.md and docs/ tell people to type is typed here: one test for each document.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "test/docs/commands.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

/// Longest time for one command.
constexpr const char* kTimeout = "120";

std::set<std::string> documents() {
  std::set<std::string> found;
  for (const Command& c : document_commands(MRROC_SOURCE_DIR)) found.insert(c.document.string());
  return found;
}

std::string named(const ::testing::TestParamInfo<std::string>& info) {
  // Those at the top have the plain name of their file.
  fs::path path(info.param);
  if (path.parent_path() == "docs") path = path.filename();
  std::string name;
  for (const char c : path.replace_extension().string()) name += std::isalnum(c) != 0 ? c : '_';
  return name;
}

/// A made-up clone, in which ./run finds everything built, and where runs are left.
class TypedCommands : public ::testing::TestWithParam<std::string> {
 protected:
  TypedCommands() {
    std::string pattern = (fs::temp_directory_path() / "doc-commands-XXXXXX").string();
    place_ = ::mkdtemp(pattern.data());
  }
  ~TypedCommands() override { fs::remove_all(place_); }

  /// @return exit status of the shell that has run the script after test/docs/prelude.sh; 124 after its time
  int type(const std::string& script) const {
    std::ofstream(place_ / "typed") << script;
    const std::string line = "timeout --kill-after=5 " + std::string(kTimeout) +
                             " bash " MRROC_SOURCE_DIR "/test/docs/prelude.sh " MRROC_SOURCE_DIR
                             " " MRROC_BUILD " " +
                             place_.string() + " >" + (place_ / "said").string() + " 2>&1 </dev/null";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }
  std::string said() const {
    std::ifstream in(place_ / "said");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path place_;
};

TEST_P(TypedCommands, Work) {
  const auto trials = read_trials(MRROC_SOURCE_DIR);
  bool lacks = false;
  for (const Command& c : document_commands(MRROC_SOURCE_DIR)) {
    if (c.document != GetParam()) continue;
    const Trial trial = trial_of(trials, c.text);
    if (!trial.not_run.empty()) {
      std::cout << "command: not_run as it stands, 0 s: " << c.text << ": " << trial.not_run << "\n";
      continue;
    }
    constexpr int kNeeds = 77;  // something that this host does not have
    const auto begun = std::chrono::steady_clock::now();
    const int status = type(trial.script);
    const double lasted = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    // The benchmark counts these lines.
    std::cout << "command: "
              << (status == 0        ? "ok"
                  : status == kNeeds ? "lacks"
                                     : "failed")
              << (trial.stand_in.empty() ? " as it stands, " : " stand-in, ") << lasted << " s: " << c.text
              << "\n";
    if (status == kNeeds) lacks = true;
    EXPECT_TRUE(status == 0 || status == kNeeds)
        << c.document << ":" << c.line << ": " << c.text << "\nrun as:\n"
        << trial.script << "\nended with " << status << ":\n"
        << said();
  }
  if (lacks)
    GTEST_SKIP() << "some commands need what this host lacks: multicast, Chromium, git, dpkg-dev or PyPI";
}

INSTANTIATE_TEST_SUITE_P(Of, TypedCommands, ::testing::ValuesIn(documents()), named);

}  // namespace
}  // namespace mrroc::test
