// The receptor of the cube's faces on recorded pictures: what it prints and draws of a whole face, of a
// hidden sticker, and of nothing.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/recorded_fixture.hpp"
#include "vsp/annotate.hpp"
#include "vsp/cube_face/receptor.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

using test::recorded::Recorded;

/// White stickers on black, as a camera sees them that looks down from 1.5 m to 1 m; one is hidden.
Image face(bool whole) {
  Image picture(640, 480, 3);
  const double scale = 1000 / 0.5;  // [pixel/m]
  for (int k = 0; k < kStickers; ++k) {
    if (!whole && k == 5) continue;
    const double u = 319.5 + scale * kCubeFace.middle(k).x();
    const double v = 239.5 - scale * kCubeFace.middle(k).y();
    const int half = static_cast<int>(scale * kCubeFace.sticker / 2);
    for (int y = -half; y <= half; ++y)
      for (int x = -half; x <= half; ++x) {
        auto* const pixel = picture.row(static_cast<int>(v) + y) + 3 * (static_cast<int>(u) + x);
        const std::array<int, 3> bgr = k == 1 ? std::array{15, 15, 170} : std::array{180, 180, 180};
        for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(bgr[c]);
      }
  }
  return picture;
}

/// Of a face half a metre away.
void expect_pose(const nlohmann::json& line) {
  EXPECT_NEAR(line.at("p").at(2).get<double>(), 0.5, 0.005);
  EXPECT_GT(line.at("reprojection_px").get<double>(), 0);
  EXPECT_LT(line.at("reprojection_px").get<double>(), 0.6);
  ASSERT_EQ(line.at("sigma").size(), 6U);
  for (const auto& sigma : line.at("sigma")) {
    EXPECT_GT(sigma.get<double>(), 1e-6);
    EXPECT_LT(sigma.get<double>(), 0.05);
  }
}

/// What is said of face(true).
void expect_stickers(const nlohmann::json& line) {
  for (const char* const key : {"rgb", "colour", "confidence", "flaw"})
    ASSERT_EQ(line.at(key).size(), 9U) << key;
  for (std::size_t k = 0; k < 9; ++k) {
    EXPECT_EQ(line.at("colour").at(k), k == 1 ? "red" : "white") << k;
    EXPECT_EQ(line.at("flaw").at(k), "none") << k;
    EXPECT_GT(line.at("confidence").at(k).get<double>(), 0.95) << k;
    EXPECT_EQ(line.at("rgb").at(k),
              k == 1 ? nlohmann::json({170., 15., 15.}) : nlohmann::json({180., 180., 180.}));
  }
}

ObjectShape face_shape() {
  ObjectShape shape;
  const double half = kCubeFace.edge / 2;
  shape.outline = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  for (int k = 0; k < kStickers; ++k) shape.marks.push_back(kCubeFace.middle(k));
  shape.axes = half;
  return shape;
}

/// @return the pose that a line tells
Pose pose_of(const nlohmann::json& line) {
  AngleAxisPose pose;
  for (Eigen::Index n = 0; n < 3; ++n) {
    pose[n] = line.at("p").at(static_cast<std::size_t>(n));
    pose[3 + n] = line.at("aa").at(static_cast<std::size_t>(n));
  }
  return pose_from_angle_axis(pose);
}

/// The receptor of the cube with three pictures: a face, a face of which a sticker is hidden, and nothing.
class RecordedCube : public Recorded {
 protected:
  RecordedCube() {
    std::ofstream(folder_ / "cube.toml")
        << "[cameras.cube]\npose = [0.1, 0.2, 1.5, 3.141592653589793, 0, 0]\n"
           "fx = 1000\nfy = 1000\n[cube_face.places.front]\n"
           "pose = [0.1, 0.2, 1, 0, 0, 0]\n[cube_face.places.above]\n"
           "pose = [0.1, 0.2, 1.1, 0, 0, 0]\n";
    write_picture(folder_ / "in/1.png", face(true).view());
    write_picture(folder_ / "in/2.png", face(false).view());
    write_picture(folder_ / "in/3.png", Image(640, 480, 3).view());
  }

  /// @return a line for each of them
  std::vector<nlohmann::json> run() {
    const std::string drawn = (folder_ / "drawn").string();
    EXPECT_EQ(main_of({"vsp_cube_face", "--source", in(), "--camera", (folder_ / "cube.toml").string(),
                       "--annotate", drawn},
                      cube_face_main),
              0)
        << err_;
    std::istringstream stream(out_);
    std::vector<nlohmann::json> all;
    for (std::string line; std::getline(stream, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
};

TEST_F(RecordedCube, TellsPlacePoseAndStickers) {
  const std::vector<nlohmann::json> all = run();
  ASSERT_EQ(all.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(all[static_cast<std::size_t>(k)].at("frame"), k);
    EXPECT_FALSE(all[static_cast<std::size_t>(k)].contains("ambiguous"));
  }
  const nlohmann::json& line = all[0];
  EXPECT_EQ(line.at("source"), (folder_ / "in/1.png").string());
  EXPECT_EQ(line.at("seen"), true);
  EXPECT_EQ(line.at("valid"), true);
  EXPECT_EQ(line.at("place"), 1) << "above, front";
  expect_pose(line);
  expect_stickers(line);
  EXPECT_EQ(all[1].at("seen"), true);
  EXPECT_EQ(all[1].at("valid"), false);
  EXPECT_EQ(all[1].at("confidence").at(5), 0);
  EXPECT_NE(all[1].at("flaw").at(5), "none");
  EXPECT_EQ(all[2].at("seen"), false);
  EXPECT_EQ(all[2].at("valid"), false);
  EXPECT_EQ(all[2].size(), 5U) << "frame, source, seen, valid, t";
}

TEST_F(RecordedCube, DrawsWhereTheFaceIsAndTheNames) {
  const std::vector<nlohmann::json> all = run();
  ASSERT_EQ(all.size(), 3U);
  CameraModel camera;
  camera.fx = camera.fy = 1000;
  const std::array<std::string, 3> texts{"0  WRW WWW WWW", "1  WRW WW? WWW", "2"};
  for (std::size_t k = 0; k < 3; ++k) {
    CameraReading seen;
    seen.seen = k < 2;
    if (seen.seen) seen.T_CG = pose_of(all[k]);
    Image expected = k == 2 ? Image(640, 480, 3) : face(k == 0);
    annotate(expected, seen, camera, face_shape(), texts[k]);
    EXPECT_EQ(read_picture(folder_ / "drawn" / ("00000" + std::to_string(k) + ".png")), expected) << texts[k];
  }
}

}  // namespace
}  // namespace mrroc::vsp
