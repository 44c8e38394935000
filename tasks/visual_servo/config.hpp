// The task's configuration: [task], and c_1's knowledge of [cameras].
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/visual_servo/images.hpp"

namespace mrroc::visual_servo {

/// Key of the arm.
inline constexpr std::string_view kArm{"arm1"};
/// Names of the cameras, in the order of Camera.
inline constexpr std::array<std::string_view, kCameras> kCameraNames{"sac", "eih"};

/// Kind of the object in view; it decides receptors and channels.
enum class Object : std::uint8_t { chessboard, apriltag };

/// @return the last part of the names of readings: "board" or "tag"
[[nodiscard]] std::string_view channel_of(Object object);
/// @return channels CAMERA.OBJECT, in the order of Camera
[[nodiscard]] std::array<std::string, kCameras> reading_channels(Object object);

/// @return task.object
[[nodiscard]] Object read_object(const Config& config);

/// @return constants of c_1
/// @throws ConfigError
[[nodiscard]] Parameters read_parameters(const Config& config);

/// For the wall clock: pictures that cannot be drawn in time are left out, and the last one stands for as long as use
/// can be made of it. Sets the default of task.max_age so; what the configuration says remains.
/// @throws ConfigError
void believe_late_pictures(Config& config);

/// Body of the arm's ECP.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// @return the task's TOML file
std::string_view config();

}  // namespace mrroc::visual_servo
