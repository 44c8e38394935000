// What cameras look at: one part of the world, with the bodies that cameras are fixed to.
#pragma once
#include <cstdint>

#include "base/camera_config.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::sim {

/// The cell of the arms, or the room of the platforms. Used by the simulator's thread.
class View {
 public:
  View() = default;
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  virtual ~View() = default;

  /// @param camera  that sees it @param step  now
  /// @return everything that can be seen but other cameras, with its light: a value that shares nothing which changes
  [[nodiscard]] virtual camera::Scene scene(const CameraSetup& camera, std::int64_t step) const = 0;
  /// @return the body that the camera is fixed to, in the world now: its place is known in this frame
  [[nodiscard]] virtual Pose mount(const CameraSetup& camera) const = 0;
  /// Publishes what is true of that which is seen, when it is due.
  virtual void tell(std::int64_t step) = 0;
};

}  // namespace mrroc::sim
