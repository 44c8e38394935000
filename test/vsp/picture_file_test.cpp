// Recorded pictures: what real files do to the receptors' tool.
#include "vsp/picture_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/picture_file_fixture.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;
using test::PictureFileTest;
using test::read_bytes;
using test::write_bytes;

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

TEST_F(PictureFileTest, ARefusalNamesTheFileAndThenTheReason) {
  const fs::path file = folder_ / "a.png";
  const auto said = [&](const std::string& why) {
    const std::string text = refusal([&] { (void)read_picture(file); });
    EXPECT_NE(text.find(file.string() + ": " + why), std::string::npos) << text;
  };
  said("there is no such file");
  fs::create_directories(file);
  said("it is not a file");
  fs::remove(file);
  write_bytes(file, "");
  said("it is empty");
  write_bytes(file, "GIF89");
  said("it is not a picture, or damaged");
  write_bytes(file, std::string("\x89PNG") + std::string(100, 'x'));
  said("it is cut short");
  write_bytes(file, std::string(1000, '\0'));
  said("it is not a picture, or damaged");
}

TEST_F(PictureFileTest, BehindAPictureThereMayBeALittleOfSomethingElse) {
  const auto with = [this](const char* name, std::size_t more) {
    const fs::path file = folder_ / name;
    cv::imwrite(file.string(), cv::Mat(20, 30, CV_8UC3, cv::Scalar(10, 120, 200)));
    write_bytes(file, read_bytes(file) + std::string(more, 'x'));
    return refusal([&] { EXPECT_EQ(read_picture(file).width, 30); });
  };
  // The end of a PNG is told by its last chunk of 8 bytes in the last 64, that of a JPEG by a mark of 2 in the last 4096.
  EXPECT_EQ(with("a.png", 0), "");
  EXPECT_EQ(with("a.png", 56), "");
  EXPECT_NE(with("a.png", 57).find("cut short"), std::string::npos);
  EXPECT_EQ(with("a.jpg", 0), "");
  EXPECT_EQ(with("a.jpg", 4094), "");
  EXPECT_NE(with("a.jpg", 4095).find("cut short"), std::string::npos);
}

TEST_F(PictureFileTest, APictureMayBe8192PixelsLongAndNoMore) {
  const auto of = [this](int width, int height) {
    const fs::path file = folder_ / "long.png";
    write_picture(file, Image(width, height, 1).view());
    return refusal([&] {
      const Image picture = read_picture(file, 1);
      EXPECT_EQ(picture.width, width);
      EXPECT_EQ(picture.height, height);
    });
  };
  EXPECT_EQ(of(8192, 1), "");
  EXPECT_EQ(of(1, 8192), "");
  EXPECT_NE(of(8193, 1).find("long.png: it is larger than 8192 pixels"), std::string::npos);
  EXPECT_NE(of(2, 8193).find("long.png: it is larger than 8192 pixels"), std::string::npos);
}

TEST_F(PictureFileTest, ReadsPicturesOfEveryKind) {
  Image picture(17, 9, 3);
  for (std::size_t k = 0; k < picture.data.size(); ++k)
    picture.data[k] = static_cast<std::uint8_t>(7 * k % 256);
  for (const char* const name : {"a.png", "a.bmp", "a.tif", "a.tiff", "a.ppm"}) {
    cv::imwrite((folder_ / name).string(), matrix(picture.view()));
    EXPECT_EQ(read_picture(folder_ / name), picture) << name;
  }
  for (const char* const name : {"a.jpg", "a.jpeg", "a.pgm"}) {
    cv::imwrite((folder_ / name).string(), cv::Mat(9, 17, CV_8U, cv::Scalar(77)));
    const Image grey = read_picture(folder_ / name, 1);
    EXPECT_EQ(grey.channels, 1) << name;
    EXPECT_NEAR(grey.data[40], 77, 1) << name;
    EXPECT_EQ(read_picture(folder_ / name).channels, 3) << name;
  }
  EXPECT_EQ(pictures_in(folder_).size(), 8U) << "all of them are found in a folder";
  for (const fs::path& file : pictures_in(folder_)) {
    PictureSource source(file);
    SourcePicture one;
    EXPECT_TRUE(source.next(one)) << file;
    EXPECT_EQ(one.name, file.string());
    EXPECT_EQ(one.image.channels, 3);
    EXPECT_EQ(one.t, 0);
    EXPECT_FALSE(source.next(one)) << file;
    EXPECT_FALSE(source.next(one)) << file;
  }
}

TEST_F(PictureFileTest, NamesAreInTheOrderOfTheirNumbersAndLetters) {
  const std::vector<std::string> in_order{"P1.png",
                                          "p1.bmp",
                                          "p1.png",
                                          "p1.png.png",
                                          "p1a1.png",
                                          "p1a02.png",
                                          "p01a3.png",
                                          "p01b.png",
                                          "p2.png",
                                          "p02a.png",
                                          "p9b1.png",
                                          "p10.png",
                                          "p010b.png",
                                          "p19.png",
                                          "p21.png",
                                          "p100.png",
                                          "p99999999999999999999.png",
                                          "p100000000000000000000.png",
                                          "pa.png",
                                          "q0.png"};
  for (const std::string& name : in_order) std::ofstream(folder_ / name) << "x";
  std::vector<std::string> names;
  for (const auto& file : pictures_in(folder_)) names.push_back(file.filename().string());
  EXPECT_EQ(names, in_order);
}

TEST_F(PictureFileTest, AFolderWithoutPicturesIsRefused) {
  std::ofstream(folder_ / "notes.txt") << "x";
  EXPECT_NE(refusal([&] {
              (void)pictures_in(folder_);
            }).find(folder_.string() + ": there is no picture in it (.png .jpg .bmp .tif .pgm .ppm)"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              (void)pictures_in(folder_ / "none");
            }).find((folder_ / "none").string() + ": there is no such folder"),
            std::string::npos);
  EXPECT_NE(refusal([&] { PictureSource source(folder_); }).find("there is no picture in it"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              PictureSource source(folder_ / "none");
            }).find((folder_ / "none").string() + ": there is no such file or folder"),
            std::string::npos);
  EXPECT_NE(
      refusal([&] {
        PictureSource source(folder_ / "notes.txt");
      }).find((folder_ / "notes.txt").string() + ": it is neither a picture nor a film that can be read"),
      std::string::npos);
}

TEST_F(PictureFileTest, AFileIsThereAsAWholeOrNotAtAll) {
  const Image picture = board_picture(0);
  write_picture(folder_ / "a.png", picture.view());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1)
      << "nothing else is left";
  const auto text = [&](const fs::path& file, const ImageView& view) {
    return refusal([&] { write_picture(file, view); }, FaultCode::cannot_write);
  };
  EXPECT_NE(
      text(folder_ / "none/a.png", picture.view()).find("cannot write " + (folder_ / "none/a.png").string()),
      std::string::npos);
  EXPECT_NE(text(folder_ / "b.png", {}), "") << "nothing to be written";
  EXPECT_FALSE(fs::exists(folder_ / "b.png"));
  fs::create_directories(folder_ / "c.png/full");
  EXPECT_NE(text(folder_ / "c.png", picture.view()), "") << "a folder has the name";
}

// OpenCV would write lines of its own to the standard error.
TEST_F(PictureFileTest, WhatIsNoFilmIsRefusedByOneVoiceOnly) {
  namespace logging = cv::utils::logging;
  std::ofstream(folder_ / "a.avi") << "no film";
  logging::setLogLevel(logging::LOG_LEVEL_WARNING);
  EXPECT_NE(refusal([&] { PictureSource source(folder_ / "a.avi"); }), "");
  EXPECT_EQ(logging::getLogLevel(), logging::LOG_LEVEL_SILENT);
}

// A small one is written when its file is closed.
TEST_F(PictureFileTest, AFileForWhichThereIsNoRoomIsNotThere) {
  for (const int size : {4, 400}) {
    Image picture(size, size, 1);
    for (std::size_t k = 0; k < picture.data.size(); ++k)
      picture.data[k] = static_cast<std::uint8_t>(k * k / 7);
    fs::create_symlink("/dev/full", folder_ / "a.png.part");
    EXPECT_NE(refusal([&] { write_picture(folder_ / "a.png", picture.view()); }, FaultCode::cannot_write),
              "");
    EXPECT_FALSE(fs::exists(folder_ / "a.png")) << size;
    fs::remove(folder_ / "a.png.part");
  }
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

}  // namespace
}  // namespace mrroc::vsp
