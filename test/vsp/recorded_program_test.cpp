// A receptor's program on recorded pictures: its options, its help, its errors and its exit status.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "base/fault.hpp"
#include "test/vsp/recorded_fixture.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;
using test::recorded::pixel_receptor;
using test::recorded::Recorded;

TEST_F(Recorded, EveryOptionOfTheProgramGoesToItsPlace) {
  write("1.png", 200);
  write_camera("eih");
  const std::string drawn = (folder_ / "drawn").string(), strip = (folder_ / "strip.png").string();
  EXPECT_EQ(receptor({"--source=" + in(), "--camera", camera(), "--name", "eih", "--annotate", drawn,
                      "--strip", strip}),
            0);
  EXPECT_TRUE(fs::exists(folder_ / "drawn/000000.png"));
  EXPECT_TRUE(fs::is_regular_file(strip));
  EXPECT_EQ(std::ranges::count(out_, '\n'), 1);
}

TEST_F(Recorded, TheProgramTellsErrorsInOneLineAndItsExitStatus) {
  EXPECT_EQ(receptor({"--source", in() + "/none", "--camera", camera()}), 2);
  EXPECT_EQ(out_, "");
  EXPECT_NE(err_.find("there is no such file"), std::string::npos) << err_;
  EXPECT_EQ(std::ranges::count(err_, '\n'), 1) << err_;
  EXPECT_NE(receptor({"--source", in(), "--camera", camera(), "--colour", "red"}), 0) << "no such option";
  EXPECT_NE(err_.find("--colour"), std::string::npos) << err_;
  EXPECT_NE(receptor({"--source", in()}), 0) << "a camera is needed";
  for (const char* const words :
       {"--camera camera.toml`", "--name eih`", "--annotate seen`", "--strip strip.png`"}) {
    const std::string option = std::string(words).substr(0, std::string(words).find(' '));
    EXPECT_EQ(receptor({"--source", in(), option}), 2);
    const std::string example = "`vsp_pixel --source pictures --camera camera.toml";
    EXPECT_NE(err_.find(option == "--camera" ? example + "`" : example + " " + words), std::string::npos)
        << err_;
  }
}

// What OpenCV throws is no error of the framework's.
TEST_F(Recorded, AStrangeErrorIsOneOfThePicture) {
  write("1.png", 200);
  ImageReceptor broken = pixel_receptor();
  broken.make = [](const CameraModel& /*camera*/, const Config& /*config*/) {
    return [](const ImageView& /*picture*/, std::int64_t, std::int64_t) -> CameraReading {
      throw std::runtime_error("it went wrong");
    };
  };
  EXPECT_EQ(receptor({"--source", in(), "--camera", camera()}, broken), exit_status(FaultCode::bad_picture));
  EXPECT_NE(err_.find("bad_picture"), std::string::npos) << err_;
  EXPECT_NE(err_.find("it went wrong"), std::string::npos) << err_;
}

TEST_F(Recorded, TheProgramsHelpTellsBothOfItsUses) {
  EXPECT_EQ(receptor({"--help"}), 0);
  EXPECT_NE(out_.find("Looks at one pixel."), std::string::npos) << out_;
  EXPECT_NE(out_.find("vsp_pixel --source FILE --camera FILE.toml"), std::string::npos) << out_;
  for (const char* const option : {"--source FILE", "--camera FILE.toml", "--name CAMERA",
                                   "--annotate FOLDER", "--strip FILE.png", "As a part of a system:"})
    EXPECT_NE(out_.find(option), std::string::npos) << option;
  EXPECT_EQ(receptor({"--source", in(), "--help"}), 0);
  EXPECT_NE(out_.find("Here on recorded pictures: prints a line of JSON for each."), std::string::npos)
      << out_;
  for (const char* const words :
       {"Looks at one pixel.", "a picture, a folder of pictures, or a film", "--camera TEXT REQUIRED",
        "the camera's TOML file, as `calibrate` writes it",
        "which camera of the file, when there are several", "folder for pictures with the detection drawn in",
        "PNG file with all of them side by side"})
    EXPECT_NE(out_.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace mrroc::vsp
