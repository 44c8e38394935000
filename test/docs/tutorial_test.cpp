// The tutorial's code is that of the task press, and the task has the length that it claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace mrroc::test {
namespace {

const std::filesystem::path kRoot = MRROC_SOURCE_DIR;
constexpr std::array kFiles{"tasks/press/press.hpp", "tasks/press/press.cpp", "tasks/press/main.cpp",
                            "tasks/press/main_ecp.cpp"};

std::string trimmed(const std::string& line) {
  const auto first = line.find_first_not_of(' ');
  return first == std::string::npos ? "" : line.substr(first);
}

TEST(Tutorial, EveryLineOfItsCodeStandsInTheTask) {
  std::set<std::string> lines;
  for (const char* file : kFiles) {
    std::ifstream in(kRoot / file);
    for (std::string line; std::getline(in, line);) lines.insert(trimmed(line));
  }
  std::ifstream tutorial(kRoot / "docs/tutorial.md");
  bool code = false;
  int checked = 0;
  for (std::string line; std::getline(tutorial, line);) {
    if (line.starts_with("```")) {
      code = line == "```cpp";
    } else if (code) {
      ++checked;
      EXPECT_TRUE(lines.contains(trimmed(line))) << line;
    }
  }
  EXPECT_GT(checked, 40);
}

TEST(Tutorial, TheTaskHasSixtyLines) {
  long lines = 0;
  for (const char* file : kFiles) {
    std::ifstream in(kRoot / file);
    lines += std::count(std::istreambuf_iterator<char>(in), {}, '\n');
  }
  EXPECT_LE(lines, 60);
}

}  // namespace
}  // namespace mrroc::test
