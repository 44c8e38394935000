// The help of programs that take a folder: it is text, and asking for it makes nothing.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

struct Ended {
  int status{};
  std::string out;  // standard output and error
};

class ProgramHelp : public ::testing::TestWithParam<const char*> {
 protected:
  ProgramHelp() {
    std::string pattern = (fs::temp_directory_path() / "program_help.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~ProgramHelp() override { fs::remove_all(folder_); }

  /// Runs the program in an empty folder.
  Ended run(const std::string& words) const {
    const std::string line = "cd '" + folder_.string() + "' && '" + GetParam() + "' " + words + " 2>&1";
    Ended ended;
    std::FILE* const pipe = ::popen(line.c_str(), "r");
    if (!pipe) return {-1, "popen"};
    std::array<char, 4096> part{};
    for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
      ended.out.append(part.data(), n);
    const int status = ::pclose(pipe);
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return ended;
  }

  fs::path folder_;
};

TEST_P(ProgramHelp, IsTextWithoutControlBytesAndMakesNoFileAndNoFolder) {
  for (const char* word : {"--help", "-h"}) {
    const Ended ended = run(word);
    EXPECT_EQ(ended.status, 0) << word << ": " << ended.out;
    EXPECT_NE(ended.out.find("Usage"), std::string::npos) << word << ": " << ended.out;
    EXPECT_TRUE(std::ranges::none_of(
        ended.out, [](char c) { return c != '\n' && (static_cast<unsigned char>(c) < ' ' || c == 127); }))
        << word << ": " << ended.out;
    EXPECT_TRUE(fs::is_empty(folder_)) << word;
  }
}

TEST_P(ProgramHelp, AnOptionThatDoesNotExistMakesNoFileAndNoFolder) {
  const Ended ended = run("--no-such-option");
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_TRUE(fs::is_empty(folder_));
}

INSTANTIATE_TEST_SUITE_P(Programs, ProgramHelp, ::testing::Values(MRROC_CALIBRATE, MRROC_BOARD_PICTURES),
                         [](const ::testing::TestParamInfo<const char*>& program) {
                           return fs::path(program.param).filename().string();
                         });

}  // namespace
}  // namespace mrroc::test
