// The tutorial's code is that of the task press, word for word, and leaves none of it out; the task has the length that
// is claimed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_content.hpp"

namespace mrroc::test {
namespace {

const std::filesystem::path kRoot = MRROC_SOURCE_DIR;
constexpr std::array kFiles{"tasks/press/press.hpp", "tasks/press/press.cpp", "tasks/press/main.cpp",
                            "tasks/press/main_ecp.cpp"};

struct Block {
  std::string file;  ///< the one that was named last
  std::string code;
  int line;  ///< of the tutorial
};

/// @return blocks of code in a language: those without one are commands
std::vector<Block> blocks() {
  std::ifstream tutorial(kRoot / "docs/tutorial.md");
  const std::regex name("`((?:tasks|test)/[A-Za-z0-9_./]+)`");
  std::vector<Block> all;
  std::string file;
  bool inside = false, code = false;
  int number = 0;
  for (std::string line; std::getline(tutorial, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      code = inside && line.size() > 3;
      if (code) all.push_back({file, {}, number});
    } else if (code) {
      all.back().code += line + "\n";
    } else {
      for (auto m = std::sregex_iterator(line.begin(), line.end(), name); m != std::sregex_iterator(); ++m)
        if ((*m)[1] != "tasks/CMakeLists.txt") file = (*m)[1];
    }
  }
  return all;
}

TEST(Tutorial, EveryBlockOfCodeIsInTheFileThatIsNamedAboveIt) {
  const auto all = blocks();
  EXPECT_GE(all.size(), 12U);
  for (const Block& block : all) {
    ASSERT_TRUE(std::filesystem::is_regular_file(kRoot / block.file)) << "line " << block.line;
    EXPECT_NE(file_content(kRoot / block.file).find(block.code), std::string::npos)
        << block.file << " has not what stands in line " << block.line << ":\n"
        << block.code;
  }
}

TEST(Tutorial, NoLineOfTheTaskIsLeftOut) {
  std::map<std::string, std::set<std::string>> told;
  for (const Block& block : blocks()) {
    std::istringstream code(block.code);
    for (std::string line; std::getline(code, line);) told[block.file].insert(line);
  }
  for (const char* file : kFiles) {
    std::ifstream in(kRoot / file);
    for (std::string line; std::getline(in, line);)
      EXPECT_TRUE(line.empty() || told[file].contains(line)) << file << ": " << line;
  }
}

TEST(Tutorial, HasSixSteps) {
  const std::string text = file_content(kRoot / "docs/tutorial.md");
  std::size_t at = 0;
  for (int step = 1; step <= 6; ++step) {
    at = text.find("\n## Step " + std::to_string(step) + ":", at);
    EXPECT_NE(at, std::string::npos) << step;
  }
  EXPECT_EQ(text.find("\n## Step 7"), std::string::npos);
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
