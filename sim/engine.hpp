// What a physics engine is to the simulated work cell: bodies of arms that move and touch, and nothing of drives, sensors
// and hands, which are the same with every engine.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "sim/chain.hpp"
#include "sim/elastic_gears.hpp"
#include "sim/tool_motion.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

inline constexpr double kGravity = 9.81;   ///< against z of the world [m/s^2]
inline constexpr double kTableEdge = 0.6;  ///< of the square tables that the sheets lie on [m]

/// What the arms of a world are built from.
struct ArmPlan {
  std::unique_ptr<edp::Robot> robot;  ///< with the true kinematic model; never null
  AxisVector told_start;              ///< joints at the beginning as everybody is told of them [rad, track m]
  AxisVector start;                   ///< the true ones
  Chain chain;                        ///< its links
};

/// Links and joints of one arm, the brakes on its motors, and what its tool touches. In every integration: push_joint and
/// push_tip, (Engine::integrate), follow.
class ArmMechanics {
 public:
  ArmMechanics() = default;
  ArmMechanics(const ArmMechanics&) = delete;
  ArmMechanics& operator=(const ArmMechanics&) = delete;
  virtual ~ArmMechanics() = default;

  /// @return of a joint [rad], track [m]
  [[nodiscard]] virtual double position(int joint) const = 0;
  /// @return of a joint [rad/s], track [m/s]
  [[nodiscard]] virtual double speed(int joint) const = 0;

  /// Holds the shafts of the motors, until their brakes slip. @param motors_per_joints  d motors / d joints, constant
  /// while the brakes are closed
  virtual void close_brakes(const AxisMatrix& motors_per_joints) = 0;
  /// From now on the shafts turn freely.
  virtual void open_brakes() = 0;

  /// Torque or force on a joint in the next integration [N m], [N].
  virtual void push_joint(int joint, double torque) = 0;
  /// Force on the tip of the tool in the next integration, in the world [N].
  virtual void push_tip(const Vector3& force) = 0;
  /// Takes over what the integration has made. @param tip_force  as push_tip() had it, or zero
  /// @return S_F: load on the tool side of the sensor, gravity and inertial forces included, in S [N, N m]
  virtual Wrench follow(const Vector3& tip_force) = 0;

  /// @return what gears feel of it at the beginning, before anything has pushed it; a wrist that gives way and jaws are
  ///         taken as rigid
  [[nodiscard]] virtual ArmAtRest at_rest() = 0;

  /// @return S_F of the tool at rest, in S [N, N m]
  [[nodiscard]] virtual Wrench weight() const = 0;
  /// @return motion after the last integration
  [[nodiscard]] virtual const ToolMotion& tool() const = 0;
  /// @return force of all contacts on the tool's own link, jaws not included, in the last integration, in the world [N]
  [[nodiscard]] virtual const Vector3& contact_force() const = 0;
  /// @return a link's mass centre in the world, axes as in the description
  [[nodiscard]] virtual Pose link(int index) const = 0;

  /// Moves the jaws of a gripper's body in the next integration. @param distance  between them [m]
  virtual void push_jaws(double /*distance*/) {}
  /// @return force with which what is between the jaws of a gripper's body pushes them open [N]
  [[nodiscard]] virtual double jaw_force() { return 0; }
  /// Calls take with every number of the mechanical state that is not one of the joints.
  virtual void visit_rest(const std::function<void(double)>& /*take*/) const {}
};

/// All bodies of a world. Single-threaded and deterministic.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// @param k  0 to the number of arms - 1 @return it lives as long as the engine
  [[nodiscard]] virtual ArmMechanics& arm(int k) = 0;

  /// At the beginning of a step: the means over it begin at zero.
  virtual void begin_step() {}
  /// One integration of kStep / substeps.
  virtual void integrate() = 0;
  /// After arms have followed an integration.
  virtual void follow() {}
  /// At the end of a step.
  virtual void end_step() {}

  /// The cube and the free body, as World has them.
  [[nodiscard]] virtual const CubeTruth* cube() const { return nullptr; }
  [[nodiscard]] virtual const FreeBodyTruth* free_body() const { return nullptr; }
  virtual void set_face_friction(cube::Face /*face*/, const FaceFriction& /*friction*/) {}
  virtual bool lay_cube(int /*axis*/) { return false; }

  /// Calls take with every number of the mechanical state of cube and free body.
  virtual void visit_state(const std::function<void(double)>& /*take*/) const {}
};

/// @param parameters  checked @param plans  of its arms, in their order; both are read only by the call
/// @return the bodies of that world in Bullet
[[nodiscard]] std::unique_ptr<Engine> bullet_engine(const WorldParameters& parameters,
                                                    const std::vector<ArmPlan>& plans);

/// @return whether this build has MuJoCo
[[nodiscard]] bool has_mujoco();

/// The same in MuJoCo, which has no cube, no free body, and no fingers or palms.
/// @throws std::invalid_argument  there is one of them, or no MuJoCo in this build
[[nodiscard]] std::unique_ptr<Engine> mujoco_engine(const WorldParameters& parameters,
                                                    const std::vector<ArmPlan>& plans);

}  // namespace mrroc::sim
