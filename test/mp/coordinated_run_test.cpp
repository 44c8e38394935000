// Lines of progress of a task whose coordinator has behaviours of its own.
#include "mp/coordinated_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/text_file.hpp"

namespace mrroc::mp {
namespace {

/// @return how often a text has that line's end
int count(const std::string& text, const std::string& what) {
  int found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(CoordinatedRun, AnnouncesABehaviourWhenItBeginsAndNotInEachOfItsMacrosteps) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("coordinated_run_test." + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  write_text_file(folder / "config.toml", "");
  TaskOptions options;
  options.separate = false;
  ::testing::internal::CaptureStdout();
  {
    TaskRun run("test", options, folder, {}, {});
    CoordinatedLinks links(run, {});
    for (const int m : {1, 1, 1, 2, 2, 1, 1}) links.observe(m, m == 1 ? "press" : "let go", "", {});
    EXPECT_EQ(run.board().m(), 1);
  }
  const std::string told = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(count(told, "m = 1  press"), 2) << told;
  EXPECT_EQ(count(told, "m = 2  let go"), 1) << told;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mrroc::mp
