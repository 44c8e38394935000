// Checks what a platform's driver is told before it is used. Pure functions, real-time safe.
#pragma once
#include <cstdint>

#include "base/platform_command.hpp"
#include "edp/guard.hpp"
#include "edp/platform/fragment_queue.hpp"
#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// How far the beginning of a fragment may be from where the way ends, +-.
struct JoinTolerance {
  double position;   ///< [m]
  double heading;    ///< [rad]
  double speed;      ///< [m/s]
  double turn_rate;  ///< [rad/s]
};
/// Of a fragment that follows another one.
inline constexpr JoinTolerance kJoin{0.02, 0.03, 0.1, 0.2};
/// Of a fragment that begins at rest: its planner knows the estimate of two macrosteps ago.
inline constexpr JoinTolerance kStart{0.10, 0.15, 0.1, 0.2};

/// Instruction of a command: platforms have SET, SYNCHRO, QUERY and reset.
[[nodiscard]] ValidationError check_instruction(const PlatformCommand& command) noexcept;

/// A fragment for itself: its steps, finite numbers, speeds of the platform at the knots and between. Axes of the fault are
/// x, y, phi, v, w = 0..4.
[[nodiscard]] ValidationError check_fragment(const Fragment& fragment,
                                             const PlatformProperties& platform) noexcept;

/// Whether a fragment goes on from what has been taken: its number, room for it, its beginning.
/// @param next  number that it must have
[[nodiscard]] ValidationError check_join(const Fragment& fragment, std::int64_t next,
                                         const FragmentQueue& queue) noexcept;

/// @param now  step of the newest reading
/// @return whether a map pose can be used: measured not later than now, finite, with a covariance
[[nodiscard]] bool is_usable(const MapPose& pose, std::int64_t now) noexcept;

/// @param now  step of the newest reading
/// @return whether a reading of odometry can be used: measured not later than now, a rotation and a way of at most 1 m, with
///         a covariance
[[nodiscard]] bool is_usable(const OdometryReading& odometry, std::int64_t now) noexcept;

/// @return whether the pace is one: 0..1
[[nodiscard]] constexpr bool is_pace(double pace) noexcept { return pace >= 0 && pace <= 1; }

}  // namespace mrroc::edp
