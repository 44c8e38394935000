// The odometry's program on recorded pairs: what is printed and what is refused.
#include "vsp/odometry/receptor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "test/vsp/stereo_config.hpp"
#include "test/vsp/stereo_room.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;

class RecordedOdometry : public testing::Test {
 protected:
  RecordedOdometry() : folder_(fs::temp_directory_path() / ("mrroc_pairs_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "rex_left");
    fs::create_directories(folder_ / "rex_right");
    write(test::stereo_text());
  }
  ~RecordedOdometry() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(folder_ / "rex.toml") << text; }
  void record(int pairs) const {
    test::StereoRoom room;
    for (int k = 0; k < pairs; ++k) {
      const test::PicturePair pair = room.pair(test::planar_motion(0.05 * k, 0), k);
      const std::string name = std::to_string(k) + ".png";
      write_picture(folder_ / "rex_left" / name, pair.left.view());
      write_picture(folder_ / "rex_right" / name, pair.right.view());
    }
  }
  /// Runs the program. @return its exit status
  int program(std::vector<std::string> words) {
    words.insert(words.begin(), "vsp_odometry");
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = odometry_main(static_cast<int>(words.size()), argv.data());
    std::fflush(stdout);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return status;
  }
  int program() {
    return program({"--source", folder_.string(), "--camera", (folder_ / "rex.toml").string()});
  }

  fs::path folder_;
  std::string out_, err_;
};

TEST_F(RecordedOdometry, PrintsALineForEveryPairAndTheMotionFromTheSecondOn) {
  record(3);
  ASSERT_EQ(program(), 0) << err_;
  std::istringstream lines(out_);
  std::string text;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(std::getline(lines, text));
    const auto line = nlohmann::json::parse(text);
    EXPECT_EQ(line.at("frame"), k);
    EXPECT_EQ(line.at("step"), 40 * k);
    EXPECT_EQ(line.at("left"), (folder_ / "rex_left" / (std::to_string(k) + ".png")).string());
    EXPECT_EQ(line.at("right"), (folder_ / "rex_right" / (std::to_string(k) + ".png")).string());
    EXPECT_EQ(line.at("valid"), k > 0);
    EXPECT_EQ(line.contains("p"), k > 0);
    EXPECT_EQ(line.at("finding"), k > 0 ? "a motion is measured" : "there is no pair of pictures before");
    if (k == 0) continue;
    EXPECT_EQ(line.at("step_before"), 40 * (k - 1));
    EXPECT_NEAR(line.at("p").at(0).get<double>(), 0.05, 1e-3);
    EXPECT_NEAR(line.at("p").at(1).get<double>(), 0, 1e-3);
    EXPECT_NEAR(line.at("aa").at(2).get<double>(), 0, 1e-3);
    EXPECT_EQ(line.at("sigma").size(), 6U);
    EXPECT_GT(line.at("inliers"), 100);
    EXPECT_GE(line.at("matches"), line.at("inliers"));
    EXPECT_LT(line.at("reprojection_px"), 1);
  }
  EXPECT_FALSE(std::getline(lines, text));
}

TEST_F(RecordedOdometry, TellsWhatIsWrongInOneLineAndItsExitStatus) {
  EXPECT_EQ(program(), 2) << "no pictures";
  record(2);
  fs::remove(folder_ / "rex_right/1.png");
  EXPECT_EQ(program(), 2);
  EXPECT_NE(err_.find("has 2 pictures of rex_left and 1 of rex_right"), std::string::npos) << err_;
  write_picture(folder_ / "rex_right/1.png", Image(320, 240, 1).view());
  EXPECT_EQ(program(), 2);
  EXPECT_NE(err_.find("1.png: it is 320 x 240, the camera's pictures are 640 x 480"), std::string::npos)
      << err_;
  write("[cameras.rex_left]\n");
  EXPECT_EQ(program(), 2);
  EXPECT_NE(err_.find("rex.toml has no table [odometry.NAME]"), std::string::npos) << err_;
  write(test::stereo_text() + "[odometry.other]\n");
  EXPECT_EQ(program(), 2);
  EXPECT_NE(err_.find("has several pairs: other, rex"), std::string::npos) << err_;
  EXPECT_NE(err_.find("--name"), std::string::npos) << err_;
  EXPECT_NE(program({"--source", folder_.string()}), 0);
  EXPECT_NE(program({"--sauce", folder_.string()}), 0);
  EXPECT_NE(err_.find("--sauce"), std::string::npos) << err_;
}

TEST_F(RecordedOdometry, HelpTellsTheOptions) {
  EXPECT_EQ(program({"--help"}), 0);
  for (const char* const option : {"--source", "--camera", "--name"})
    EXPECT_NE(out_.find(option), std::string::npos) << out_;
}

}  // namespace
}  // namespace mrroc::vsp
