// The readings that an effector driver gets from its drives and the commands that it sends to them in one
// step. The same for a simulated arm and a real one.
#pragma once
#include "base/axes.hpp"
#include "base/spatial.hpp"

namespace mrroc {

/// Analog input lines of a robot controller.
inline constexpr std::size_t kAnalogInputs = 8;

/// Bits of HardwareReading::switches, one set of bits per motor.
enum class AxisSwitch : std::uint8_t {
  lower_limit = 1,
  upper_limit = 2,
  synchro = 4,          ///< pressed on the whole lower side of the synchronisation position
  over_current = 8,     ///< the drive has switched itself off: its current was more than it bears
  index = 16,           ///< the zero mark of the encoder, once per turn, passed in this step
  current_limited = 32  ///< the drive has limited its current in this step: the torque is less than asked for
};

/// Everything measured in one step. Trivially copyable. A robot of n axes with a motor-driven gripper has the
/// motor of the jaws behind those of the axes, at index n.
struct HardwareReading {
  std::int64_t step{};                           ///< number of the step, counts from 0
  std::array<std::int32_t, kMaxAxes> encoder{};  ///< [increments] since power-up, per motor
  std::array<double, kMaxAxes> current{};        ///< [A] per motor, mean over the step
  Wrench S_F_m{};  ///< raw reading of the force/torque sensor: external load on its tool
                   ///< side, in S [N, N m], mean over the step; six NaN when it gave none
  std::array<std::uint8_t, kMaxAxes> switches{};  ///< AxisSwitch bits per motor
  std::array<std::int32_t, kMaxAxes> index{};     ///< encoder at the last zero mark [increments], latched by
                                                  ///< the drive; means something once AxisSwitch::index came
  std::uint16_t inputs{};                         ///< binary input lines of the robot controller
  std::array<double, kAnalogInputs> analog{};     ///< analog input lines [V]
};

/// Set values for the drives, valid for one step. Trivially copyable.
struct HardwareCommand {
  std::int64_t step{};  ///< step of the reading that it answers
  std::array<double, kMaxAxes>
      pwm{};                 ///< duty cycle per motor in units of 1/255 of the supply, within [-255, 255]
  bool enabled{};            ///< false: the drives of the axes brake
  bool jaws_enabled{};       ///< false: the drive of the jaws brakes; a grip outlasts the rest of the arm
  std::int64_t macrostep{};  ///< of the driver's next step; a plant that keeps time for a task counts by it
  std::uint16_t outputs{};   ///< binary output lines of the robot controller; kept until changed
};

/// Full scale of HardwareCommand::pwm.
inline constexpr double kPwmScale = 255;

}  // namespace mrroc
