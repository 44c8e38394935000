// The operator's language: one instruction per line, the same from a terminal and from a file.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "tasks/manual/order.hpp"

namespace mrroc::manual {

/// One arm as the operator knows it.
struct ArmInfo {
  std::string key;                             ///< arm1
  int axes{6};                                 ///< of its robot
  std::map<std::string, PoseNumbers> presets;  ///< joints [rad, track m] of named positions
  bool jaws{};                                 ///< it has a gripper
};

/// An instruction that has been understood.
struct Instructions {
  std::vector<std::size_t> arms;    ///< whom it is for, indices
  std::vector<ManualOrder> orders;  ///< one for each of them, numbers not yet given
  bool end{};                       ///< the task is to end
};

/// Understands
///     home|reset|bias|stop ARM              ARM: a key, several with commas, or all
///     move|jog ARM SPACE NUMBER... [speed SHARE] [acceleration SHARE]
///                                           SPACE: motors, joints, euler, angle-axis; jog: relative
///     preset ARM NAME [speed SHARE] [acceleration SHARE]
///     tool ARM X Y Z AX AY AZ               T_WE [m, rad]
///     weight ARM NEWTONS [X Y Z]            of everything beyond the sensor, mass centre in W [m]
///     model ARM NUMBER                      of the kinematics
///     servo ARM ALGORITHM [SET]
///     gripper ARM METRES
///     end                                   of the session; the arms come to rest
/// All numbers are SI: rad, m, N.
/// @throws FaultError bad_usage that says what is wrong and how it is written
[[nodiscard]] Instructions understand(std::string_view line, const std::vector<ArmInfo>& arms);

/// An instruction and the macrostep in which it is taken: a line `MACROSTEP WORDS...` of a script.
struct ScriptedInstruction {
  std::int64_t i{};         ///< from 1 on
  std::string instruction;  ///< as at a terminal
};
/// Instructions by their macrosteps.
using InstructionScript = std::vector<ScriptedInstruction>;

/// Reads a script; comments after '#'. Sorted by macrostep.
/// @throws FaultError bad_script that names file and line
[[nodiscard]] InstructionScript load_script(const std::filesystem::path& file,
                                            const std::vector<ArmInfo>& arms);

}  // namespace mrroc::manual
