// The tutorial's code is that of the task press, and the task has the length that it claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace mrroc::test {
namespace {

const std::filesystem::path kRoot = MRROC_SOURCE_DIR;
constexpr std::array kFiles{"tasks/press/press.hpp", "tasks/press/press.cpp", "tasks/press/main.cpp",
                            "tasks/press/main_ecp.cpp"};

using Code = std::map<std::string, std::string>;  // by file

/// @return text without empty lines
std::string dense(std::istream& in) {
  std::string text;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) text += line + "\n";
  return text;
}

/// @return the code blocks of the tutorial, one after another, under the file that the heading above them names
Code typed() {
  std::ifstream tutorial(kRoot / "docs/tutorial.md");
  Code code;
  std::string file;
  bool inside = false;
  for (std::string line; std::getline(tutorial, line);) {
    std::smatch heading;
    if (std::regex_match(line, heading, std::regex("## .*`(.*)`")))
      file = heading[1];
    else if (line.starts_with("```"))
      inside = line == "```cpp";
    else if (inside && !line.empty())
      code[file] += line + "\n";
  }
  return code;
}

TEST(Tutorial, TypedAsItStandsIsTheTask) {
  const Code code = typed();
  EXPECT_EQ(code.size(), kFiles.size());
  for (const char* file : kFiles) {
    std::ifstream in(kRoot / file);
    ASSERT_TRUE(code.contains(file)) << file;
    EXPECT_EQ(code.at(file), dense(in)) << file;
  }
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
