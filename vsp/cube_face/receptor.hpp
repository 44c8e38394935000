// The receptor of the cube's faces, for programs and tasks.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "vsp/cube_face/cube_face_sensor.hpp"

namespace mrroc::vsp {

/// @return names of the tables [cube_face.places.NAME] in alphabetical order: CubeFaceReading::place counts them from 0
std::vector<std::string> cube_face_places(const Config& config);

/// Makes the sensor of a camera. Thresholds are in [cube_face]; a place's `pose` is that of G in the frame in which the
/// camera's own `pose` is given, e.g. the world (base/camera_config.hpp).
/// @param key  of the camera @throws ConfigError, FaultError bad_configuration
CubeFaceSensor make_cube_face_sensor(const Config& config, const std::string& key);

/// Body of the receptor's process, like run_receptor() (vsp/image_receptor.hpp): readings go to "KEY.cube_face", the
/// film to KEY_cube_face.png. What the coordinator asks of it, which face is shown and in which light, comes by
/// "KEY.cube_face.setting", once per macrostep: only that place is looked at then.
void run_cube_face(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// The receptor's program: a node of a running system, or with --source a tool for recorded pictures, which
/// prints for every one: frame, source, seen, valid, and when seen place, p [m], aa (angle times axis) [rad], sigma,
/// reprojection_px, and of the stickers 0..8 rgb, colour, confidence and flaw.
/// @return exit status
int cube_face_main(int argc, char** argv);

}  // namespace mrroc::vsp
