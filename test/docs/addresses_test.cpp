// Addresses that documents tell people to type are addresses.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "base/file_content.hpp"
#include "base/link/lcm_bus.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

TEST(Addresses, OfDocumentsCanBeTypedAsTheyStand) {
  static const std::regex address(R"(udpm://[^\s"`|<>)]+)");
  int typed = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(MRROC_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = file_content(entry.path());
    for (auto m = std::sregex_iterator(text.begin(), text.end(), address); m != std::sregex_iterator(); ++m) {
      const std::string url = m->str();
      if (url == "udpm://HOST:PORT?ttl=N") continue;
      EXPECT_NO_THROW(link::LcmAddress::parse(url)) << entry.path() << ": " << url;
      EXPECT_EQ(link::LcmAddress::parse(url).url(), url)
          << "with its ttl, quoted because of the question mark";
      EXPECT_EQ(text[static_cast<std::size_t>(m->position()) - 1], '"') << entry.path() << ": " << url;
      ++typed;
    }
  }
  EXPECT_GT(typed, 0);
}

}  // namespace
}  // namespace mrroc::test
