// A plan for two arms that turn faces of a cube one after the other: grips, turns, re-grasps and paths
// between them.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/axes.hpp"
#include "base/cube/grasp.hpp"
#include "base/cube/move.hpp"
#include "ecp/generators/space.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Joints of both arms, by index(Hand) [rad, track m].
using ArmJoints = std::array<AxisVector, 2>;

/// Limits of the free motions of one arm.
struct SpeedLimits {
  ecp::MotionLimits motors;  ///< [rad/s], [rad/s^2]
  double linear{};           ///< of E [m/s]
  double angular{};          ///< of E [rad/s]
};

/// A point of a path, and the line that leads there.
struct Waypoint {
  AxisVector joints;  ///< [rad], track [m]
  AxisVector motors;  ///< the same posture [rad]
  double speed{1};    ///< on the line, as a share of what the motors can: above 0 up to 1
};

/// Distance of the palm from the cube where a guarded approach begins [m].
inline constexpr double kApproachDistance = 0.01;
/// Distance by which a hand draws back straight along its z after it has opened [m].
inline constexpr double kRetreatDistance = 0.1;
/// Distance between the jaws of an empty hand while it moves, at most [m].
inline constexpr double kOpenJaws = 0.08;

/// Estimates of what is not free motion, from tables 4-8 of MG and the friction of a face.
struct CycleTimes {
  double grip{3.1};       ///< m = 1..4, the rest in which sensors are biased, and what is told of paths [s]
  double turn_rate{0.3};  ///< of m = 5 with B = 0.1 s/(kg m^2) [rad/s]
  double open{1.2};       ///< m = 6 [s]
  double look{0.5};       ///< of the camera at a face, at rest [s]
};

/// A free motion of one arm: lines from point to point that are straight in the space of the
/// motors, whose speeds bound it (ecp::Polyline). At rest at the first and the last point. Every line has been found
/// free of collisions.
struct FreeMotion {
  /// The hand that moves.
  Hand hand{};
  /// At least two; the first is where the arm stands according to the plan: force control will have moved it a little.
  std::vector<Waypoint> points;
  bool carries{};    ///< the hand holds the cube
  double seconds{};  ///< estimate
  /// It begins while the motion before it still goes on, so long after that one has begun [s], and ends behind it; then
  /// no state of both arms collides, even if one of them is kLag ahead. Nothing: it begins when that one has ended.
  std::optional<double> delay{};
};

/// Time by which arms that move together may be ahead of each other [s].
inline constexpr double kLag = 0.2;

/// One cycle: an arm comes and grips, a face may be turned, an arm lets go. Or, with `shows`, a look at a face: only
/// the motions, then the camera.
struct Step {
  /// One after the other, but for a delay; the last one of `comes` ends kApproachDistance before contact. A holder that
  /// stays has a motion of no length: to where it should be.
  std::vector<FreeMotion> before;

  std::optional<Face>
      shows;  ///< the holder stands so that the camera sees this face; nothing below happens then

  Matrix3 R_GC{
      Matrix3::Identity()};  ///< `shows`: how the core stands in the frame G of the shown face (Viewing)

  Hand comes{};              ///< worker of m = 1..4: approaches along its z and grips; the other arm holds
  std::optional<Move> turn;  ///< m = 5: the track arm turns about its z, whichever arm came
  double angle{};      ///< signed, of that turn about z of the track arm's E [rad]: +-1, 2 or 3 times pi/2
  Hand leaves{};       ///< m = 6: opens; the other arm has the cube then
  FreeMotion retreat;  ///< of `leaves`, straight along its z
  FreeMotion
      withdrawal;  ///< the same of `comes` before the turn, for a face that jams; without points: not free
  ArmJoints withdrawn;  ///< nominal joints when that has been done: `before_grasp` holds

  Grasp before_grasp;  ///< of the arm that holds at the beginning
  Grasp grasp;         ///< of `comes`, when it has gripped, before the turn
  Grasp after_grasp;   ///< of the arm that holds at the end
  ArmJoints contact;   ///< nominal joints of both arms when both hold; `shows`: when the camera looks
  ArmJoints after;     ///< nominal joints at the end, when `leaves` has drawn back
  double seconds{};    ///< estimate for all of it

  /// @return the cube changes hands and no face is turned
  [[nodiscard]] bool regrasp() const { return !turn && !shows; }
};

/// Steps and what they cost.
struct Plan {
  std::vector<Step> steps;             ///< in the order of execution
  Grasp start, end;                    ///< of the cube before the first step, and after the last one
  ArmJoints start_joints, end_joints;  ///< nominal joints of both arms then [rad, track m]
  Moves turns;                         ///< in the order of execution
  int regrasps{};                      ///< steps without turn
  int grips{};                         ///< steps in which an arm comes and grips
  double seconds{};                    ///< estimate for all steps
};

/// Why there is no plan.
enum class NoPlan : std::uint8_t {
  none,         ///< there is one
  bad_start,    ///< the start is no grip, or the joints are not those of the arms, or beyond their limits
  collision,    ///< the arms touch something at the start
  unreachable,  ///< no sequence of grips that both arms reach within their limits
  blocked       ///< there are such sequences, but every one has a path on which something collides
};
/// @return name of the reason, e.g. "unreachable"
[[nodiscard]] const char* to_string(NoPlan why);

/// A plan, or a reason.
struct Planned {
  std::optional<Plan> plan;  ///< nothing: there is none
  NoPlan why{NoPlan::none};  ///< none: there is a plan
  std::string text;          ///< for people: what exactly; empty when there is a plan
};

}  // namespace mrroc::rubik
