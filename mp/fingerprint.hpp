// The fingerprint of a run, computed from all control messages that its nodes have sent.
#pragma once
#include <cstdint>
#include <string>

#include "mp/supervised_node.hpp"

namespace mrroc::mp {

/// @return log_hash, made of the channels' fingerprints in the order of their names; 0: not every node has told its own
[[nodiscard]] std::uint64_t fingerprint_of(const SupervisedNodes& nodes);

/// @return a node that has not told what it has sent, by name; empty: all have
[[nodiscard]] std::string without_fingerprint(const SupervisedNodes& nodes);

}  // namespace mrroc::mp
