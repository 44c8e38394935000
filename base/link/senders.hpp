// Tells whether a channel has one sender or several, each of which numbers its own messages.
#pragma once
#include <algorithm>
#include <string_view>

#include "base/instructions.hpp"

namespace mrroc::link {

/// @param channel  with the session's name
/// @return whether several processes talk on it: every terminal gives orders and instructions. Each numbers its own
///         messages, so numbers tell neither their order nor that one is missing
[[nodiscard]] inline bool has_several_senders(std::string_view channel) noexcept {
  const std::string_view name = channel.substr(channel.find('.') + 1);
  return name == "operator" || std::ranges::count(instruction_sets(), name, &InstructionSet::channel) > 0;
}

}  // namespace mrroc::link
