// Tables 4-8 of MG and the behaviours m = 1..6 of both arms, by role: the worker W comes to the cube and grips a face,
// the holder H turns it and lets go.
#pragma once
#include <array>

#include "base/axis_command.hpp"
#include "base/motion.hpp"
#include "tasks/rubik/turn/arm.hpp"

namespace mrroc::rubik {

// clang-format off
/// tab. 4(a): guarded motion toward the cube; the force settles at v/B = 4 N
inline constexpr TaskFrameCommand kApproach{.x = u(), .y = u(), .z = g(0.01, 5, 0.0025), .ax = u(), .ay = u(), .az = u()};
/// tab. 5(b): compliant along y while the jaws close
inline constexpr TaskFrameCommand kCloseY{.x = u(), .y = c(0, 20, 0.005), .z = u(), .ax = u(), .ay = u(), .az = u()};
/// tab. 6(b): compliant in the plane of the face
inline constexpr TaskFrameCommand kCloseXY{.x = c(0, 20, 0.005), .y = c(0, 20, 0.005), .z = u(), .ax = u(), .ay = u(), .az = u()};
/// tab. 7(a): no force along any axis, 5 N m about z
inline constexpr TaskFrameCommand kTurn{.x = c(0, 20, 0.005), .y = c(0, 20, 0.005), .z = c(0, 20, 0.005),
                                        .ax = u(), .ay = u(), .az = c(5, 0.5, 0.025)};
/// still
inline constexpr TaskFrameCommand kStill{.x = u(), .y = u(), .z = u(), .ax = u(), .ay = u(), .az = u()};
// clang-format on

inline constexpr double kApproachForce = 0.9 * 0.01 / 0.0025;  ///< threshold of (66) [N]
inline constexpr std::int64_t kSettling = 25;                  ///< i_d of (69) [macrosteps]
inline constexpr double kNarrow = 0.06;     ///< distance of the jaws that ends m = 3, (71) [m]
inline constexpr double kRelease = 0.02;    ///< opening that ends m = 6, (77) [m]
inline constexpr double kJawStep = 0.001;   ///< dg(m), per macrostep [m]
inline constexpr double kResists = 0.75;    ///< share of F_d about z at which the face is about to stand
inline constexpr double kOfStanding = 0.4;  ///< of the ordered mobility, for a face that stands
inline constexpr double kQuicken = 1.1;  ///< by which the mobility about z grows per macrostep while it turns
/// Distances that are commanded at most: the jaws' own limits are a little farther [m].
inline constexpr double kClosest = 0.054;
inline constexpr double kWidest = 0.089;

/// f_ce of a row: the table's frame, and g_d = measured distance + dg (59). @param dg [m]
EffectorCommand command(const Arm::X& x, const TaskFrameCommand& frame, double dg);

// Predicates, (66)-(77). Each is a function of x_c alone.
bool pushing(const Arm::X& x);   ///< (66) W presses against the cube
bool settled(const Arm::X& x);   ///< (69) i_d macrosteps have passed since entry
bool narrow(const Arm::X& x);    ///< (71) the jaws are about to touch
bool gripped(const Arm::X& x);   ///< (72) the jaws are blocked
bool turned(const Arm::X& x);    ///< (75) the unwrapped angle about z since entry has reached the order's
bool released(const Arm::X& x);  ///< (77) the jaws have opened by kRelease since entry
bool nothing(const Arm::X& x);   ///< the other arm looks for the event

ArmMemory keep_gap(const Arm::X& x);     ///< (76), on entry
ArmMemory keep_pose(const Arm::X& x);    ///< (74), on entry
ArmMemory begin_turn(const Arm::X& x);   ///< the same, and what is ordered
ArmMemory track_angle(const Arm::X& x);  ///< follows the angle over whole turns
/// The same, with the torque that is ordered now, and the mobility about z: kOfStanding of the order's, at least that of tab. 7, from entry on and while the
/// face resists with more than kResists of the torque, so that a face that does not turn is felt without an overshoot;
/// else it grows to the order's.
ArmMemory track_turn(const Arm::X& x);
/// @param last  of the same angle a moment ago [rad]
/// @return signed angle about z from one pose to the other, unwrapped [rad] (75)
double angle_about_z(const Pose& from, const Pose& to, double last);

/// m = 1..6, index m - 1. An arm ends behaviour m when it is told to by element 1 (odd m) or 2 (even m) of what the
/// coordinator sends, (60).
extern const std::array<Motion<Arm>, 6> kWorker;
extern const std::array<Motion<Arm>, 6> kHolder;

}  // namespace mrroc::rubik
