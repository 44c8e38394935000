// Recorded pictures: what real files do to the receptors' tool.
#include "vsp/picture_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/annotate.hpp"
#include "vsp/opencv.hpp"
#include "vsp/recorded.hpp"

namespace mrroc::vsp {
namespace {
namespace fs = std::filesystem;

class PictureFileTest : public testing::Test {
 protected:
  PictureFileTest() : folder_(fs::temp_directory_path() / ("mrroc_pictures_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~PictureFileTest() override { fs::remove_all(folder_); }

  static Image board_picture(double roll) {
    static const test::PlaneCamera camera(test::web_camera(), 2);
    return camera.render(test::facing(0.6, 0.3, 0.4, roll), test::chessboard_texture(9, 6, 0.025, 0.025));
  }
  static std::string refusal(const std::function<void()>& action, FaultCode code = FaultCode::bad_picture) {
    try {
      action();
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, code);
      EXPECT_EQ(exit_status(e.fault().code), 2);
      return e.what();
    }
    return "";
  }
  fs::path camera_file() {
    const fs::path file = folder_ / "camera.toml";
    std::ofstream(file) << "[cameras.web]\nfx = 600\ndistortion = [-0.28, 0.09, 0.0006, -0.0004, 0]\n";
    return file;
  }
  std::vector<nlohmann::json> run(const RecordedRun& order) {
    const fs::path out = folder_ / "out.txt";
    std::FILE* const file = std::fopen(out.c_str(), "w");
    try {
      run_recorded(chessboard_receptor(), order, file);
    } catch (...) {
      std::fclose(file);
      throw;
    }
    std::fclose(file);
    std::vector<nlohmann::json> lines;
    std::ifstream stream(out);
    for (std::string line; std::getline(stream, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  fs::path folder_;
};

TEST_F(PictureFileTest, ReadsBackWhatItWrote) {
  const Image image = board_picture(0.2);
  write_picture(folder_ / "a.png", image.view());
  EXPECT_EQ(read_picture(folder_ / "a.png", 1), image);
  EXPECT_EQ(read_picture(folder_ / "a.png").channels, 3);
}

TEST_F(PictureFileTest, RefusesWhatIsNoWholePicture) {
  const fs::path file = folder_ / "a.png";
  EXPECT_NE(refusal([&] { (void)read_picture(file); }).find("no such file"), std::string::npos);
  std::ofstream(file).close();
  EXPECT_NE(refusal([&] { (void)read_picture(file); }).find("empty"), std::string::npos);
  std::ofstream(file) << "a text";
  EXPECT_NE(refusal([&] { (void)read_picture(file); }).find("not a picture"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)read_picture(folder_); }), "");
  write_picture(file, board_picture(0).view());
  const auto size = fs::file_size(file);
  for (const double share : {0.1, 0.5, 0.99}) {
    write_picture(file, board_picture(0).view());
    fs::resize_file(file, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    EXPECT_NE(refusal([&] { (void)read_picture(file); }), "") << share;
  }
}

TEST_F(PictureFileTest, TakesTheFilesOfAFolderInTheOrderOfTheirNumbers) {
  for (const char* name : {"p10.png", "p2.png", "p1.png", "notes.txt", "P3.PNG"})
    std::ofstream(folder_ / name) << "x";
  std::vector<std::string> names;
  for (const auto& file : pictures_in(folder_)) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"P3.PNG", "p1.png", "p2.png", "p10.png"}));
  EXPECT_NE(refusal([&] { (void)pictures_in(folder_ / "none"); }), "");
}

TEST_F(PictureFileTest, PrintsAReadingForEveryPicture) {
  fs::create_directories(folder_ / "in");
  write_picture(folder_ / "in/1.png", board_picture(0.3).view());
  write_picture(folder_ / "in/2.png", Image(640, 480, 3).view());
  RecordedRun order{folder_ / "in", camera_file(), "", folder_ / "drawn", folder_ / "strip.png"};
  const auto lines = run(order);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].at("seen").get<bool>());
  EXPECT_NEAR(lines[0].at("p").at(2).get<double>(), 0.6, 0.001);
  EXPECT_FALSE(lines[1].at("seen").get<bool>());
  EXPECT_FALSE(lines[1].contains("p"));
  EXPECT_TRUE(fs::exists(folder_ / "drawn/000000.png"));
  EXPECT_EQ(read_picture(folder_ / "strip.png").width, 2 * 244 + 4);
}

TEST_F(PictureFileTest, ReadsFilms) {
  const fs::path film = folder_ / "film.avi";
  cv::VideoWriter writer(film.string(), cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                         {640, 480});
  ASSERT_TRUE(writer.isOpened());
  for (int k = 0; k < 3; ++k) {
    const Image image = in_colour(board_picture(0.1 * k).view());
    writer.write(matrix(image.view()));
  }
  writer.release();
  const auto lines = run({film, camera_file(), "web", {}, {}});
  ASSERT_EQ(lines.size(), 3U);
  for (const auto& line : lines) EXPECT_TRUE(line.at("seen").get<bool>());
}

TEST_F(PictureFileTest, SaysWhatIsWrongWithTheOrder) {
  write_picture(folder_ / "small.png", Image(320, 240, 3).view());
  EXPECT_NE(refusal([&] {
              run({folder_ / "small.png", camera_file(), "", {}, {}});
            }).find("640 x 480"),
            std::string::npos);
  EXPECT_NE(refusal([&] { run({folder_ / "none", camera_file(), "", {}, {}}); }), "");
  EXPECT_NE(refusal([&] {
              run({camera_file(), camera_file(), "", {}, {}});
            }).find("neither"),
            std::string::npos);
  EXPECT_NE(refusal(
                [&] {
                  run({folder_ / "small.png", camera_file(), "sac", {}, {}});
                },
                FaultCode::bad_configuration)
                .find("web"),
            std::string::npos);
}

TEST_F(PictureFileTest, DrawsWhatWasFoundAndKeepsALongRunShort) {
  Image picture(640, 480, 3);
  CameraReading reading;
  annotate(picture, reading, test::web_camera(), shape_of(kBoard), "lost");
  EXPECT_GT(picture.view().at(0, 0, 2), 200);  // a red frame
  Image seen(640, 480, 3);
  reading.seen = true;
  reading.T_CG = test::facing(0.5, 0, 0, 0);
  annotate(seen, reading, test::web_camera(), shape_of(kBoard), "seen");
  EXPECT_GT(seen.view().at(335, 240, 2), 150);  // x of G, red, to the right of the middle
  FilmStrip strip(4, 80, 8);
  for (std::int64_t k = 0; k < 1000; ++k)
    if (strip.wants(k, true)) strip.add(k, true, seen.view());
  EXPECT_EQ(strip.picture().width, 4 * 84 + 4);
  EXPECT_LE(strip.picture().height, 2 * 64 + 4);
  EXPECT_TRUE(FilmStrip().picture().empty());
}

/// @return grey levels of the pictures of a strip, one after the other
std::vector<int> shown_on(const Image& strip, int columns, int width, int height) {
  std::vector<int> grey;
  for (int y = 4; y < strip.height; y += height + 4)
    for (int k = 0; k < columns; ++k)
      grey.push_back(strip.view().at(4 + k * (width + 4) + width / 2, y + height / 2, 0));
  return grey;
}

Image plain(int grey) {
  Image picture(64, 48, 3);
  std::ranges::fill(picture.data, static_cast<std::uint8_t>(grey));
  return picture;
}

TEST(FilmStrip, ShowsEveryLookAtWhichSomethingWasReadAndSomeOfWhatWasBetween) {
  FilmStrip strip(4, 64, 16);
  for (std::int64_t k = 0; k < 2000; ++k) {
    const bool seen = k % 250 >= 246;  // eight looks of four pictures
    const int grey = seen ? 100 + static_cast<int>(k / 250) : 50;
    if (strip.wants(k, seen)) strip.add(k, seen, plain(grey).view());
  }
  const std::vector<int> grey = shown_on(strip.picture(), 4, 64, 48);
  ASSERT_EQ(grey.size(), 16U);
  EXPECT_EQ(std::ranges::count(grey, 50), 4);
  for (int look = 0; look < 8; ++look) EXPECT_GE(std::ranges::count(grey, 100 + look), 1) << look;
  std::vector<int> looks;
  std::ranges::copy_if(grey, std::back_inserter(looks), [](int g) { return g >= 100; });
  EXPECT_TRUE(std::ranges::is_sorted(looks)) << "in the order of the run";
}

TEST(FilmStrip, CoversARunInWhichNothingIsSeenEvenly) {
  FilmStrip strip(4, 64, 8);
  for (std::int64_t k = 0; k < 250; ++k)
    if (strip.wants(k, false)) strip.add(k, false, plain(static_cast<int>(k)).view());
  const std::vector<int> grey = shown_on(strip.picture(), 4, 64, 48);
  ASSERT_EQ(grey.size(), 8U);
  EXPECT_EQ(grey.front(), 0);
  for (std::size_t k = 1; k < grey.size(); ++k) EXPECT_LE(grey[k] - grey[k - 1], 64) << k;
  EXPECT_GT(grey.back(), 180);
}

}  // namespace
}  // namespace mrroc::vsp
