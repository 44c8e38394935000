// The coordinator a_0 of the cube's task: its images and behaviours. It moves the arms between cycles, leads
// them through the behaviours of a cycle by (60)-(63), and checks that each one comes to its end.
#pragma once
#include <array>
#include <cstdint>

#include "base/agent_images.hpp"
#include "base/cube/cube_face.hpp"
#include "base/cube/grasp.hpp"
#include "base/operator.hpp"
#include "base/task_clock.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/turn/arm.hpp"
#include "tasks/rubik/turn/coordination.hpp"

namespace mrroc::rubik {

inline constexpr std::size_t kArms = 2;  ///< arms of the cell, by index(Hand)

/// Simulated time that thinking takes [macrosteps].
inline constexpr int kThinking = 100;

/// Load on a force sensor.
struct Load {
  double weight{};                       ///< w [N]
  Vector3 mass_centre{Vector3::Zero()};  ///< W_G P [m]
};

/// Parameters of the task, constant during a run.
struct Parameters {
  double torque{4.0};         ///< F_d about the face's axis [N m], of a face that turns
  double most_torque{4.0};    ///< to which it grows while a face stands, not below `torque` [N m]
  double mobility{0.1};       ///< B about it [s/(kg m^2)]
  int attempts{3};            ///< at a turn or at a grip, until it is a fault
  int timeout{400};           ///< macrosteps until a behaviour that has not ended has failed
  int stall{125};             ///< the same of m = 5 without progress
  double progress{0.015};     ///< angle that is progress of a turn [rad]
  double held{0.0555};        ///< jaws nearer to each other than that hold nothing [m]
  double slip{0.005};         ///< by which the cube may be off where the worker meets it [m]
  double open{0.063};         ///< distance of the jaws of an empty hand [m]
  double jaw_step{0.001};     ///< dg of jaws that close and touch nothing yet, per macrostep [m]
  double grip_step{0.0003};   ///< dg of jaws that close on the cube, m = 4, per macrostep [m]
  double opening_step{0.01};  ///< dg of jaws that open, per macrostep [m]
  std::array<std::array<Load, 2>, kArms> load;  ///< of each arm, empty and with the cube
};

/// Failure of a behaviour of a cycle.
enum class FailureReason : std::uint8_t {
  none,
  no_contact,    ///< m = 1: the worker does not meet the cube, in time or where it should be
  elsewhere,     ///< m = 1: it meets it where it should not be, or passes by one that is there
  missed,        ///< m = 3, 4: its jaws close on nothing
  jammed,        ///< m = 5: the face does not turn
  not_released,  ///< m = 6: the jaws do not open
  dropped        ///< the hand that holds the cube has nothing in its jaws any more
};

/// Roles of the arms in a cycle.
struct Cycle {
  Hand holds{Hand::track};      ///< at the beginning
  Hand comes{Hand::postument};  ///< W: m = 1..4
  Hand leaves{Hand::track};     ///< m = 6
  TurnOrder turn;               ///< m = 5, of the track arm
};

/// x_cV0: the camera's newest reading that is visible.
struct SeenFace {
  bool there{};             ///< false: there has been none yet
  CubeFaceReading reading;  ///< when there
};

/// c_c0
struct CoordinatorMemory {
  Parameters k;               ///< constant during a run
  Coordination coordination;  ///< of the present cycle
  Cycle cycle;                ///< who does what in the present one
  std::array<JointPath, kArms>
      joint_paths;                   ///< of the next free motions; an arm with an empty one is told nothing
  std::array<int, kArms> next{};     ///< point to be sent
  std::array<int, kArms> goes_at{};  ///< along its path: macrostep of the behaviour; negative: it stays
  bool jaws_too{};                   ///< it has arrived when also its jaws have
  std::array<bool, kArms> loaded{};  ///< the cube is in the hand that is weighed
  FailureReason failure{};           ///< of the present cycle
  CubeFaceSetting shown;             ///< which face the camera is to see next, and in which light
  Pose begun;                        ///< E of the arm that acts, at the begin of the behaviour
  double angle{};                    ///< m = 5: turned so far [rad]
  double last_angle{};               ///< at the last progress [rad]
  std::int64_t last_progress{};      ///< macrostep of it
  double travelled{};                ///< m = 1: by the worker until contact [m]
};

/// a_0: has no effector; y_cV0 is what the camera's receptor is to look at.
struct Coordinator
    : CoordinatorAgent<CoordinatorMemory, kArms, SeenFace, CubeFaceSetting, ArmReport, ArmOrder> {};

/// m = 1..6, index m - 1: both arms are in that behaviour. Ends with its event, or with c.failure.
extern const std::array<Motion<Coordinator>, 6> kCycle;

extern const Motion<Coordinator>
    kWaitForStart;                           ///< until both agents are ready and the operator has given start
extern const Motion<Coordinator> kSendPath;  ///< the arms are told c.joint_paths
extern const Motion<Coordinator>
    kMoveAlong;  ///< arms go along them, by c.goes_at; c.failure watches the cube
extern const Motion<Coordinator> kWeighBoth;  ///< both arms at rest, without contact; c.loaded
extern const Motion<Coordinator> kStopBoth;   ///< a cycle is broken off; both come to rest
extern const Motion<Coordinator> kThink;      ///< the arms wait for kThinking macrosteps
extern const Motion<Coordinator> kLook;       ///< at rest until there is a picture of that
extern const Motion<Coordinator> kResume;     ///< nothing happens while the operator has a pause

/// @return name of the failure for people
[[nodiscard]] const char* to_string(FailureReason failure);

}  // namespace mrroc::rubik
