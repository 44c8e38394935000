// Keys of the agents, as channels and the configuration have them.
#pragma once
#include <string>

#include "base/link/transmission_link.hpp"

namespace mrroc::rex_drive {

inline constexpr const char* kPlatform = "rex";    ///< of a_1
inline constexpr const char* kMap = "map";         ///< of a_3
inline constexpr const char* kCoordinator = "mp";  ///< of a_2

/// @return channels of the typed links between the agents
[[nodiscard]] inline std::string plan_channel() {
  return link::link_channel(kCoordinator, kPlatform, "plan");
}
[[nodiscard]] inline std::string pose_channel() { return link::link_channel(kMap, kPlatform, "pose"); }
[[nodiscard]] inline std::string estimate_channel() {
  return link::link_channel(kPlatform, kMap, "estimate");
}

}  // namespace mrroc::rex_drive
