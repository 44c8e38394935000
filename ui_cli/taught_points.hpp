// Teach-in by hand: positions that the operator has an arm note, as motions for the task `move`.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/effector_command.hpp"

namespace mrroc::ui {

/// @param word  motors, joints, frame, euler or angle-axis @return the space
/// @throws FaultError bad_usage
[[nodiscard]] Representation space_of_word(std::string_view word);

/// Appends where an arm is to a file for `./run move --file`: the first position as the joints at which the arm starts, the
/// others to the motion [ARM.taught]. The file is replaced as a whole, so that no position is lost whatever happens
/// meanwhile; values that somebody has added stay, comments do not.
/// @param r  reply of the arm's driver, which knows its position  @param axes  of the arm
/// @param space  of the positions, the same for all of one arm
/// @return number of positions of the arm in the file now
/// @throws ConfigError  the file is there, and is none of this kind; FaultError cannot_write
std::size_t teach_point(const std::filesystem::path& file, const std::string& arm, int axes,
                        Representation space, const EffectorReply& r);

}  // namespace mrroc::ui
