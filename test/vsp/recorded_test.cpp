// The receptors' tool for recorded pictures, with a receptor that tells of a picture what its first pixel
// shows: what is printed, drawn and refused.
#include "vsp/recorded.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/fault.hpp"
#include "test/vsp/recorded_fixture.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;
using test::recorded::cross;
using test::recorded::kHeight;
using test::recorded::kWidth;
using test::recorded::pixel_tool;
using test::recorded::plain;
using test::recorded::reading_of;
using test::recorded::Recorded;
using test::recorded::small_camera;

TEST(ReadingAsJson, SaysEverythingOfAPoseInUnitsOfItsOwn) {
  CameraReading r;
  r.frame = 7;
  r.seen = true;
  r.reprojection_px = 0.25;
  r.T_CG = pose_from_angle_axis((AngleAxisPose() << 0.1, -0.2, 0.7, 0.3, -0.4, 0.5).finished());
  for (int k = 0; k < 6; ++k) r.covariance(k, k) = (k + 1) * (k + 1) * 1e-4;
  const nlohmann::json line = as_json(r, "a.png");
  EXPECT_EQ(line.at("frame"), 7);
  EXPECT_EQ(line.at("source"), "a.png");
  EXPECT_EQ(line.at("seen"), true);
  EXPECT_EQ(line.at("ambiguous"), false);
  EXPECT_EQ(line.at("reprojection_px"), 0.25);
  const std::array<double, 3> p{0.1, -0.2, 0.7}, aa{0.3, -0.4, 0.5};
  ASSERT_EQ(line.at("p").size(), 3U);
  ASSERT_EQ(line.at("aa").size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(line.at("p").at(k).get<double>(), p[k], 1e-12) << k;
    EXPECT_NEAR(line.at("aa").at(k).get<double>(), aa[k], 1e-12) << k;
  }
  ASSERT_EQ(line.at("sigma").size(), 6U);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(line.at("sigma").at(k).get<double>(), 0.01 * static_cast<double>(k + 1), 1e-12) << k;
}

TEST(ReadingAsJson, HasNoPoseWhenNothingWasSeen) {
  CameraReading r;
  r.ambiguous = true;
  const nlohmann::json line = as_json(r, "b.png");
  EXPECT_EQ(line.size(), 4U);
  EXPECT_EQ(line.at("frame"), 0);
  EXPECT_EQ(line.at("seen"), false);
  EXPECT_EQ(line.at("ambiguous"), true);
}

TEST_F(Recorded, PrintsALineForEveryPictureWithItsNumberAndTime) {
  write("1.png", 200);
  write("2.png", 0);
  write("10.png", 200);
  const auto all = lines(pixel_tool(), order());
  ASSERT_EQ(all.size(), 3U);
  const std::array<const char*, 3> names{"1.png", "2.png", "10.png"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(all[k].at("key"), "web");
    EXPECT_EQ(all[k].at("source"), (folder_ / "in" / names[k]).string());
    EXPECT_EQ(all[k].at("t"), 0) << "pictures have no time, films have";
  }
}

TEST_F(Recorded, AReceptorCountsPicturesAndTakesTheirNumbersForSteps) {
  write("1.png", 200);
  write("2.png", 200);
  ASSERT_EQ(receptor({"--source", in(), "--camera", camera()}), 0);
  std::istringstream stream(out_);
  std::string line;
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(std::getline(stream, line));
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json.at("frame"), k);
    EXPECT_EQ(json.at("source"), (folder_ / "in" / (std::to_string(k + 1) + ".png")).string());
    EXPECT_NEAR(json.at("p").at(2).get<double>(), 1 + 0.1 * k, 1e-12);
  }
  EXPECT_FALSE(std::getline(stream, line));
  EXPECT_EQ(err_, "");
}

TEST_F(Recorded, DrawsWhatWasSeenBehindThePicturesNumber) {
  write("1.png", 200);
  write("2.png", 0);
  RecordedRun run = order();
  run.annotate = folder_ / "deep/drawn";
  run.strip = folder_ / "strip.png";
  printed(pixel_tool(), run);
  FilmStrip strip;
  for (std::int64_t k = 0; k < 2; ++k) {
    Image expected = plain(k == 0 ? 200 : 0);
    annotate(expected, reading_of(plain(k == 0 ? 200 : 0).view(), k, k), small_camera(), cross(Config{}),
             k == 0 ? "0  far" : "1");
    EXPECT_EQ(read_picture(run.annotate / (k == 0 ? "000000.png" : "000001.png")), expected) << k;
    strip.add(k, k == 0, expected.view());
  }
  EXPECT_EQ(read_picture(run.strip), strip.picture());
  EXPECT_EQ(std::distance(fs::directory_iterator(run.annotate), fs::directory_iterator{}), 2);
}

TEST_F(Recorded, DrawsNothingUnlessItIsTold) {
  write("1.png", 200);
  printed(pixel_tool(), order());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 2)
      << "camera and pictures";
  RecordedRun run = order();
  run.strip = folder_ / "strip.png";
  printed(pixel_tool(), run);
  EXPECT_TRUE(fs::exists(run.strip));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 3);
}

// Of a long run a strip shows what it shows of a run in the system.
TEST_F(Recorded, TheStripOfALongRunIsThinnedOut) {
  FilmStrip expected;
  for (int k = 0; k < 130; ++k) {
    const int grey = k % 13 == 0 ? 101 + k : 100 - k / 2;
    write(std::to_string(k) + ".png", grey);
    Image drawn = plain(grey);
    annotate(drawn, reading_of(plain(grey).view(), k, k), small_camera(), cross(Config{}),
             std::to_string(k) + (grey > 100 ? "  far" : ""));
    if (expected.wants(k, grey > 100)) expected.add(k, grey > 100, drawn.view());
  }
  RecordedRun run = order();
  run.strip = folder_ / "strip.png";
  printed(pixel_tool(), run);
  EXPECT_EQ(read_picture(run.strip), expected.picture());
}

TEST_F(Recorded, TakesTheOnlyCameraOrTheOneThatIsNamed) {
  write("1.png", 200);
  RecordedRun run = order();
  run.key = "web";
  EXPECT_EQ(lines(pixel_tool(), run).at(0).at("key"), "web");
  std::ofstream(folder_ / "camera.toml", std::ios::app) << "[cameras.light]\ndirect = 1\n";
  run.key = "";
  EXPECT_EQ(lines(pixel_tool(), run).at(0).at("key"), "web") << "the light is no camera";
  write_camera("eih");
  run.key = "eih";
  EXPECT_EQ(lines(pixel_tool(), run).at(0).at("key"), "eih");
}

TEST_F(Recorded, SaysWhichCameraItMisses) {
  write("1.png", 200);
  RecordedRun run = order();
  run.key = "sac";
  const std::string file = run.camera.string();
  EXPECT_NE(refusal(run, FaultCode::bad_configuration).find(file + " has no camera sac; it has web"),
            std::string::npos);
  write_camera("eih");
  run.key = "";
  EXPECT_NE(refusal(run, FaultCode::bad_configuration).find(file + " has several cameras: eih, web"),
            std::string::npos);
  EXPECT_EQ(receptor({"--source", in(), "--camera", camera()}), 2);
  EXPECT_NE(err_.find("choose one with --name"), std::string::npos) << err_;
  EXPECT_EQ(out_, "");
  run.camera = folder_ / "none.toml";
  std::ofstream(run.camera) << "[cameras.light]\ndirect = 1\n";
  EXPECT_NE(
      refusal(run, FaultCode::bad_configuration).find(run.camera.string() + " has no table [cameras.NAME]"),
      std::string::npos);
}

TEST_F(Recorded, RefusesPicturesOfAnotherSizeInEitherDirection) {
  for (const auto& [width, height] : {std::pair(kWidth + 1, kHeight), std::pair(kWidth, kHeight - 1)}) {
    write_picture(folder_ / "in/1.png", Image(width, height, 3).view());
    const std::string said = (folder_ / "in/1.png").string() + ": it is " + std::to_string(width) + " x " +
                             std::to_string(height) + ", the camera's pictures are 64 x 48";
    EXPECT_NE(refusal(order(), FaultCode::bad_picture).find(said), std::string::npos) << said;
  }
}

TEST_F(Recorded, RefusesAFolderThatCannotBeMade) {
  write("1.png", 200);
  RecordedRun run = order();
  run.annotate = folder_ / "camera.toml/drawn";
  EXPECT_NE(refusal(run, FaultCode::cannot_write).find("cannot make the folder " + run.annotate.string()),
            std::string::npos);
}

}  // namespace
}  // namespace mrroc::vsp
