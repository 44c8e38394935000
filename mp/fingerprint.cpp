#include "mp/fingerprint.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/hash.hpp"
#include "base/link/text.hpp"

namespace mrroc::mp {
namespace {

bool is_done(const SupervisedNode& node) {
  return node.status().state == static_cast<int>(link::ProcessState::done);
}

}  // namespace

std::string without_fingerprint(const SupervisedNodes& nodes) {
  for (const auto& node : nodes)
    if (!is_done(*node) || (node != nodes.front() && node->status().n_hashes < 1)) return node->name();
  return {};
}

std::uint64_t fingerprint_of(const SupervisedNodes& nodes) {
  std::map<std::string, const channel_hash_t*> by_channel;
  for (const auto& node : nodes) {
    if (!is_done(*node)) return 0;
    const process_status_t& status = node->status();
    const auto told =
        std::min<std::size_t>(static_cast<std::size_t>(std::max(0, status.n_hashes)), std::size(status.hash));
    for (std::size_t k = 0; k < told; ++k)
      by_channel[link::get_text(status.hash[k].channel)] = &status.hash[k];
  }
  Hash hash;
  for (const auto& [channel, h] : by_channel) {
    hash.add(channel);
    hash.add(static_cast<std::uint64_t>(h->count));
    hash.add(static_cast<std::uint64_t>(h->hash));
  }
  return hash.value();
}

}  // namespace mrroc::mp
