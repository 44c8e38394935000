// The process of a map agent.
#pragma once
#include <string>

#include "base/link/child_main.hpp"
#include "base/link/transmission_link.hpp"

namespace mrroc::ecp {

/// Whose map agent it is.
struct MapAgentNames {
  std::string agent;     ///< key of a_3: channels AGENT.order, AGENT.report, AGENT.PLATFORM.pose
  std::string platform;  ///< key of a_1: channels PLATFORM.motion_capture, PLATFORM.AGENT.estimate
};

/// @return channels of the typed links between the two agents: where the platform is, and where it believes itself to be
[[nodiscard]] inline std::string pose_channel(const MapAgentNames& names) {
  return link::link_channel(names.agent, names.platform, "pose");
}
[[nodiscard]] inline std::string estimate_channel(const MapAgentNames& names) {
  return link::link_channel(names.platform, names.agent, "estimate");
}

/// Body of the process of a_3.
void run_map(link::Process& process, const Config& config, const MapAgentNames& names);

}  // namespace mrroc::ecp
