// Names in README and docs must exist: files in code marks, and targets of links.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/file_content.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = MRROC_SOURCE_DIR;

std::vector<fs::path> documents() {
  std::vector<fs::path> files{"README.md", "CHANGELOG.md"};
  for (const char* folder : {"docs", "tasks"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path().lexically_relative(kRoot));
  return files;
}

/// First group of every match.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (auto m = std::sregex_iterator(text.begin(), text.end(), pattern); m != std::sregex_iterator(); ++m)
    found.push_back((*m)[1]);
  return found;
}

/// @return targets of links and pictures without their anchors
std::vector<std::string> links_in(const std::string& text) {
  return all_matches(text, std::regex(R"(\]\(([^)#\s]+)(?:#[^)]*)?\))"));
}

/// @return words in code marks that begin with a folder of the project and end like a file of it
std::vector<std::string> paths_in(const std::string& text) {
  return all_matches(
      text,
      std::regex(
          "[`]((?:base|edp|ecp|mp|vsp|ui_cli|robots|tasks|sim|test|bench|docs|cmake|\\.ci)/[A-Za-z0-9_./-]+"
          "\\.(?:hpp|cpp|in|md|toml|urdf|lcm|cmake|txt|sh))[`]"));
}

TEST(Documents, LinksAndPathsAreFoundInText) {
  const std::string text =
      "see [this](docs/a.md), ![that](b/c.png) and [there](docs/d.md#part); `base/e.hpp`, `x := 1`, `edp/f`";
  EXPECT_EQ(links_in(text), (std::vector<std::string>{"docs/a.md", "b/c.png", "docs/d.md"}));
  EXPECT_EQ(paths_in(text), std::vector<std::string>{"base/e.hpp"});
}

TEST(Documents, LinkOnlyToWhatIsThere) {
  std::size_t links = 0;
  for (const fs::path& document : documents())
    for (const std::string& link : links_in(file_content(kRoot / document))) {
      if (link.find("://") != std::string::npos) continue;
      ++links;
      EXPECT_TRUE(fs::exists(kRoot / document.parent_path() / link)) << document << ": " << link;
    }
  EXPECT_GT(links, 10U);
}

TEST(Documents, NameOnlyFilesThatAreThere) {
  std::size_t paths = 0;
  for (const fs::path& document : documents())
    for (const std::string& path : paths_in(file_content(kRoot / document))) {
      ++paths;
      EXPECT_TRUE(fs::exists(kRoot / path)) << document << ": " << path;
    }
  EXPECT_GT(paths, 30U);
}

TEST(Documents, AreAllReachedFromTheReadme) {
  std::set<fs::path> reached;
  std::vector<fs::path> open{"README.md"};
  while (!open.empty()) {
    const fs::path document = open.back();
    open.pop_back();
    if (!reached.insert(document).second) continue;
    for (const std::string& link : links_in(file_content(kRoot / document)))
      if (link.ends_with(".md")) open.push_back((document.parent_path() / link).lexically_normal());
  }
  for (const fs::path& document : documents())
    if (document.native().starts_with("docs/")) {
      EXPECT_EQ(reached.count(document), 1U) << document;
    }
}

}  // namespace
}  // namespace mrroc::test
