#include "sim/camera/room_view.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/camera/bodies.hpp"

namespace mrroc::sim {
namespace {

constexpr double kHeight = 0.4;  // of a platform [m]
constexpr camera::Colour kYellow{0.85, 0.72, 0.1};

Pose on_floor(const PlanarPose& p) { return {rotation_from_angle_axis({0, 0, p.phi}), {p.x, p.y, 0}}; }

}  // namespace

RoomView::RoomView(const PlatformWorld& world, const PlatformWorldParameters& parameters,
                   std::vector<std::string> platforms, const camera::Light& light, const RoomLook& look)
    : world_(world), platforms_(std::move(platforms)), still_(room_scene(parameters.room, look)) {
  still_.light = light;
  for (const PlatformParameters& each : parameters.platforms)
    outline_.push_back(body(Shape::box, {each.body.length, each.body.width, kHeight},
                            at(Pose{}, {0, 0, kHeight / 2}), kYellow));
}

camera::Scene RoomView::scene(const CameraSetup& camera, std::int64_t) const {
  camera::Scene scene = still_;
  for (std::size_t k = 0; k < outline_.size(); ++k) {
    if (platforms_[k] == camera.robot) continue;
    camera::Body other = outline_[k];
    other.T_UB = on_floor(world_.truth(static_cast<int>(k)).p) * other.T_UB;
    scene.bodies.push_back(std::move(other));
  }
  return scene;
}

Pose RoomView::mount(const CameraSetup& camera) const {
  if (camera.mount == CameraMount::world) return {};
  const auto it = std::ranges::find(platforms_, camera.robot);
  if (it == platforms_.end()) throw std::out_of_range("there is no platform " + camera.robot);
  return on_floor(world_.truth(static_cast<int>(it - platforms_.begin())).p);
}

}  // namespace mrroc::sim
