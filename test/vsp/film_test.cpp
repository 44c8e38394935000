// Recorded films: what is read of them, and those that break off.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "test/vsp/picture_file_fixture.hpp"
#include "vsp/annotate.hpp"
#include "vsp/opencv.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;
using test::PictureFileTest;
using test::read_bytes;
using test::write_bytes;

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

class FilmTest : public PictureFileTest {
 protected:
  /// Small pictures that grow brighter, 20 a second.
  fs::path film(int pictures) {
    fs::path file = folder_ / "film.avi";
    cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                           20, {64, 48});
    EXPECT_TRUE(writer.isOpened());
    for (int k = 0; k < pictures; ++k) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 + 10 * k)));
    return file;
  }
  /// Leaves of the film's file what is before the data of that picture.
  static void cut(const fs::path& file, int pictures) {
    const std::string all = read_bytes(file);
    std::size_t at = all.find("movi");
    for (int k = 0; k <= pictures; ++k) at = all.find("00dc", at + 4);
    write_bytes(file, all.substr(0, at));
  }
  std::vector<SourcePicture> pictures_of(const fs::path& file) {
    PictureSource source(file);
    std::vector<SourcePicture> all;
    for (SourcePicture one; source.next(one);) all.push_back(one);
    return all;
  }
};

TEST_F(FilmTest, ItsPicturesHaveNumbersAndTimes) {
  const fs::path file = film(5);
  const auto all = pictures_of(file);
  ASSERT_EQ(all.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(all[k].name, file.string() + ":" + std::to_string(k));
    EXPECT_NEAR(all[k].t, 0.05 * static_cast<double>(k), 1e-6);
    EXPECT_EQ(all[k].image.width, 64);
    EXPECT_EQ(all[k].image.height, 48);
    EXPECT_EQ(all[k].image.channels, 3);
    EXPECT_NEAR(all[k].image.view().at(30, 20, 1), 20 + 10 * static_cast<int>(k), 3);
  }
}

/// Big-endian, as in an MP4 file.
std::string bytes_of(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}
std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number{};
  for (std::size_t k = 0; k < 4; ++k) number = number << 8U | static_cast<unsigned char>(bytes.at(at + k));
  return number;
}

/// The pictures of an MP4 film are decoded two picture durations before they are shown, from time 0 on: a table of the
/// delays ("ctts"), and an edit that makes up for them ("elst").
void decode_earlier(const fs::path& film, std::uint32_t pictures) {
  constexpr std::size_t kName = 4;
  std::string all = read_bytes(film);
  const std::size_t durations = all.find("stts") + kName;  // version, number of entries, number of pictures
  const std::uint32_t delay = 2 * number_at(all, durations + 12);
  all.replace(all.find("elst") + kName + 12, 4, bytes_of(delay));  // version, number of entries, duration
  const std::string delays =
      bytes_of(24) + "ctts" + bytes_of(0) + bytes_of(1) + bytes_of(pictures) + bytes_of(delay);
  all.insert(all.find("stsc") - kName, delays);
  for (const char* box : {"moov", "trak", "mdia", "minf", "stbl"}) {
    const std::size_t length = all.find(box) - kName;
    all.replace(length, 4, bytes_of(number_at(all, length) + 24));
  }
  write_bytes(film, all);
}

TEST_F(FilmTest, TheFirstPictureIsNotBeforeTheBeginning) {
  const fs::path file = folder_ / "film.mp4";
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 20,
                         {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int k = 0; k < 5; ++k) writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(20 + 10 * k)));
  writer.release();
  decode_earlier(file, 5);
  const auto all = pictures_of(file);
  ASSERT_EQ(all.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(all[k].t, 0.05 * static_cast<double>(k), 1e-6) << k;
}

TEST_F(FilmTest, OneThatBreaksOffIsRefusedUnlessNearlyAllOfItIsThere) {
  const fs::path file = film(20);
  cut(file, 19);
  EXPECT_EQ(refusal([&] { EXPECT_EQ(pictures_of(file).size(), 19U); }), "") << "containers count roughly";
  cut(film(20), 18);
  EXPECT_NE(
      refusal([&] { pictures_of(file); }).find(file.string() + ": it breaks off after 18 of 20 pictures"),
      std::string::npos);
  cut(film(20), 3);
  EXPECT_NE(refusal([&] { pictures_of(file); }).find(": it breaks off after 3 of 20 pictures"),
            std::string::npos);
  cut(film(20), 0);
  EXPECT_NE(refusal([&] { pictures_of(file); }), "") << "not one picture";
}

}  // namespace
}  // namespace mrroc::vsp
