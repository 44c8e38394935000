// Images of the agent a_1 of VS 3: its control subsystem c_1 sees one effector and two virtual receptors.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "base/camera.hpp"
#include "base/effector_command.hpp"
#include "base/transmission.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/generators/virtual_effector.hpp"
#include "tasks/visual_servo/aggregation.hpp"
#include "tasks/visual_servo/object_track.hpp"
#include "tasks/visual_servo/regulator.hpp"

namespace mrroc::visual_servo {

/// The receptors r_1,1 and r_1,2.
enum class Camera : std::uint8_t {
  sac,  ///< stands alone above the scene
  eih,  ///< eye in hand
};
inline constexpr std::size_t kCameras = 2;  ///< of the agent
/// @return the camera's place in arrays over kCameras
constexpr std::size_t index(Camera k) { return static_cast<std::size_t>(k); }

/// Steps for which it is remembered where E was.
inline constexpr std::int64_t kPosesKept = 256;

/// One camera of the agent.
struct CameraParameters {
  bool used{true};           ///< false: there is none, and it never sees anything
  Pose place;                ///< sac: 0_C T; eih: E_C T
  std::int64_t period{20};   ///< steps from one picture to the next; picture n is taken at step n * period
  std::int64_t latency{20};  ///< steps until its reading is visible (rule R6)
};

/// Constants of c_1.
struct Parameters {
  std::array<CameraParameters, kCameras> camera;  ///< by index()
  Pose T_EGd;                                     ///< E_G T_d: the desired pose of the object in E
  Aggregation aggregation{Aggregation::mean};     ///< E C: what becomes of two cameras' errors
  RegulatorParameters regulator;                  ///< of R_T
  TrackParameters track;                          ///< of the object's estimated motion
  bool feed_forward{true};                        ///< follow the object's velocity
  double position_floor{3e-4};  ///< least standard deviation of what any camera says [m]: calibration
  double angle_floor{1e-3};     ///< the same [rad]
  int max_age{2};               ///< a reading of more frames ago is not believed
  bool by_wall_clock{};  ///< pictures that cannot be drawn in time are left out: that is the host's fault
  ecp::Pacing pacing{ecp::kDisplacementPacing};  ///< of the control steps, which are macrosteps
  std::int64_t duration{200};                    ///< of the task [control steps]
  std::int64_t timeout{150};  ///< control steps without seeing anything until the task is given up; 0: none
};

/// Cameras that are out of place disagree about the object. When others are used than before, the arm goes over from
/// what the former ones said to what the new ones say by little in every control step.
struct Handover {
  std::array<bool, kCameras> used{};  ///< whose errors counted in the last control step
  Pose T_0G;        ///< object at the start of its command, as believed then, when any was used
  Pose difference;  ///< believed = seen * difference; identity: nothing is left to go over
};

/// c_c: what c_1 remembers.
struct Memory {
  Parameters k;                                      ///< constant during a run
  ObjectTrack track;                                 ///< estimate after the last control step
  std::array<std::int64_t, kCameras> taken{-1, -1};  ///< frames that the track knows
  Handover handover;                                 ///< from cameras to others
  Pose e;                                            ///< error of the last control step; identity in idle
  Pose under_way;                                    ///< displacement of control step made_in + 1
  Pose before;                                       ///< displacement of the control step before that
  std::int64_t made_in{};                            ///< control step in which under_way was decided
  double ease{1};  ///< share of the regulator's speeds: less after the driver has refused a displacement
  int refused{};   ///< displacements that it has refused in a row
  std::int64_t begun{};  ///< control step in which the task began
  std::int64_t
      seen_in{};  ///< last control step in which a camera saw the object, or the first one of the task
  std::int64_t
      in_time_in{};  ///< the same for a camera whose newest picture was not too old, whatever it shows
};

/// x_r of one camera: the newest reading that is visible, joined by its step with what the effector told.
struct CameraImage {
  bool there{};           ///< false: there has been none yet
  CameraReading reading;  ///< when there
  Pose T_0E;              ///< 0_E T_c at the image's instant
};

/// x_cV of c_1.
struct Receptors {
  std::array<CameraImage, kCameras> camera;  ///< by index()
};

/// Agent a_1.
struct Arm {
  /// x: memory c, reply e of the effector, receptors V, order T of the coordinator, control step i, and i_0 in which
  /// the behaviour began.
  struct X {
    Memory c;
    EffectorReply e;  ///< its step is the instant at which x_c is looked at
    Receptors V;
    Order T;
    /// Displacements that wait because the driver has missed one: none in lock-step. What is seen now does not know of
    /// them yet, so none is added.
    int waiting{};
    /// Displacements of the present control step and of the one before, where task time has gone slowly and they were
    /// parts of what had been decided.
    std::optional<std::array<Pose, 2>> parts{};
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e to the effector, nothing for the receptors, report T.
  struct Y {
    Memory c;
    EffectorCommand e;
    ecp::None V;
    Report T;
  };
};

}  // namespace mrroc::visual_servo
