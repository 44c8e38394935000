// Has the kernel drop a multicast group's packets that a socket does not want, before they take room.
#pragma once
#include <linux/filter.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrroc::link {

/// @param largest   datagram that passes [bytes]
/// @param channels  that pass, whole names; none, or more than a filter can compare: all
/// @return a filter for sockets (SO_ATTACH_FILTER) that lets short packets of LCM pass. A datagram that ends inside the name
///         that is compared may pass or not; it is no message, as every message has a tag behind its name
std::vector<sock_filter> packet_filter(std::size_t largest, const std::vector<std::string>& channels);

}  // namespace mrroc::link
