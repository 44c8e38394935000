// The platforms' room as their cameras see it.
#pragma once
#include <string>
#include <vector>

#include "sim/camera/room_scene.hpp"
#include "sim/camera/view.hpp"
#include "sim/platform/platform_world.hpp"

namespace mrroc::sim {

/// Nothing but platforms moves in it. A platform does not see itself: its cameras look over it.
class RoomView final : public View {
 public:
  /// @param world       outlives this object
  /// @param parameters  as the world was made with @param platforms  their keys, in their order
  RoomView(const PlatformWorld& world, const PlatformWorldParameters& parameters,
           std::vector<std::string> platforms, const camera::Light& light, const RoomLook& look);

  [[nodiscard]] camera::Scene scene(const CameraSetup& camera, std::int64_t step) const override;
  [[nodiscard]] Pose mount(const CameraSetup& camera) const override;
  void tell(std::int64_t) override {}

 private:
  const PlatformWorld& world_;
  std::vector<std::string> platforms_;
  std::vector<camera::Body> outline_;  // of the platforms, in B
  camera::Scene still_;
};

}  // namespace mrroc::sim
