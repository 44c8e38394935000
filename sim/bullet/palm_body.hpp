// The palm of an arm as a body of the scene.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <memory>

#include "sim/bullet/arm_body.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/palm.hpp"

namespace mrroc::sim {

/// Moves with the tool of an arm.
class PalmBody {
 public:
  /// @param arm  outlives the palm, its body is in the scene
  PalmBody(const PalmParameters& parameters, const ArmBody& arm, Scene& scene);
  ~PalmBody();
  PalmBody(const PalmBody&) = delete;
  PalmBody& operator=(const PalmBody&) = delete;

  /// Call after contacts have been found.
  void share_stiffness();

 private:
  PalmParameters p_;
  Scene& scene_;
  btBoxShape box_;
  btCompoundShape palm_;
  std::unique_ptr<btMultiBodyLinkCollider> collider_;
};

}  // namespace mrroc::sim
