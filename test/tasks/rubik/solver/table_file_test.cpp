#include "tasks/rubik/solver/table_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <vector>

namespace mrroc::rubik {
namespace {

namespace fs = std::filesystem;

class TableFile : public testing::Test {
 protected:
  TableFile() : folder_(fs::temp_directory_path() / ("mrroc-table-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~TableFile() override { fs::remove_all(folder_); }

  /// Opens the table and looks at its content.
  OpenTable open(const TableKind& kind) {
    OpenTable table = open_table(folder_, kind, [this](std::span<std::uint8_t> bytes) {
      ++fills_;
      for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k * 7);
    });
    const std::span<const std::uint8_t> bytes = table.memory.bytes();
    EXPECT_EQ(bytes.size(), kind.bytes);
    for (std::size_t k = 0; k < bytes.size(); ++k) EXPECT_EQ(bytes[k], static_cast<std::uint8_t>(k * 7));
    return table;
  }
  void damage(const std::function<void(std::vector<char>&)>& how) const {
    const fs::path file = folder_ / "some.table";
    std::ifstream in(file, std::ios::binary);
    std::vector<char> content((std::istreambuf_iterator<char>(in)), {});
    in.close();
    how(content);
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }

  fs::path folder_;
  int fills_{};
};

const TableKind kKind{"some", 3, 5000};

TEST_F(TableFile, IsMadeOnceAndReadAfterwards) {
  EXPECT_EQ(open(kKind).source, TableSource::made);
  const OpenTable again = open(kKind);
  EXPECT_EQ(again.source, TableSource::file);
  EXPECT_TRUE(again.failure_reason.empty());
  EXPECT_EQ(fills_, 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);  // no draft is left
}

TEST_F(TableFile, IsMadeAgainWhenDamaged) {
  const std::vector<std::function<void(std::vector<char>&)>> damages{
      [](auto& c) { c[4096 + 1234] ^= 1; },     // a bit of the content
      [](auto& c) { c[20] ^= 1; },              // the header
      [](auto& c) { c[0] = 'X'; },              // not such a file
      [](auto& c) { c.resize(c.size() - 1); },  // cut off
      [](auto& c) { c.push_back(0); },
      [](auto& c) { c.resize(10); },
      [](auto& c) { c.clear(); },
  };
  open(kKind);
  for (const auto& how : damages) {
    const int before = fills_;
    damage(how);
    const OpenTable repaired = open(kKind);
    EXPECT_EQ(repaired.source, TableSource::made);
    EXPECT_FALSE(repaired.failure_reason.empty());
    EXPECT_EQ(fills_, before + 1);
    EXPECT_EQ(open(kKind).source, TableSource::file);
  }
}

TEST_F(TableFile, OfAnotherVersionOrKindIsMadeAgain) {
  open(kKind);
  EXPECT_EQ(open({"some", 4, 5000}).failure_reason, "it is of another version");
  EXPECT_EQ(open({"some", 4, 5001}).source, TableSource::made);
  fs::rename(folder_ / "some.table", folder_ / "other.table");
  EXPECT_EQ(open({"other", 4, 5001}).source, TableSource::made);
}

TEST_F(TableFile, RemovesTheDraftsOfProcessesThatHaveEnded) {
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  ::waitpid(ended, nullptr, 0);
  fs::create_directories(folder_);
  const auto name = [](const std::string& beginning, pid_t pid) {
    return beginning + "." + std::to_string(pid);
  };
  const std::vector<std::string> left{name("some.table", ended), name("large.table", ended)};
  const std::vector<std::string> kept{name("other.table", ::getppid()), name("notes.txt", ended),
                                      "some.table.old", "some.table.0"};
  for (const auto* const names : {&left, &kept})
    for (const std::string& file : *names) std::ofstream(folder_ / file) << "half a table";
  open(kKind);
  for (const std::string& file : left) EXPECT_FALSE(fs::exists(folder_ / file)) << file;
  for (const std::string& file : kept) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
}

TEST_F(TableFile, ThatCannotBeWrittenIsUsedAllTheSame) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  const OpenTable table = open(kKind);
  EXPECT_EQ(table.source, TableSource::unwritten);
  EXPECT_NE(table.failure_reason.find(folder_.string()), std::string::npos);
}

TEST(TableChecksum, SeesEveryByteAndTheirOrder) {
  std::vector<std::uint8_t> bytes(101);
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k);
  const std::uint64_t sum = checksum(bytes);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    bytes[k] ^= 0x10;
    EXPECT_NE(checksum(bytes), sum);
    bytes[k] ^= 0x10;
  }
  std::swap(bytes[3], bytes[35]);
  EXPECT_NE(checksum(bytes), sum);
  std::swap(bytes[3], bytes[35]);
  EXPECT_EQ(checksum(bytes), sum);
  EXPECT_NE(checksum(std::span(bytes).first(100)), sum);
}

TEST(TableFolder, FollowsTheVariablesOfTheDesktop) {
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(table_folder(), "/somewhere/mrroc");
  ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
  ::setenv("HOME", "/somebody", 1);
  EXPECT_EQ(table_folder(), "/somebody/.cache/mrroc");
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(table_folder().filename(), "mrroc");
}

}  // namespace
}  // namespace mrroc::rubik
