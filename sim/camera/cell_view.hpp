// The arms' cell as cameras see it, with the object that they look for.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "mrroc/object_truth_t.hpp"
#include "sim/camera/cell_scene.hpp"
#include "sim/camera/object_path.hpp"
#include "sim/camera/view.hpp"

namespace mrroc::sim {

/// Publishes object.truth while there is an object.
class CellView final : public View {
 public:
  /// @param process, world  outlive this object
  /// @param parameters      as the world was made with @param arms  keys of its arms, in their order
  CellView(link::Process& process, const World& world, const WorldParameters& parameters,
           const std::vector<std::string>& arms, const camera::Light& light, const ObjectParameters& object);

  [[nodiscard]] camera::Scene scene(const CameraSetup& camera, std::int64_t step) const override;
  [[nodiscard]] Pose mount(const CameraSetup& camera) const override;
  void tell(std::int64_t step) override;

 private:
  /// @return index of the arm @throws std::out_of_range  there is none with this key
  [[nodiscard]] std::size_t index_of(const std::string& arm) const;
  /// @return the object now, in the base of its arm
  [[nodiscard]] ObjectState object(std::int64_t step) const;

  const World& world_;
  std::vector<Pose> T_UB_;  // of the arms
  std::vector<std::string> arms_;
  CellScene cell_;
  camera::Light light_;
  ObjectPath object_;
  bool in_hand_;
  std::size_t object_arm_{};
  std::unique_ptr<link::Outbox<object_truth_t>> truth_out_;  // null: there is no object
};

}  // namespace mrroc::sim
