// Writes pictures of a chessboard with poses of the hand, for the documents' commands about cameras:
// board_pictures FOLDER. FOLDER/eye_in_hand.csv and board_in_hand.csv belong to the same pictures.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>

#include "base/representation.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/picture_file.hpp"

namespace {

using namespace mrroc;

constexpr int kPictures = 12;

void add_line(std::ofstream& file, const std::string& picture, const Pose& pose) {
  const AngleAxisPose r = angle_axis_from_pose(pose);
  file << picture;
  for (int n = 0; n < 6; ++n) file << ',' << r[n];
  file << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view word = argc == 2 ? argv[1] : "";
  const bool help = word == "--help" || word == "-h";
  if (help || word.empty() || word.starts_with('-')) {
    std::fputs("Usage: board_pictures FOLDER\nWrites pictures of a chessboard and their poses there.\n",
               help ? stdout : stderr);
    return help ? 0 : 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "pictures");
  std::ofstream eye(folder / "eye_in_hand.csv");
  std::ofstream board(folder / "board_in_hand.csv");
  eye.precision(12);
  board.precision(12);
  const Pose in_hand = pose_from_angle_axis((AngleAxisPose() << 0.05, 0.01, 0.02, 0.1, -0.2, 1.5).finished());
  const Pose outside = pose_from_angle_axis((AngleAxisPose() << 0.9, 0.1, 0.0, 0, 0, 0.3).finished());
  const test::PlaneCamera camera(test::web_camera(), 2);
  const auto texture = test::chessboard_texture(9, 6, 0.025, 0.025);
  std::mt19937 random(3);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  for (int k = 0; k < kPictures; ++k) {
    const Pose T_CG = test::facing(uniform(0.4, 0.7), uniform(0.2, 0.6), uniform(0, 6.3), uniform(-0.5, 0.5),
                                   uniform(-0.1, 0.1), uniform(-0.07, 0.07));
    const std::string name = "view" + std::to_string(k) + ".png";
    test::Exposure exposure;
    exposure.seed = static_cast<unsigned>(k);
    vsp::write_picture(folder / "pictures" / name, camera.render(T_CG, texture, exposure).view());
    add_line(eye, name, outside * T_CG.inverse() * in_hand.inverse());
    add_line(board, name, outside * T_CG * in_hand.inverse());
  }
  return 0;
}
