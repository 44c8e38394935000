// The rows of the tracks that a page receives.
#pragma once
#include <algorithm>
#include <array>
#include <string_view>

namespace mrroc::view {

/// @return the number as a row has it: one that is larger than anything that can be drawn becomes the largest that can
[[nodiscard]] inline float drawn(double x) {
  constexpr double kLargest = 1e12;
  return static_cast<float>(std::clamp(x, -kLargest, kLargest));
}

/// An arm's row, one per reply of its driver. t: simulated time [s]; m: behaviour of its agent; q0..q7: joints [rad],
/// track [m]; x..az: E in the base [m], angle-axis [rad]; Fx..Nz: F_a in E [N], [N m]; gap: between the jaws [m];
/// ink: 1 the pen is on the paper, 0 it is not, -1 the sheet was changed.
inline constexpr std::array<std::string_view, 24> kArmColumns{
    "t", "m",  "q0", "q1", "q2", "q3", "q4", "q5", "q6", "q7", "x",   "y",
    "z", "ax", "ay", "az", "Fx", "Fy", "Fz", "Nx", "Ny", "Nz", "gap", "ink"};

/// The row of the track "object": t [s]; 1 where it is present; 1 where something is held over it; the rows of
/// [R P] of T_0G [m].
inline constexpr std::size_t kObjectColumns = 15;

/// Name of the object's track.
inline constexpr std::string_view kObjectTrack = "object";

/// The row of the track "cube", one per macrostep of the simulator: t [s]; the axis about which layers can
/// turn, 0 x, 1 y, 2 z of C; the angles of the layers in positive and negative direction of it,
/// counterclockwise seen from outside [rad]; the rows of [R P] of T_UC [m]; the stickers of the faces U R F D
/// L B as six numbers, each of nine digits to the base 6, the first sticker foremost, a digit for the face on
/// whose centre the colour is.
inline constexpr std::size_t kCubeColumns = 22;

/// Name of the cube's track.
inline constexpr std::string_view kCubeTrack = "cube";

/// The row of the track "body", one per macrostep of the simulator, of a free body: t [s]; the rows of [R P] of T_UO [m].
inline constexpr std::size_t kBodyColumns = 13;

/// Name of the free body's track.
inline constexpr std::string_view kBodyTrack = "body";

// Of a platform there are five tracks: "platform:NAME", "telemetry:NAME", "truth:NAME", "plan:NAME" and "fragment:NAME".

/// A platform's row, one per reply of its driver. t: of the newest reading in the estimate [s]; m: behaviour of its
/// agent; sent: of the reading with which the reply was made, which its telemetry tells too [s]; x..w: where it is
/// estimated on the map and how fast, along B [m], [rad], [m/s], [rad/s]; th0..th3: turned by its wheels [rad]; xx xy
/// yy: covariance of x and y [m^2]; mu_x..sd_split: slip with standard deviations; tau0..tau3: torques of its wheels
/// [N m]; fragment, iteration, remaining: what it drives, 0 for none.
inline constexpr std::array<std::string_view, 29> kPlatformColumns{
    "t",       "m",        "sent", "x",    "y",    "phi",  "vx",       "vy",        "w",        "th0",
    "th1",     "th2",      "th3",  "xx",   "xy",   "yy",   "mu_x",     "mu_y",      "split",    "sd_mu_x",
    "sd_mu_y", "sd_split", "tau0", "tau1", "tau2", "tau3", "fragment", "iteration", "remaining"};

/// The row of "telemetry:NAME": t of the reading [s]; x y phi of 21 points of the reference from now on [m], [rad]; as
/// many where the tracker expects the platform.
inline constexpr std::size_t kTelemetryColumns = 127;

/// The row of "truth:NAME", one per macrostep of the simulator: t [s]; x y phi of B on the map [m], [rad]; what its
/// wheels stand on, as slip coefficients: mu_x mu_y split.
inline constexpr std::size_t kTruthColumns = 7;

/// The row of "plan:NAME", one per point of a plan when it comes: t [s]; number of the plan; x y [m].
inline constexpr std::size_t kPlanColumns = 4;

/// The row of "box:NAME", one per macrostep of the simulator, of a box that platforms push: t [s]; x y phi of its middle on the
/// map [m], [rad].
inline constexpr std::size_t kBoxColumns = 4;

/// The row of "agent:NAME", one per macrostep of an agent without an effector, or of the coordinator, "agent:mp": t [s]; m:
/// its behaviour.
inline constexpr std::size_t kAgentColumns = 2;

/// The row of "fragment:NAME", one per fragment when it is handed over: t [s]; number; steps and notify [iterations]; x y phi
/// of its 33 knots [m], [rad].
inline constexpr std::size_t kFragmentColumns = 103;

}  // namespace mrroc::view
