// Everything that is a number about the conveyor: one axis, a belt along y of the world.
//
// Source of gear, regulator, place and height: the original framework. docs/plant.md tells what is estimated.
#pragma once
#include <numbers>

#include "base/spatial.hpp"
#include "edp/robot.hpp"
#include "robots/motor.hpp"

namespace mrroc::conveyor {

/// Turn of the motor per way of the belt [rad/m].
inline constexpr double kGear = 2250;
/// The belt runs so far to both sides of where it begins [m]: so both sheets stay on it.
inline constexpr double kWay = 1;
/// Where the motor reads 0: the belt's mark passes the synchronisation switch a little before it [m].
inline constexpr double kZero = -0.05;
/// Height of the belt's top above the floor [m].
inline constexpr double kTop = 0.9064;
/// The belt's width along x and length along y [m]. It is endless: at no place of the belt does its end come near.
inline constexpr double kWidth = 0.46;
inline constexpr double kLength = 4.59 + 2 * kWay;
/// Middle of the belt's top along x and y, in the base [m].
inline const Vector3 kMiddle{0.23, 0.695, kTop};
/// E with the belt where it begins: the middle of the first sheet, upright as the tool of an arm that writes there [m].
inline const Vector3 kSheet{0.31, -0.45, kTop};
/// The base in the world [m].
inline const Vector3 kPlace{0.59, 0.45, 0};

/// The true motor. Its resistance is the one at which speed follows voltage with 0.028 s, the time constant that
/// the regulator cancels.
inline constexpr robots::MotorParameters kMotor{.resistance = 2.0,
                                                .rotor_inertia = 1.5e-4,
                                                .friction = 0.015,
                                                .brake_torque = 0.6,
                                                .current_limit = 16.2};

/// The axis, with regulators and what they know of the drive.
inline constexpr edp::AxisProperties kAxis = [] {
  constexpr edp::RegulatorCoefficients kOriginal{
      .epsilon = 0.008, .a = 0.548946716233, .b0 = 0.9457596, .b1 = 0.8811594};
  edp::RegulatorCoefficients proportional = kOriginal;
  proportional.epsilon = 0;
  return edp::AxisProperties{
      .name = "belt",
      .joint = {-kWay, kWay},
      .motor = {kGear * (-kWay - kZero), kGear * (kWay - kZero)},
      .increments_per_rad = 4000 / (2 * std::numbers::pi),
      .max_motor_speed = 250,
      .servo = {.standard = {1, 0},
                .incremental = {kOriginal, proportional},
                .compensating = {{{.bandwidth = 100, .observer = 150}, {.bandwidth = 60, .observer = 120}}},
                .drive = {.resistance = kMotor.resistance,
                          .inertia = 1.55e-4,
                          .friction = 0.025,
                          .current_limit = kMotor.current_limit,
                          .max_current = 18}}};
}();

}  // namespace mrroc::conveyor
