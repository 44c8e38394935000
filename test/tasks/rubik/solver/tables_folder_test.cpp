// Where the solvers' tables are kept: in the folder that is given, or nowhere.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/cube/move.hpp"
#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

namespace fs = std::filesystem;

TEST(TablesFolder, WithoutOneTheTablesAreMadeAndNothingIsKept) {
  const fs::path before = fs::current_path();
  const fs::path empty = fs::temp_directory_path() / ("mrroc-no-tables-" + std::to_string(::getpid()));
  fs::create_directories(empty);
  fs::current_path(empty);
  std::vector<std::string> notices;
  int made = 0;
  const Tables tables(TableSet::small, {}, 1,
                      {.progress = [&](std::string_view, double part) { made += part == 1 ? 1 : 0; },
                       .notice = [&](const std::string& text) { notices.push_back(text); }});
  EXPECT_TRUE(fs::is_empty(empty));
  fs::current_path(before);
  fs::remove_all(empty);
  EXPECT_GT(made, 1);
  EXPECT_EQ(notices, std::vector<std::string>{}) << "that nothing is kept is what was asked for";
  std::mt19937_64 random(1);
  for (int k = 0; k < 1000; ++k) {
    const CosetState s = tables.state_of(random_cube(random));
    ASSERT_EQ(tables.phase1(s.flip_slice_class, s.twist),
              test::small_tables().phase1(s.flip_slice_class, s.twist));
  }
}

TEST(TablesFolder, TablesThatAreThereAreNotMadeAgain) {
  std::ignore = test::small_tables();
  int told = 0;
  const Tables again(TableSet::small, test::tables_folder(), 1,
                     {.progress = [&](std::string_view, double) { ++told; }, .notice = {}});
  EXPECT_EQ(told, 0);
}

}  // namespace
}  // namespace mrroc::rubik
