// Calibrates a camera from pictures of the chessboard.
#include <fmt/core.h>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/print.hpp"
#include "base/standard_files.hpp"
#include "base/target/target_config.hpp"
#include "vsp/calibration/calibrate.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  CommandLine line(
      "Calibrates a camera from pictures of a chessboard: its lens, and with the robot's poses also where it "
      "is.\n"
      "Writes a TOML file that the receptors and tasks read.",
      "calibrate");
  vsp::CalibrationOrder order;
  line.option("--pictures", order.pictures, "folder of pictures: at least 8, from all sides").required();
  line.option("--output", order.output, "TOML file that is written").required();
  line.option("--camera", order.camera, "TOML file with a lens that is known already");
  const Option poses =
      line.option("--poses", order.poses, "table of poses: picture,x,y,z,ax,ay,az in m and rad");
  line.choice<vsp::Arrangement>(
          "--arrangement", order.arrangement,
          {{"eye_in_hand", vsp::Arrangement::eye_in_hand},
           {"board_in_hand", vsp::Arrangement::board_in_hand},
           {"known_board", vsp::Arrangement::known_board}},
          "eye_in_hand: camera in the hand, poses of the hand; board_in_hand: camera beside the "
          "robot, poses of the "
          "hand; known_board: camera beside the robot, poses of the board")
      .needs(poses);
  line.option("--name", order.name, "of the camera in the file, e.g. sac or eih");
  line.option("--arm", order.arm, "whose poses they are");
  std::string board;
  line.option("--board", board,
              "TOML file whose [chessboard] says columns, rows and square of the board (default: 9 x 6 "
              "inner corners, "
              "25 mm)");
  try {
    const std::string example = "calibrate --pictures pictures --output camera.toml";
    if (const auto help = line.parse_or_help(
            argc, argv,
            {example, example + " --name eih --poses poses.csv --arm arm1", example + " --camera lens.toml",
             example + " --poses poses.csv --arrangement board_in_hand", example + " --board board.toml"})) {
      print(stdout, *help);
      return end_standard_output(0);
    }
    if (!board.empty()) {
      const Config file = Config::load(board);
      if (!file.has("chessboard.columns"))
        throw FaultError(FaultCode::bad_configuration, board + " has no chessboard.columns",
                         "write a table [chessboard] with columns, rows and square (in m)");
      order.board = read_board(file);
    }
    vsp::calibrate(order, stdout);
    return end_standard_output(0);
  } catch (const FaultError& e) {
    fmt::print(stderr, "{}\n", e.error_line());
    return exit_status(e.fault().code);
  } catch (const std::exception& e) {  // of OpenCV
    fmt::print(stderr, "{}\n", FaultError(FaultCode::bad_calibration, e.what()).error_line());
    return exit_status(FaultCode::bad_calibration);
  }
}
