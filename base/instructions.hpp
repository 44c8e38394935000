// Instructions in words that a task accepts from a terminal, beside the orders that all tasks know.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace mrroc {

/// State of an instruction; the numbers of manual_answer_t::state.
enum class InstructionState : std::uint8_t {
  refused,  ///< nothing is done
  taken,    ///< it is being done
  done,
  failed,          ///< or called off
  not_understood,  ///< nothing is done: the words are no instruction, or not for these arms
};

/// The instructions of one task.
struct InstructionSet {
  std::string_view task;                    ///< its name
  std::string_view channel;                 ///< on which every terminal may give them, without the session
  std::span<const std::string_view> verbs;  ///< what an instruction begins with
};

/// Makes the instructions of a task known: a constant in the header vocabulary.hpp of its folder, so that the task and
/// ui_cli have them before main() begins.
class RegisteredInstructions {
 public:
  /// @param set  whose texts live as long as the program. Ends the program when there are too many sets
  explicit RegisteredInstructions(const InstructionSet& set) noexcept;
};

/// @return all that have been registered
[[nodiscard]] std::span<const InstructionSet> instruction_sets() noexcept;
/// @return the verbs of a task; empty when it has none, or none that this program knows
[[nodiscard]] std::span<const std::string_view> instruction_verbs(std::string_view task) noexcept;

}  // namespace mrroc
