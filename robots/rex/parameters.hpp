// What is known of Rex. The numbers of the real platform are not published: these are estimates of the size of such a
// platform, and the only place where they stand.
#pragma once
#include "base/platform_hardware.hpp"

namespace mrroc::rex {

inline constexpr double kGravity = 9.81;  ///< [m/s^2]

/// The platform as it was built: empty, its mass centre in the middle between the wheels.
inline constexpr double kMass = 40;              ///< with the wheels [kg]
inline constexpr double kInertia = 2.5;          ///< about z through the mass centre [kg m^2]
inline constexpr double kWheelRadius = 0.15;     ///< [m]
inline constexpr double kHalfBase = 0.25;        ///< from B to the axles, along x [m]
inline constexpr double kHalfTrack = 0.30;       ///< from B to the wheels' middle planes, along y [m]
inline constexpr double kWheelInertia = 0.10;    ///< of a wheel with its rotor, about the axle [kg m^2]
inline constexpr double kBearingFriction = 0.5;  ///< of a wheel [N m s]

/// Slip speed at which a wheel's friction reaches 1 / sqrt(2) of its largest one, in the kernels' model [m/s]: what is sharper
/// than the model makes the stages of a multiple shooting method stiff, what is softer tells too little of the ground.
inline constexpr double kSlipSpeed = 0.04;

/// Drives.
inline constexpr double kMaxTorque = 20;  ///< at the wheel [N m]
inline constexpr double kFullTorqueSpeed =
    14;  ///< to this speed of the wheel a drive has its full torque [rad/s]
inline constexpr double kMaxWheelSpeed = 18;  ///< at this one it has none any more [rad/s]
/// Short-circuited, a motor holds against its speed with this [N m s/rad]: from 0.8 m/s the platform stops in 0.15 m.
inline constexpr double kBrake = 1.5;
/// A drive that brakes does it with that much: 3.7 m/s^2 and more, wheels that are not locked on the usual ground [N m].
inline constexpr double kBrakingTorque = 8;
inline constexpr double kTorqueConstant = 2;        ///< of a motor behind its gear [N m/A]
inline constexpr double kIncrementsPerTurn = 4000;  ///< of the encoder, per turn of the wheel

/// Outline, wheels included, with B in its middle: what walls touch.
inline constexpr double kLength = 0.80;  ///< [m]
inline constexpr double kWidth = 0.66;   ///< [m]

/// What a fragment may ask for.
inline constexpr double kMaxSpeed = 1.5;                ///< [m/s]
inline constexpr double kMaxTurnRate = 2.2;             ///< [rad/s]
inline constexpr double kMaxLateralAcceleration = 2.0;  ///< [m/s^2]

/// Where the wheels stand on the ground in B [m]: FL, FR, RL, RR.
inline constexpr PerWheel kWheelX{kHalfBase, kHalfBase, -kHalfBase, -kHalfBase};
inline constexpr PerWheel kWheelY{kHalfTrack, -kHalfTrack, kHalfTrack, -kHalfTrack};

}  // namespace mrroc::rex
