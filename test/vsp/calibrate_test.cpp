// The command `calibrate`: what it reads, what it tells of every picture, and what it writes.
#include "vsp/calibration/calibrate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iomanip>
#include <random>
#include <sstream>

#include "base/camera_config.hpp"
#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {
namespace fs = std::filesystem;

std::string padded(const std::string& name) { return name + std::string(32 - name.size(), ' ') + " "; }
std::string fixed(double x, int digits) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(digits) << x;
  return out.str();
}

Pose pose(double x, double y, double z, double ax, double ay, double az) {
  return pose_from_angle_axis((AngleAxisPose() << x, y, z, ax, ay, az).finished());
}

class Calibrate : public testing::Test {
 protected:
  Calibrate() : folder_(fs::temp_directory_path() / ("mrroc_calibrating_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "pictures");
    order_.pictures = folder_ / "pictures";
    order_.output = folder_ / "out.toml";
    order_.name = "sac";
  }
  ~Calibrate() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& text) {
    fs::path path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }
  fs::path lens(int width = 640) {
    return file("lens.toml", "[cameras.web]\nwidth = " + std::to_string(width) +
                                 "\nfx = 600\nfy = 600\ncx = 319.5\ncy = 239.5\n"
                                 "distortion = [-0.28, 0.09, 0.0006, -0.0004, 0]\n");
  }
  void picture(const std::string& name, const Pose& T_CG, unsigned seed = 1) {
    write_picture(folder_ / "pictures" / name,
                  test::web_plane_camera()
                      .render(T_CG, test::chessboard_texture(9, 6, 0.025, 0.025), {.seed = seed})
                      .view());
  }
  std::string printed() {
    char* text{};
    std::size_t size{};
    std::FILE* const out = open_memstream(&text, &size);
    std::string refused;
    try {
      calibrate(order_, out);
    } catch (const FaultError& e) {
      refused = e.what();
      code_ = e.fault().code;
    }
    std::fclose(out);
    const std::string all(text, size);
    std::free(text);  // NOLINT
    return all + refused;
  }
  BoardView view(const std::string& name) {
    return {name, find_corners(read_picture(folder_ / "pictures" / name, 1).view()).value()};
  }
  std::string poses_refused(const std::string& text) {
    const fs::path table = file("poses.csv", text);
    try {
      (void)read_poses(table);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_calibration);
      EXPECT_EQ(e.remedy(), "correct the table: picture,x,y,z,ax,ay,az in m and rad");
      EXPECT_NE(std::string(e.what()).find(table.string()), std::string::npos);
      return e.what();
    }
    return "";
  }

  fs::path folder_;
  CalibrationOrder order_;
  FaultCode code_{FaultCode::none};
};

TEST_F(Calibrate, ATableOfPosesHasNotesAHeadingAndSixNumbersALine) {
  const auto poses = read_poses(file("poses.csv",
                                     "# notes, with a comma\n\npicture,x,y,z,ax,ay,az\n"
                                     "a.png,0.1,-0.2,0.3,0.4,0.5,-0.6\npicture b.png,1,2,3,0,0,0\n"));
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].first, "a.png");
  const AngleAxisPose r = angle_axis_from_pose(poses[0].second);
  const std::array<double, 6> values{0.1, -0.2, 0.3, 0.4, 0.5, -0.6};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(r[k], values[static_cast<std::size_t>(k)], 1e-12) << k;
  EXPECT_EQ(poses[1].first, "picture b.png");
  EXPECT_EQ(poses[1].second.p, Vector3(1, 2, 3));
}

TEST_F(Calibrate, ATableThatIsWrongIsRefusedWithItsLine) {
  const std::string good = "a.png,1,2,3,0,0,0\n";
  for (const char* const line : {",1,2,3,0,0,0\n", "a.png\n", "a.png 1 2 3 0 0 0\n"})
    EXPECT_NE(poses_refused(good + line).find(":2: not picture,x,y,z,ax,ay,az"), std::string::npos) << line;
  EXPECT_NE(poses_refused(good + "b.png,1,2,3,0,0,0,7\n").find(":2: more than six numbers"),
            std::string::npos);
  EXPECT_NE(poses_refused("# note\n" + good + "b.png,1,2,3,0,0\n").find(":3:"), std::string::npos);
  EXPECT_NE(poses_refused(good + good + "b.png,1,2,3,0,0,x\n").find(":3:"), std::string::npos);
  EXPECT_NE(poses_refused(good + "b.png,1,2,3,0,0,0"), "") << "cut short in its last line";
  EXPECT_THROW((void)read_poses(folder_ / "none.csv"), FaultError);
}

TEST_F(Calibrate, ATableMayHaveTenMegabytes) {
  const std::string line = "a.png,1,2,3,0,0,0\n";
  const fs::path table =
      file("poses.csv", line + "#" + std::string(10'000'000 - line.size() - 2, '-') + "\n");
  EXPECT_EQ(fs::file_size(table), 10'000'000U);
  EXPECT_EQ(read_poses(table).size(), 1U);
  fs::resize_file(table, 10'000'001);
  try {
    (void)read_poses(table);
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()).find(":3:"), std::string::npos) << e.what() << ": it has not been read";
  }
}

TEST_F(Calibrate, TheFileHasTheLensAndThePlaceAsTheConfigurationReadsThem) {
  CameraModel m;
  m.width = 800;
  m.height = 600;
  m.fx = 701.23456;
  m.fy = 702.5;
  m.cx = 399.25;
  m.cy = 301.125;
  m.distortion = {-0.1, 0.02, 0.003, -0.0004, 0.00005};
  order_.name = "eih";
  order_.arm = "arm2";
  const std::string expected =
      "[cameras.eih]\nwidth = 800\nheight = 600\nfx = 701.2346\nfy = 702.5000\ncx = 399.2500\ncy = 301.1250\n"
      "distortion = [-0.1000000, 0.0200000, 0.0030000, -0.0004000, 0.0000500]\n";
  EXPECT_EQ(as_toml(order_, m, std::nullopt), expected);
  PlaceCalibration place;
  place.camera = pose(0.1, -0.2, 0.3, 0.4, 0.5, -0.6);
  const std::string numbers = "pose = [0.100000, -0.200000, 0.300000, 0.4000000, 0.5000000, -0.6000000]\n";
  for (const Arrangement a :
       {Arrangement::eye_in_hand, Arrangement::board_in_hand, Arrangement::known_board}) {
    order_.arrangement = a;
    const std::string mount = a == Arrangement::eye_in_hand ? "arm2" : "arm2.base";
    EXPECT_EQ(as_toml(order_, m, place), expected + "mount = \"" + mount + "\"\n" + numbers);
    const CameraSetup read = read_camera(Config::parse(as_toml(order_, m, place), "test"), "eih");
    EXPECT_EQ(read.model.distortion, m.distortion);
    EXPECT_EQ(read.robot, "arm2");
    EXPECT_LT((read.place.p - place.camera.p).norm(), 1e-6);
  }
}

// One picture of a board whose place is known is enough when the lens is known.
TEST_F(Calibrate, TellsOfEveryPictureWhatCameOfIt) {
  const Pose X = pose(0.5, 0.1, 1.2, 0.3, 2.8, 0.1);
  std::string table;
  std::vector<PosedView> views;
  for (const auto& [name, T] : {std::pair("a.png", test::facing(0.6, 0.3, 0.4, 0.1)),
                                std::pair("c.png", test::facing(0.7, 0.2, 2, 0.3))}) {
    picture(name, T);
    const AngleAxisPose r = angle_axis_from_pose(X * T);
    table += name;
    for (int n = 0; n < 6; ++n) table += "," + fixed(r[n], 12);
    table += "\n";
    views.push_back({view(name), pose_from_angle_axis(r)});
  }
  picture("d.png", test::facing(0.6, 0, 0, 0));
  write_picture(folder_ / "pictures/b.png", Image(640, 480, 1).view());
  order_.camera = lens();
  order_.poses = file("poses.csv", table);
  order_.arrangement = Arrangement::known_board;
  const std::string said = printed();
  const PlaceCalibration place = calibrate_place(test::web_camera(), order_.arrangement, views);
  EXPECT_EQ(said, padded("b.png") + "no board, or not one whole board: left out\n" + padded("d.png") +
                      "no pose: left out\n" + padded("a.png") + "place " + fixed(place.view_px[0], 3) +
                      " px\n" + padded("c.png") + "place " + fixed(place.view_px[1], 3) +
                      " px\nplace: " + fixed(place.rms_px, 3) + " px over 2 pictures, position +- " +
                      fixed(1e3 * place.sigma_m, 2) + " mm\nwritten: " + order_.output.string() + "\n");
  EXPECT_LT((place.camera.p - X.p).norm(), 0.002);
  const CameraSetup camera = read_camera(Config::load(order_.output), "sac");
  EXPECT_EQ(camera.mount, CameraMount::base);
  EXPECT_LT((camera.place.p - X.p).norm(), 0.002);
  EXPECT_EQ(camera.model, test::web_camera()) << "that of the file";
}

TEST_F(Calibrate, WithoutPosesItIsTheLensAlone) {
  std::mt19937 random(4);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  std::vector<BoardView> views;
  std::string expected;
  for (int k = 0; k < 9; ++k) {
    const std::string name = "p" + std::to_string(k) + ".png";
    picture(name,
            test::facing(uniform(0.4, 0.6), uniform(0.2, 0.6), uniform(0, 6.3), uniform(-0.4, 0.4),
                         uniform(-0.08, 0.08), uniform(-0.06, 0.06)),
            static_cast<unsigned>(k));
    try {
      views.push_back(view(name));
    } catch (const std::bad_optional_access&) {
      expected += padded(name) + "no board, or not one whole board: left out\n";
    }
  }
  ASSERT_GE(views.size(), kLeastViews);
  const LensCalibration lens = calibrate_lens(640, 480, views);
  for (std::size_t k = 0; k < views.size(); ++k)
    expected += padded(views[k].name) + "lens " + fixed(lens.view_px[k], 3) + " px\n";
  expected += "lens: " + fixed(lens.rms_px, 3) + " px over " + std::to_string(views.size()) +
              " pictures, focal length " + fixed(lens.model.fx, 2) + " +- " +
              fixed(lens.sigma_f * lens.model.fx, 2) + " pixels\nwritten: " + order_.output.string() + "\n";
  EXPECT_EQ(printed(), expected);
  std::ifstream stream(order_.output);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text, as_toml(order_, lens.model, std::nullopt));
  EXPECT_EQ(text.find("pose"), std::string::npos);
}

TEST_F(Calibrate, PicturesOfTwoSizesAreRefusedInEitherDirection) {
  for (const auto& [width, height] : {std::pair(641, 480), std::pair(640, 479)}) {
    write_picture(folder_ / "pictures/a.png", Image(640, 480, 1).view());
    write_picture(folder_ / "pictures/b.png", Image(width, height, 1).view());
    EXPECT_NE(printed().find((folder_ / "pictures/b.png").string() + ": it is " + std::to_string(width) +
                             " x " + std::to_string(height) + ", the first one 640 x 480"),
              std::string::npos);
    EXPECT_EQ(code_, FaultCode::bad_picture);
  }
}

TEST_F(Calibrate, WithoutABoardItSaysWhichBoardItLookedFor) {
  write_picture(folder_ / "pictures/a.png", Image(640, 480, 1).view());
  order_.board.columns = 7;
  order_.board.rows = 4;
  EXPECT_NE(printed().find("no picture shows the whole board of 7 x 4 inner corners"), std::string::npos);
  EXPECT_EQ(code_, FaultCode::bad_calibration);
  EXPECT_FALSE(fs::exists(order_.output));
}

TEST_F(Calibrate, TakesTheOnlyCameraOfAFileOrTheOneOfItsName) {
  picture("a.png", test::facing(0.6, 0.3, 0.4, 0.1));
  order_.camera = lens();
  EXPECT_NE(printed().find("written: "), std::string::npos) << "the only one, whatever it is called";
  std::ofstream(order_.camera, std::ios::app) << "[cameras.sac]\nfx = 555\n";
  EXPECT_NE(printed().find("written: "), std::string::npos);
  EXPECT_EQ(read_camera_model(Config::load(order_.output), "sac").fx, 555);
  order_.name = "eih";
  EXPECT_NE(printed().find(order_.camera.string() + " has no table [cameras.eih]"), std::string::npos);
  EXPECT_EQ(code_, FaultCode::bad_configuration);
  order_.camera = file("empty.toml", "");
  EXPECT_NE(printed().find("has no table [cameras.eih]"), std::string::npos);
}

TEST_F(Calibrate, ALensOfAnotherSizeThanThePicturesIsRefusedInEitherDirection) {
  picture("a.png", test::facing(0.6, 0.3, 0.4, 0.1));
  order_.camera = lens(641);
  EXPECT_NE(printed().find("the pictures are 640 x 480, the camera's are 641 x 480"), std::string::npos);
  EXPECT_EQ(code_, FaultCode::bad_picture);
  std::ofstream(lens(640), std::ios::app) << "height = 500\n";
  EXPECT_NE(printed().find("the pictures are 640 x 480, the camera's are 640 x 500"), std::string::npos);
}

TEST(FindCorners, NeedsOneWholeBoard) {
  const test::PlaneCamera& camera = test::web_plane_camera();
  const auto board = test::chessboard_texture(9, 6, 0.025, 0.025);
  const Pose T = test::facing(0.6, 0.3, 0.4, 0.1);
  const auto found = find_corners(camera.render(T, board).view());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 54U);
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 9; ++c) {
      const Vector2 expected = project(test::web_camera(), T * kBoard.corner(r, c));
      EXPECT_LT(((*found)[static_cast<std::size_t>(9 * r + c)] - expected).norm(), 0.3) << r << ' ' << c;
    }
  EXPECT_FALSE(find_corners({}));
  EXPECT_FALSE(find_corners(Image(640, 480, 1).view()));
  EXPECT_FALSE(find_corners(camera.render(T, board).view(), {.columns = 7, .rows = 6}));
  const Image two = camera.render(test::facing(0.9, 0.2, 1, 0),
                                  [&](double x, double y) { return board(x < 0 ? x + 0.17 : x - 0.17, y); });
  EXPECT_FALSE(find_corners(two.view())) << "which of the two?";
}

}  // namespace
}  // namespace mrroc::vsp
