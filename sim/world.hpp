// The simulated work cell: arms with drives, wrist sensors, pens or grippers, their sheets, the operators'
// hands, a cube, and a free body. One step of the world is one step of the effector drivers. Nothing outside knows which
// engine computes it (sim/engine.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/axes.hpp"
#include "base/hardware.hpp"
#include "base/pose.hpp"
#include "robots/catalogue.hpp"
#include "sim/artefact.hpp"
#include "sim/cube.hpp"
#include "sim/elastic_gears.hpp"
#include "sim/force_sensor.hpp"
#include "sim/free_body.hpp"
#include "sim/gripper_body.hpp"
#include "sim/hand.hpp"
#include "sim/jaws.hpp"
#include "sim/link_error.hpp"
#include "sim/link_shape.hpp"
#include "sim/motor.hpp"
#include "sim/palm.hpp"
#include "sim/paper.hpp"
#include "sim/plate.hpp"
#include "sim/switches.hpp"

namespace mrroc::sim {

/// Duration of a step of the world and of an effector driver [s].
inline constexpr double kStep = 0.002;

/// Everything beyond the force sensor, as it really is.
struct ToolParameters {
  double weight{};                       ///< w [N], > 0
  Vector3 mass_centre{Vector3::Zero()};  ///< W_G P [m], in W
};

/// Binary lines of a robot controller.
struct LineParameters {
  bool loop_back{true};    ///< every output is wired to the input of the same number
  std::uint16_t inputs{};  ///< inputs that are on besides
};

/// What those believe who put an arm where it begins: its tool stands above the middle of the sheet as they see it.
struct StartBelief {
  int model{};  ///< number of the kinematic model
  Pose T_0P;    ///< of the sheet in the arm's base
};

/// One arm of the world, or a conveyor: where there is one, the sheets of all arms lie on it instead of on tables.
struct ArmParameters {
  const robots::RobotType* type{};      ///< decides kinematics, masses and gears; not null; lives on
  int model{};                          ///< number of the true kinematic model; a driver of another one errs
  Pose T_UB;                            ///< the arm's base (its frame 0) in the world U
  std::vector<MotorParameters> motors;  ///< one per axis
  ElasticityParameters elasticity;      ///< of the gears; rigid unless given
  ForceSensorParameters sensor;         ///< in the wrist
  PaperParameters paper;                ///< on its table
  PlateParameters plate;                ///< on the paper
  HandParameters hand;                  ///< of the operator who leads the arm
  std::optional<JawParameters> jaws;    ///< none: a tool without motor-driven jaws
  std::optional<GripperBodyParameters>
      gripper;                         ///< jaws and palm that touch a cube, instead of the pen; needs jaws
  std::optional<PalmParameters> palm;  ///< a palm that presses on a free body, instead of the pen
  double object{};                     ///< width of what is between the jaws after reset() [m], 0: nothing
  std::array<SwitchParameters, kMaxAxes> switches{};  ///< for homing, one per motor
  LineParameters lines;                               ///< of the robot's controller
  std::vector<double>
      start;  ///< joints after reset() [rad], track [m], one per axis; empty: those of the type
  std::optional<StartBelief> start_belief;  ///< where they are computed; none: the truth is known
  std::optional<ToolParameters> tool;       ///< the true tool; none: that of the description
  std::vector<LinkError> links;             ///< those that are otherwise than described
  double pen_radius{0.002};                 ///< of the ball that touches the paper [m]
  double start_height{0.02};                ///< of the pen above the sheet's centre after reset() [m]
};

/// @return the parameters of an arm as documented in docs/plant.md; links and tool are those of the type's description.
/// @param type  lives on
ArmParameters arm_parameters(const robots::RobotType& type);

/// Who computes how bodies move and touch.
enum class PhysicsEngine : std::uint8_t {
  bullet,
  mujoco  ///< without cube, free body, fingers and palms; not in every build (sim/engine.hpp)
};

/// The whole work cell.
struct WorldParameters {
  std::vector<ArmParameters> arms;              ///< at least one; a world without arms is refused
  std::optional<CubeParameters> cube;           ///< none: there is no cube
  std::optional<FreeBodyParameters> free_body;  ///< none: there is no free body
  std::optional<ArtefactParameters> artefact;   ///< none: there are no balls to touch
  PhysicsEngine engine{};                       ///< of all bodies
  int substeps{2};                              ///< integration steps per step, at least 1
  int solver_iterations{100};                   ///< of the contact and friction solver
};

/// The truth, for tests and figures, not for drivers.
struct ArmTruth {
  AxisVector joints;                      ///< [rad], track [m]
  Pose T_0E;                              ///< pen tip in the arm's base
  Vector3 tip_velocity{Vector3::Zero()};  ///< in the arm's base [m/s]
  Vector3 tool_turn{Vector3::Zero()};     ///< angular velocity of the tool, in the arm's base [rad/s]
  Wrench S_F{};  ///< load on the sensor before its electronics, mean over the step, in S
  Vector3 hand_force{Vector3::Zero()};  ///< of the operator on the tip, mean over the step, in the base [N]
  double paper_force{};                 ///< normal force of the pen on the paper, mean over the step [N]
  double jaws{};                        ///< distance between the jaws [m]
  double jaw_force{};                   ///< with which they hold something or press on their stops [N]
  double pen_height{};  ///< of the pen's lowest point above the paper [m], negative: pressed in
};

/// The simulation. Single-threaded and deterministic: the same parameters, seed and calls give the same bits.
/// step() does not throw; after construction it allocates only for ink and when a cube's layers are
/// chosen anew.
class World {
 public:
  /// @throws std::invalid_argument  a parameter is out of range; the text says which
  explicit World(const WorldParameters& parameters, std::uint64_t seed = 1);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Starts anew: pens above the centres of clean sheets, arms at rest with their brakes closed, encoders
  /// zero, hands idle, step 0.
  void reset(std::uint64_t seed);

  /// @return number of arms
  [[nodiscard]] int arms() const;

  /// Advances by kStep.
  /// @param commands  one per arm, in order. An arm whose command is absent (the span is shorter) or not
  ///                  enabled brakes by itself: motors short-circuited, brakes closed.
  void step(std::span<const HardwareCommand> commands);

  /// @param arm  0..arms()-1
  /// @return what the drives and the sensor of the arm measured in the last step; after reset that of the arm
  ///         at rest, step 0
  [[nodiscard]] const HardwareReading& reading(int arm) const;

  /// @return steps since reset
  [[nodiscard]] std::int64_t steps() const;

  /// @return the operator's hand at the arm
  Hand& hand(int arm);

  /// @return joints of the arm after reset() [rad], track [m]: the known pose of a synchronisation without
  ///         motion
  [[nodiscard]] const AxisVector& start_joints(int arm) const;

  /// @return the true state, for tests and figures only
  [[nodiscard]] const ArmTruth& truth(int arm) const;

  /// @return what the arm looks like at present, for pictures
  [[nodiscard]] std::vector<LinkShape> shapes(int arm) const;

  /// @return the ink on the arm's sheet, for figures and run folders
  [[nodiscard]] const std::vector<InkPoint>& ink(int arm) const;

  /// Puts something between the jaws of the arm, or takes it away. @param width [m], 0: nothing
  void set_object(int arm, double width);

  /// @return the true state of the cube; null: there is none
  [[nodiscard]] const CubeTruth* cube() const;
  /// @return the true state of the free body; null: there is none
  [[nodiscard]] const FreeBodyTruth* free_body() const;
  /// From now on a face of the cube has this friction. Without a cube nothing happens.
  void set_face_friction(cube::Face face, const FaceFriction& friction);
  /// Lays the cube's layers anew, as a turn about another axis does. @param axis 0 x, 1 y, 2 z of the cube
  /// @return whether they are in or near their seats, so that it can be done; false without a cube
  bool lay_cube(int axis);
  /// @return where E of an arm is, in the world
  [[nodiscard]] Pose effector(int arm) const;

  /// Puts a clean sheet before the arm.
  void new_sheet(int arm);

  /// @return hash over the complete mechanical state of all arms, to compare runs
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
