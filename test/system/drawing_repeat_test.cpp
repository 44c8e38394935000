// The same seed gives the same run, whatever the processes and the machine do.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

class Repeated : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
    drawing_ = folder_.write("lines.svg", lines_svg(2));
  }

  /// Runs the two lines. @return the run's log_hash, empty if it did not reach its end
  std::string hash_of(const std::string& name, const std::vector<std::string>& arguments) {
    std::vector<std::string> what{"--drawing", drawing_, "--size", "20"};
    if (std::ranges::find(arguments, "--load") != arguments.end()) what.clear();
    const auto end =
        run(folder_, "drawing", words({what, {"--run-dir", (folder_ / name).string()}, arguments}));
    EXPECT_EQ(end.status, 0) << name << ": " << end.all();
    return end.status == 0 ? summary(folder_ / name)["log_hash"].get<std::string>() : "";
  }
  std::string content(const std::string& name, const std::string& file) {
    std::ifstream in(folder_ / name / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Folder folder_;
  std::string drawing_;
};

TEST_F(Repeated, SameSeedGivesTheSameHashInOneProcessAndInSeveral) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const auto separate = hash_of("a", {"--processes", "separate", "--seed", "7"});
  EXPECT_EQ(hash_of("b", {"--processes", "separate", "--seed", "7"}), separate);
  EXPECT_EQ(hash_of("c", {"--processes", "one", "--seed", "7"}), separate);
  EXPECT_NE(hash_of("d", {"--processes", "one", "--seed", "8"}), separate);
  for (const std::string file : {"arm1.csv", "arm2.csv", "taught.csv", "ink1.csv", "ink2.csv"}) {
    EXPECT_EQ(content("a", file), content("c", file)) << file;
    EXPECT_NE(content("a", file), content("d", file)) << file;
  }
}

TEST_F(Repeated, TheRecordedOrdersReplayTheRun) {
  const auto hash = hash_of("a", {"--processes", "one"});
  std::ofstream(folder_ / "more.script") << content("a", "operator.script");
  EXPECT_EQ(hash_of("b", {"--processes", "one", "--script", (folder_ / "more.script").string()}), hash);
}

TEST_F(Repeated, ASavedRecordingIsReproducedWithoutTeaching) {
  const std::string taught = (folder_ / "lines.recording").string();
  hash_of("a", {"--processes", "one", "--save", taught});
  ASSERT_TRUE(fs::exists(taught));
  hash_of("b", {"--processes", "one", "--load", taught});
  EXPECT_FALSE(summary(folder_ / "b")["figures"].contains("teach_rms_mm"));
  EXPECT_EQ(content("b", "taught.csv"), content("a", "taught.csv"));
  for (const std::string arm : {"1", "2"}) {
    EXPECT_TRUE(stretches(read_table(folder_ / "b" / ("arm" + arm + ".csv"), kArmHeading), 2).empty());
    const auto ink = read_table(folder_ / "b" / ("ink" + arm + ".csv"), kInkHeading);
    EXPECT_EQ(strokes(ink), 2);
    EXPECT_LE(distances(ink, read_table(folder_ / "a" / "taught.csv", kInkHeading)).second, 1.5);
  }
  for (const double rms : summary(folder_ / "b")["figures"]["copy_rms_mm"]) EXPECT_LE(rms, 0.5);
}

}  // namespace
}  // namespace mrroc::test
