// Keys of the agents, as channels and the configuration have them.
#pragma once
#include <string>

#include "base/link/transmission_link.hpp"
#include "ecp/map/map_process.hpp"

namespace mrroc::rex_drive {

inline constexpr const char* kPlatform = "rex";    ///< of a_1
inline constexpr const char* kMap = "map";         ///< of a_3
inline constexpr const char* kCoordinator = "mp";  ///< of a_2

/// @return channel of the typed link from a_2 to a_1
[[nodiscard]] inline std::string plan_channel() {
  return link::link_channel(kCoordinator, kPlatform, "plan");
}
/// @return whose map agent a_3 is
[[nodiscard]] inline ecp::MapAgentNames map_names() { return {kMap, kPlatform}; }
/// @return channels of the typed links between a_1 and a_3
[[nodiscard]] inline std::string pose_channel() { return ecp::pose_channel(map_names()); }
[[nodiscard]] inline std::string estimate_channel() { return ecp::estimate_channel(map_names()); }

}  // namespace mrroc::rex_drive
