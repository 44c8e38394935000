// Who numbers the messages of a channel.
#pragma once
#include <string_view>

namespace mrroc::link {

/// @param channel  with the session's name
/// @return whether several processes talk on it: every terminal gives orders and instructions. Each numbers its own
///         messages, so numbers tell neither their order nor that one is missing
[[nodiscard]] constexpr bool has_several_senders(std::string_view channel) noexcept {
  const std::string_view name = channel.substr(channel.find('.') + 1);
  return name == "operator" || name == "manual.words";
}

}  // namespace mrroc::link
