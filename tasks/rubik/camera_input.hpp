// The coordinator's camera input: readings of the virtual receptor that looks at the face shown to the camera.
#pragma once
#include <memory>
#include <optional>

#include "base/camera_config.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert_cube_face.hpp"
#include "mrroc/cube_face_reading_t.hpp"
#include "tasks/rubik/coordinator.hpp"

namespace mrroc::rubik {

/// Used by MP's thread.
class CameraInput {
 public:
  /// @param camera  none: nothing is ever seen
  CameraInput(link::Process& process, const std::optional<CameraSetup>& camera);

  /// @return the link of y_cV0 to the receptor, for the coordinator's links; nothing without a camera
  [[nodiscard]] link::OtherLinks others();
  /// y_cV0: what the receptor is to look at, from the next macrostep that is sent on.
  void ask(const CubeFaceSetting& V);
  /// The newest reading that is visible in macrostep i (rules R6, R7): in lock-step it is waited for.
  /// @throws FaultError peer_silent
  void read(std::int64_t i, SeenFace& V);

 private:
  link::Process& process_;
  std::optional<CameraSetup> camera_;
  std::unique_ptr<link::Inbox<cube_face_reading_t>> in_;
  std::unique_ptr<link::OutgoingLink<CubeFaceSetting>> setting_out_;
  link::Sources sources_;
};

}  // namespace mrroc::rubik
