// What the task of manual operation and the operator's terminals say to each other.
#pragma once
#include <cstdint>

namespace mrroc {

/// What became of an instruction; the numbers of manual_answer_t::state.
enum class ManualState : std::uint8_t {
  refused,  ///< nothing is done
  taken,    ///< it is being done
  done,
  failed,          ///< or called off
  not_understood,  ///< nothing is done: the words are no instruction, or not for these arms
};

}  // namespace mrroc
