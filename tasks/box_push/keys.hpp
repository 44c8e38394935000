// Keys of the agents and of the box, as channels and the configuration have them.
#pragma once
#include <array>
#include <string>

#include "base/link/transmission_link.hpp"
#include "ecp/map/map_process.hpp"
#include "tasks/box_push/formation.hpp"

namespace mrroc::box_push {

inline constexpr std::array<const char*, kPlatforms> kKeys{"rex1",
                                                           "rex2"};  ///< of the platforms and their agents
inline constexpr std::array<const char*, kPlatforms> kMaps{"map1", "map2"};  ///< of their map agents
inline constexpr const char* kCoordinator = "mp";                            ///< of the coordinator
inline constexpr const char* kBox = "box";                                   ///< of the box

/// @param platform  key of one of the platforms @return channel of the coordinator's fragments for it
[[nodiscard]] inline std::string go_channel(const std::string& platform) {
  return link::link_channel(kCoordinator, platform, "go");
}
/// @param platform  key of one of the platforms @return whose map agent locates it
[[nodiscard]] inline ecp::MapAgentNames map_names(const std::string& platform) {
  return {platform == kKeys[0] ? kMaps[0] : kMaps[1], platform};
}

}  // namespace mrroc::box_push
