// What an effector driver reads from its drives and sends to them in one step. The same for a simulated arm
// and a real one.
#pragma once
#include "base/axes.hpp"
#include "base/spatial.hpp"

namespace mrroc {

/// Bits of HardwareReading::switches, one set of bits per axis.
enum class AxisSwitch : std::uint8_t { lower_limit = 1, upper_limit = 2, synchro = 4, over_current = 8 };

/// Everything measured in one step. Trivially copyable.
struct HardwareReading {
  std::int64_t step{};                           ///< number of the step, counts from 0
  std::array<std::int32_t, kMaxAxes> encoder{};  ///< [increments] since power-up, per motor
  std::array<double, kMaxAxes> current{};        ///< [A] per motor, mean over the step
  Wrench S_F_m{};  ///< raw reading of the force/torque sensor: external load on its tool
                   ///< side, in S [N, N m], mean over the step
  std::array<std::uint8_t, kMaxAxes> switches{};  ///< AxisSwitch bits per axis
};

/// Set values for the drives, valid for one step. Trivially copyable.
struct HardwareCommand {
  std::int64_t step{};  ///< step of the reading that it answers
  std::array<double, kMaxAxes>
      pwm{};       ///< duty cycle per motor in units of 1/255 of the supply, within [-255, 255]
  bool enabled{};  ///< false: the drives brake
  std::int64_t commanded_until{};  ///< first step after the last commanded macrostep
};

/// Full scale of HardwareCommand::pwm.
inline constexpr double kPwmScale = 255;

}  // namespace mrroc
