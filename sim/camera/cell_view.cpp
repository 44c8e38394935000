#include "sim/camera/cell_view.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/msg/pose_rows.hpp"

namespace mrroc::sim {
namespace {

constexpr std::int64_t kTruthPeriod = 20;  // steps

}  // namespace

CellView::CellView(link::Process& process, const World& world, const WorldParameters& parameters,
                   const std::vector<std::string>& arms, const camera::Light& light,
                   const ObjectParameters& object)
    : world_(world),
      arms_(arms),
      cell_(parameters),
      light_(light),
      object_(object),
      in_hand_(object.in_hand) {
  for (const ArmParameters& arm : parameters.arms) T_UB_.push_back(arm.T_UB);
  if (object.kind == ObjectKind::none) return;
  object_arm_ = index_of(object.arm);
  truth_out_ = process.outbox<object_truth_t>("object.truth");
}

std::size_t CellView::index_of(const std::string& arm) const {
  const auto it = std::ranges::find(arms_, arm);
  if (it == arms_.end()) throw std::out_of_range("there is no arm " + arm);
  return static_cast<std::size_t>(it - arms_.begin());
}

camera::Scene CellView::scene(const CameraSetup&, std::int64_t step) const {
  camera::Scene scene = cell_.take(world_);
  scene.light = light_;
  object_.add_to(scene, T_UB_[object_arm_], object(step));
  return scene;
}

ObjectState CellView::object(std::int64_t step) const {
  ObjectState state = object_.at(static_cast<double>(step) * kStep);
  if (in_hand_) state.T_0G = world_.truth(static_cast<int>(object_arm_)).T_0E * state.T_0G;
  return state;
}

Pose CellView::mount(const CameraSetup& camera) const {
  if (camera.mount == CameraMount::world) return {};
  const std::size_t arm = index_of(camera.robot);
  const Pose& T_UB = T_UB_[arm];
  return camera.mount == CameraMount::base ? T_UB : T_UB * world_.truth(static_cast<int>(arm)).T_0E;
}

void CellView::tell(std::int64_t step) {
  if (!truth_out_ || step % kTruthPeriod != 0) return;
  const ObjectState state = object(step);
  object_truth_t m{};
  m.step = step;
  m.present = state.present;
  m.hidden = state.hidden;
  put_rows(m.T_0G, state.T_0G);
  put_rows(m.T_0E, world_.truth(static_cast<int>(object_arm_)).T_0E);
  truth_out_->publish(m, step / kTruthPeriod);
}

}  // namespace mrroc::sim
