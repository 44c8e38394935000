// What the task of manual operation and the operator's terminals say to each other.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace mrroc {

/// What an instruction begins with.
inline constexpr std::array<std::string_view, 13> kManualVerbs{"home",   "move",  "jog",   "preset",  "tool",
                                                               "weight", "model", "servo", "gripper", "bias",
                                                               "reset",  "stop",  "end"};

/// What became of an instruction; the numbers of manual_answer_t::state.
enum class ManualState : std::uint8_t {
  refused,  ///< nothing is done
  taken,    ///< it is being done
  done,
  failed,          ///< or called off
  not_understood,  ///< nothing is done: the words are no instruction, or not for these arms
};

}  // namespace mrroc
