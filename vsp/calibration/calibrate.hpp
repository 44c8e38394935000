// The command `calibrate`: computes the camera's configuration from a folder of pictures and the robot's
// poses.
#pragma once
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "vsp/calibration/hand_eye.hpp"

namespace mrroc::vsp {

/// Order for a calibration: its input files and settings.
struct CalibrationOrder {
  std::filesystem::path pictures;  ///< folder
  std::filesystem::path
      camera;  ///< TOML file with a known lens; empty: the lens is calibrated from the pictures
  std::filesystem::path poses;                        ///< table of poses; empty: the lens alone
  Arrangement arrangement{Arrangement::eye_in_hand};  ///< of camera and board
  std::string name{"camera"};                         ///< key of the camera in the file that is written
  std::string arm{"arm1"};                            ///< key of the arm
  std::filesystem::path output;                       ///< TOML file
  Board board{kBoard};                                ///< in the pictures
};

/// Poses of a table: a line `picture,x,y,z,ax,ay,az` for each - file name, position [m], angle times axis [rad]; lines
/// that begin with # are notes, and the heading may be there.
/// @throws FaultError bad_calibration: file and line, and what is wrong there
std::vector<std::pair<std::string, Pose>> read_poses(const std::filesystem::path& file);

/// Finds the board in all pictures, calibrates, writes the file, and tells on `out` what came of every picture.
/// @throws FaultError bad_picture, bad_calibration, bad_configuration, cannot_write
void calibrate(const CalibrationOrder& order, std::FILE* out);

/// @return the text of the file: [cameras.NAME] as base/camera_config.hpp reads it
/// @param place  none: the pose is left out
std::string as_toml(const CalibrationOrder& order, const CameraModel& model,
                    const std::optional<PlaceCalibration>& place);

}  // namespace mrroc::vsp
