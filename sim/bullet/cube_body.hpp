// The cube as bodies of the scene.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <array>
#include <memory>

#include "sim/bullet/joint_drive.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/cube.hpp"

namespace mrroc::sim {

/// At any time the layers can turn about one of the three axes: a floating multibody of the middle layer, to which the
/// core belongs, and the two outer layers. When all faces are in or near their seats and something turns a layer of
/// another axis, with nearly its breakaway, the body is made anew with that axis; pose and speed stay. The 26 pieces are
/// the numbers of cube::Cube.
class CubeBody {
 public:
  /// @param scene  outlives the cube  @param T_UC  where it is at the beginning, at rest  @param h integration step [s]
  CubeBody(const CubeParameters& parameters, const Pose& T_UC, Scene& scene, double h);
  ~CubeBody();
  CubeBody(const CubeBody&) = delete;
  CubeBody& operator=(const CubeBody&) = delete;

  /// At the beginning of a step: the means over it begin at zero.
  void begin_step();
  /// Before each integration.
  void push();
  /// After each integration. @param share  of it in the step's means
  void follow(double share);
  /// At the end of a step: observes, and chooses the axis.
  void end_step();

  /// @return as end_step() has observed it last
  [[nodiscard]] const CubeTruth& truth() const { return truth_; }
  /// From now on a face has this friction.
  void set_friction(cube::Face face, const FaceFriction& friction);
  /// Makes the body anew with another axis, if no layer is more than 3 degrees off its seat: what they are off is
  /// forgotten, as a face of a real cube that turns straightens the others. @param axis 0..2 @return whether
  bool lay(int axis);

  /// Calls take(double) with every number of the mechanical state.
  template <class Take>
  void visit_state(Take take) const {
    for (const double x : truth_.T_UC.R.reshaped()) take(x);
    for (const double x : truth_.T_UC.p) take(x);
    for (const double x : truth_.angle) take(x);
  }

 private:
  void build(const Pose& T_UC, const Vector3& velocity, const Vector3& turning);
  void destroy();
  void observe();
  // Sums the moments of all contacts about the six axes, each on its own outer layer, and those of each hand.
  void add_contacts(double share);
  // Torque about an axis that goes from one hand to the other through the cube [N m]: the pads of one hand, which press
  // against each other, turn no layer by themselves.
  [[nodiscard]] double transmitted(int axis) const;
  [[nodiscard]] bool is_mine(const btCollisionObject* object) const {
    return object == colliders_[0].get() || object == colliders_[1].get() || object == colliders_[2].get();
  }
  [[nodiscard]] int wanted_axis() const;

  CubeParameters p_;
  Scene& scene_;
  double h_;
  std::array<FaceFriction, 6> frictions_;
  cube::Cube settled_;  // the stickers when the layers were chosen
  int axis_{2};
  int asked_{};                                     // steps in succession in which another axis was wanted
  std::array<std::array<double, 2>, 3> moments_{};  // means over the step, by axis and side
  struct Twisting {
    const btMultiBody* by{};
    Vector3 moment{Vector3::Zero()};  // about the middle of the cube, along C; mean over the step
  };
  std::array<Twisting, 2> hands_{};

  std::unique_ptr<btMultiBody> body_;
  std::array<std::unique_ptr<btBoxShape>, 3> boxes_;
  std::array<std::unique_ptr<btMultiBodyLinkCollider>, 3> colliders_;
  std::unique_ptr<JointDrives> drives_;
  std::array<FaceDrive, 2> faces_;
  CubeTruth truth_;
};

}  // namespace mrroc::sim
