#include "mp/pictures.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

TEST(Pictures, AreThoseOfTheRunFolderAndThenThoseOfItsPlotsInTheirOrder) {
  std::string pattern = (fs::temp_directory_path() / "pictures_test.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  EXPECT_TRUE(pictures_in(folder).empty());
  fs::create_directory(folder / "plots");
  for (const char* name : {"sheet.png", "b.csv", "plots/z.png", "plots/a.png", "plots/a.gp"})
    std::ofstream(folder / name) << "x";
  EXPECT_EQ(pictures_in(folder), (std::vector<fs::path>{folder / "sheet.png", folder / "plots" / "a.png",
                                                        folder / "plots" / "z.png"}));
  EXPECT_TRUE(pictures_in(folder / "none").empty());
  fs::remove_all(folder);
}

TEST(Pictures, WithoutGnuplotEveryScriptIsThereToBeDrawnLater) {
  std::string pattern = (fs::temp_directory_path() / "pictures_test.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.c_str(), 1);
  testing::internal::CaptureStdout();
  draw(folder, {{"a", "plot x\n"}, {"b", "plot x*x\n"}});
  const std::string said = testing::internal::GetCapturedStdout();
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(said, "gnuplot is not installed, so there are no pictures of the run\n") << "once";
  for (const char* name : {"a.gp", "b.gp"}) EXPECT_TRUE(fs::exists(folder / "plots" / name)) << name;
  EXPECT_TRUE(pictures_in(folder).empty());
  fs::remove_all(folder);
}

TEST(Pictures, ThatAreNotWantedLeaveTheirScriptsAndNothingIsSaid) {
  std::string pattern = (fs::temp_directory_path() / "pictures_test.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  testing::internal::CaptureStdout();
  draw(folder, {{"a", "set output 'plots/a.png'\nset terminal png\nplot x\n"}, {"b", "plot x*x\n"}}, true);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  for (const char* name : {"a.gp", "b.gp"}) EXPECT_TRUE(fs::exists(folder / "plots" / name)) << name;
  EXPECT_TRUE(pictures_in(folder).empty());
  fs::remove_all(folder);
}

/// What stands in for gnuplot while it lives, in a folder that is all of PATH.
class Drawing : public ::testing::Test {
 protected:
  Drawing() : path_(::getenv("PATH")) {
    std::string pattern = (fs::temp_directory_path() / "drawing_test.XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
    fs::create_directories(folder / "plots");
    fs::create_directories(folder / "bin");
    ::setenv("PATH", (folder / "bin").c_str(), 1);
  }
  ~Drawing() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder);
  }
  void gnuplot_is(const std::string& script) const {
    std::ofstream(folder / "bin" / "gnuplot") << "#!/bin/sh\n" << script << "\n";
    fs::permissions(folder / "bin" / "gnuplot", fs::perms::owner_all);
  }
  [[nodiscard]] std::string text_of(const std::string& file) const {
    std::ifstream in(folder / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Draws two plots. @return what was told
  std::string draw_two() const {
    ::testing::internal::CaptureStdout();
    draw(folder, {{"force", "plot 1\n"}, {"way", "plot 2\n"}});
    return ::testing::internal::GetCapturedStdout();
  }
  std::string path_;
  fs::path folder;
};

TEST_F(Drawing, EveryScriptIsWrittenDownAndRunInTheRunFolder) {
  gnuplot_is("echo drawn by \"$1\" > \"$1.png\"");
  EXPECT_EQ(draw_two(), "");
  EXPECT_EQ(text_of("plots/force.gp"), "# Run it in the run folder: gnuplot plots/force.gp\nplot 1\n");
  EXPECT_EQ(text_of("plots/way.gp"), "# Run it in the run folder: gnuplot plots/way.gp\nplot 2\n");
  EXPECT_EQ(text_of("plots/force.gp.png"), "drawn by plots/force.gp\n");
  EXPECT_EQ(text_of("plots/way.gp.png"), "drawn by plots/way.gp\n");
  EXPECT_FALSE(fs::exists(folder / "plots" / "gnuplot.log")) << "it said nothing";
}

TEST_F(Drawing, AScriptThatFailsIsToldWithWhereToLookAndTheNextOneIsDrawn) {
  gnuplot_is("echo wrong $1; test $1 = plots/way.gp");
  EXPECT_EQ(draw_two(), "gnuplot could not draw force.png; see plots/gnuplot.log\n");
  EXPECT_EQ(text_of("plots/gnuplot.log"), "wrong plots/force.gp\nwrong plots/way.gp\n");
}

}  // namespace
}  // namespace mrroc::mp
