// Kinds of effectors: what their commands, replies, readings and drives are. The links and shells of agents and drivers are
// templates over them.
#pragma once
#include <concepts>
#include <cstdint>
#include <type_traits>

#include "base/effector_command.hpp"
#include "base/hardware.hpp"
#include "base/platform_command.hpp"
#include "base/platform_hardware.hpp"

namespace mrroc {

/// A manipulator.
struct ArmEffector {
  using Command = EffectorCommand;  ///< y_ce
  using Reply = EffectorReply;      ///< x_ce
  using Reading = HardwareReading;  ///< of its sensors, in a step
  using Drive = HardwareCommand;    ///< set values for its drives, in a step

  /// Brings what is not numbered in a command up to date: an arm's commands have nothing of that kind.
  static void renew(Command& /*command*/, const Command& /*newest*/) noexcept {}
};

/// A wheeled platform.
struct PlatformEffector {
  using Command = PlatformCommand;  ///< y_ce
  using Reply = PlatformReply;      ///< x_ce
  using Reading = PlatformReading;  ///< of its sensors, in a step
  using Drive = PlatformDrive;      ///< set values for its drives, in a step

  /// Brings what is not numbered in a command up to date: pace, odometry and position.
  /// @param command  that is sent again  @param newest  what is wanted in this macrostep. Real-time safe
  static void renew(Command& command, const Command& newest) noexcept {
    command.pace = newest.pace;
    command.odometry = newest.odometry;
    command.map = newest.map;
  }
};

/// A kind of effector. Its commands have session, number, macrostep, instruction and queried, its replies session, number,
/// macrostep, step, expected, verdict, fault, state, position_known and at_rest, all as EffectorCommand and EffectorReply
/// have them; its readings and set values have the number of their step.
template <class E>
concept Effector = std::is_trivially_copyable_v<typename E::Command> &&
    std::is_trivially_copyable_v<typename E::Reply> &&
    requires(typename E::Command c, typename E::Reply r, typename E::Reading reading,
             typename E::Drive drive) {
  { c.session } -> std::same_as<std::int64_t&>;
  { c.number } -> std::same_as<std::int64_t&>;
  { c.macrostep } -> std::same_as<std::int64_t&>;
  { c.instruction } -> std::same_as<Instruction&>;
  { c.queried } -> std::same_as<std::int64_t&>;
  { r.session } -> std::same_as<std::int64_t&>;
  { r.number } -> std::same_as<std::int64_t&>;
  { r.macrostep } -> std::same_as<std::int64_t&>;
  { r.step } -> std::same_as<std::int64_t&>;
  { r.expected } -> std::same_as<std::int64_t&>;
  { r.verdict } -> std::same_as<Verdict&>;
  { r.fault } -> std::same_as<Fault&>;
  { r.state } -> std::same_as<DriverState&>;
  { r.position_known } -> std::same_as<bool&>;
  { r.at_rest } -> std::same_as<bool&>;
  { reading.step } -> std::same_as<std::int64_t&>;
  { drive.step } -> std::same_as<std::int64_t&>;
  { drive.macrostep } -> std::same_as<std::int64_t&>;
  E::renew(c, c);
};

static_assert(Effector<ArmEffector> && Effector<PlatformEffector>);

}  // namespace mrroc
