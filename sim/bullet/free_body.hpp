// A free body of the scene, and the pedestal on which it rests at the beginning.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <functional>
#include <memory>
#include <vector>

#include "sim/bullet/scene.hpp"
#include "sim/free_body.hpp"

namespace mrroc::sim {

/// An arm whose palm may touch the body.
struct PalmBearer {
  const btMultiBody* body{};         ///< not null
  std::function<Vector3()> turning;  ///< angular velocity of its tool in the world [rad/s]
  double friction{};                 ///< of its palm; that of a contact is the product with the body's
};

/// Touches palms, pedestal and floor.
class FreeBody {
 public:
  /// @param arms  by which presses are told apart; they outlive this object
  /// @param scene  outlives the body; the pedestal stays in it @param h  integration step [s]
  FreeBody(const FreeBodyParameters& parameters, std::vector<PalmBearer> arms, Scene& scene, double h);
  ~FreeBody();
  FreeBody(const FreeBody&) = delete;
  FreeBody& operator=(const FreeBody&) = delete;

  /// At the beginning of a step: the means over it begin at zero.
  void begin_step();
  /// Before each integration: friction of the palms against a ball that spins between them.
  void push();
  /// After each integration. @param share  of it in the step's means
  void follow(double share);
  /// At the end of a step.
  void end_step() { observe(); }
  /// @return as end_step() has observed it last
  [[nodiscard]] const FreeBodyTruth& truth() const { return truth_; }

  /// Calls take(double) with every number of the mechanical state.
  template <class Take>
  void visit_state(Take take) const {
    for (const double x : truth_.T_UO.R.reshaped()) take(x);
    for (const double x : truth_.T_UO.p) take(x);
    for (const double x : truth_.velocity) take(x);
  }

 private:
  void observe();

  Scene& scene_;
  double h_;
  FreeBodyParameters p_;
  std::vector<PalmBearer> arms_;
  std::vector<Vector3> pressed_;  // by each arm, in the last integration, in the world [N]
  std::unique_ptr<btMultiBody> body_;
  std::unique_ptr<btCollisionShape> shape_;
  std::unique_ptr<btMultiBodyLinkCollider> collider_;
  FreeBodyTruth truth_;
};

}  // namespace mrroc::sim
