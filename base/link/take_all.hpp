// Collects everything that comes on a channel which nobody waits for.
#pragma once
#include <cstdint>
#include <vector>

#include "base/link/channel.hpp"

namespace mrroc::link {

/// Messages that may be missing before the next one is taken all the same: a lost one is sent again.
inline constexpr std::int64_t kMaxMissing = 8;

/// Takes what has come, in the order of the stamps. Call it more often than the inbox is deep.
/// @param kept  what has been taken; grows
template <class M, std::int64_t depth>
void take_all(const Inbox<M, depth>& in, std::vector<M>& kept) {
  const auto expected = [&] { return kept.empty() ? 0 : kept.back().header.stamp + 1; };
  while (const M* const m = in.next(expected())) {
    const bool gap = !kept.empty() && m->header.stamp > expected();
    if (gap && in.newest() && in.newest()->header.stamp < expected() + kMaxMissing) return;
    kept.push_back(*m);
  }
}

}  // namespace mrroc::link
