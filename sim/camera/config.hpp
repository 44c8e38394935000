// The simulator's part of the configuration of cameras: drawing, exposure, light, the object, and how the room looks.
#pragma once
#include <string>
#include <vector>

#include "base/camera_config.hpp"
#include "base/config.hpp"
#include "sim/camera/object_path.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/camera/room_scene.hpp"
#include "sim/time_interval.hpp"

namespace mrroc::sim {

/// What goes wrong with a camera.
struct CameraFaults {
  TimeIntervals silent{};  ///< it gives no pictures
  TimeIntervals black{};   ///< no light falls into it
  TimeIntervals frozen{};  ///< it gives its last picture again and again
  TimeIntervals hangs{};   ///< the same, but its sensor goes on: each has noise of its own
  std::string
      shows{};  ///< key of the camera whose view it really has: another one's when cables are exchanged
};

/// One camera of the simulator.
struct SimulatedCamera {
  CameraSetup setup;              ///< size, times, cameras.KEY.pose as the configuration says; the true lens
  camera::RenderProfile profile;  ///< how it is drawn
  std::int64_t
      exposure{};  ///< steps over which the light is gathered, half of them before the picture's step, half after
  int instants{1};      ///< of the exposure that are drawn; 1: nothing is blurred by motion
  Pose error;           ///< of the place: the true one is setup.place * error
  CameraFaults faults;  ///< that come on purpose
};

/// Settings of the simulator's cameras.
struct CameraWorld {
  std::vector<SimulatedCamera> cameras;  ///< in the order of their keys
  camera::Light light;                   ///< the same for all
  ObjectParameters object;               ///< that those of arms look for
  RoomLook look;                         ///< of the room in which platforms drive
};

/// @return [cameras], [object] and [room.look]; no cameras when `cameras.order` is not given
/// @param arms, platforms  keys of those that there are
/// @throws ConfigError
CameraWorld read_camera_world(const Config& config, const std::vector<std::string>& arms,
                              const std::vector<std::string>& platforms);

}  // namespace mrroc::sim
