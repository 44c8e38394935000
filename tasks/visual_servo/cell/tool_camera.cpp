#include "tasks/visual_servo/cell/tool_camera.hpp"

#include <algorithm>

#include "sim/camera/config.hpp"
#include "tasks/visual_servo/config.hpp"

namespace mrroc::visual_servo {

Pose tool_camera_error(const Config& config) {
  const sim::CameraWorld world = sim::read_camera_world(config, {std::string(kArm)}, {});
  const std::string_view key = kCameraNames[index(Camera::eih)];
  const auto found = std::ranges::find_if(
      world.cameras, [key](const sim::SimulatedCamera& c) { return c.setup.key == key; });
  if (found == world.cameras.end()) return {};
  return read_camera(config, found->setup.key).place * (found->setup.place * found->error).inverse();
}

}  // namespace mrroc::visual_servo
