// Teach-in: motions that arms have made, in an earlier run or in a file of one, as motions to be executed.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ecp/generators/teach_in.hpp"
#include "tasks/move/config.hpp"
#include "tasks/move/motion_file.hpp"

namespace mrroc::any_motion {

/// Recordings by ARM.NAME of the motions that repeat them.
using Recordings = std::map<std::string, ecp::TaughtPath>;

/// Gives motions with the key `recording` what that holds: space, positions, times, forces if they have `contact`; and the arm
/// its start, where it begins with such a motion and none is written.
/// @param file    not read yet
/// @param arms    with their axes
/// @param folder  relative names of recordings begin there
/// @param make_body  kinematics of an arm by the configuration of a recorded run: poses are those of E as the model has it
/// @throws ConfigError  naming file, line and key, with what cannot be read of a recording
[[nodiscard]] Recordings insert_recordings(Config& file, const std::vector<ArmKey>& arms,
                                           const std::filesystem::path& folder, const MakeBody& make_body);

}  // namespace mrroc::any_motion
