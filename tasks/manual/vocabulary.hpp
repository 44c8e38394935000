// The instructions that the task of manual operation adds to the framework's tables.
#pragma once
#include <array>
#include <string_view>

#include "base/instructions.hpp"

namespace mrroc::manual {

/// First words of instructions.
inline constexpr std::array<std::string_view, 13> kVerbNames{"home",   "move",  "jog",   "preset",  "tool",
                                                             "weight", "model", "servo", "gripper", "bias",
                                                             "reset",  "stop",  "end"};
inline const RegisteredInstructions kRegisteredInstructions{{"manual", "manual.words", kVerbNames}};

}  // namespace mrroc::manual
