// The cameras' part of the configuration, as the simulator that draws their pictures, the receptors that look
// at them and the agents that use their readings all read it:
//
//   [cameras]
//   order = ["sac", "eih"]
//   [cameras.sac]
//   mount = "arm1.base"                 # or "world"; or "arm1", "rex": moves with the arm's end effector, the platform
//   pose = [0.9, 0, 2.2, 3.14, 0, 0]    # of the camera in the frame of the mount
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/camera.hpp"
#include "base/config.hpp"

namespace mrroc {

/// The body that a camera is fixed to; its place is known in that body's frame.
enum class CameraMount : std::uint8_t {
  world,  ///< the floor: T_UC
  base,   ///< the floor, known relative to an arm's base: 0_C T. The papers' SAC
  robot,  ///< what moves of a robot. An arm's tool, whose tip is E: E_C T, the papers' EIH; a platform: T_BC
};

/// One camera as everybody knows it.
struct CameraSetup {
  std::string key;                        ///< e.g. "sac": channel KEY.frame
  CameraMount mount{CameraMount::world};  ///< `mount`
  std::string robot;                      ///< key of the arm or platform; empty for CameraMount::world
  Pose place;                             ///< T_UC, 0_C T, E_C T or T_BC, see read_camera()
  CameraModel model;                      ///< `width`, `height`, `fx`, `fy`, `cx`, `cy`, `distortion`
  std::int64_t period{20};   ///< steps from one picture to the next; picture n is taken at step n * period
  std::int64_t latency{20};  ///< steps until a picture's reading is visible (rule R6 of docs/architecture.md)
  /// `on_demand`: it gives pictures only while the coordinator asks for them (kCamerasSetting); otherwise there is none
  bool on_demand{};
};

/// Channel on which the coordinator tells the cameras on demand what it wants, a SensorSetting in every macrostep.
inline constexpr const char* kCamerasSetting = "cameras.setting";
/// SensorSetting::mode of pictures that are taken; 0: none are.
inline constexpr int kTakePictures = 1;

/// @return `cameras.order`; none unless it is given
/// @throws ConfigError  a name that is no word of at most 16 letters, digits, - and _
std::vector<std::string> camera_keys(const Config& config);

/// @param key  of a camera
/// @return what [cameras.KEY] says of its lens and pictures alone; what is not given has its default
/// @throws ConfigError
CameraModel read_camera_model(const Config& config, const std::string& key);

/// @param key  of a camera @return cameras.KEY.pose, by which the simulator knows where it truly is @throws ConfigError
Pose read_camera_place(const Config& config, const std::string& key);

/// @param key  one of camera_keys()
/// @return [cameras.KEY] with the place that is believed: cell.cameras.KEY.pose, which a calibration finds, else cameras.KEY.pose,
///         which must be given; everything else has a default
/// @throws ConfigError
CameraSetup read_camera(const Config& config, const std::string& key);

/// A camera's pose from where it stands and what it looks at.
/// @param eye, target  [m] @param up  what points upwards in the picture, not along the axis of view
Pose looking_at(const Vector3& eye, const Vector3& target, const Vector3& up);

}  // namespace mrroc
