// Loss, duplication and delay made on purpose, at the receiver and in simulated steps, so that every run can
// be repeated (architecture, rule R5).
#pragma once
#include <cstdint>

#include "base/hash.hpp"

namespace mrroc::link {

/// Faults that a link injects into its messages. Each probability is within 0..1; their sum must not exceed
/// 1.
struct Injection {
  double loss{};                       ///< probability that a message never arrives
  double duplication{};                ///< probability that it arrives twice
  double delay{};                      ///< probability that it arrives late
  int max_delay{2};                    ///< largest delay [stamps], 1..kMaxDelay
  std::uint64_t seed{};                ///< of the fates
  static constexpr int kMaxDelay = 4;  ///< [stamps]

  /// Fate of one message.
  struct Fate {
    int copies{1};  ///< 0: it is lost
    int delay{};    ///< [stamps]
  };

  /// @return the fate of the message with that stamp: a pure function of seed and stamp; real-time safe
  [[nodiscard]] constexpr Fate fate(std::int64_t stamp) const noexcept {
    if (loss + duplication + delay <= 0) return {};
    Hash h;
    h.add(seed);
    h.add(static_cast<std::uint64_t>(stamp));
    // FNV's low bits mix badly over few bytes: spread them once more.
    std::uint64_t x = h.value();
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdULL;
    x ^= x >> 33;
    const double chance = static_cast<double>(x >> 11) * 0x1p-53;
    if (chance < loss) return {0, 0};
    if (chance < loss + duplication) return {2, 0};
    if (chance < loss + duplication + delay)
      return {1, 1 + static_cast<int>(x % static_cast<std::uint64_t>(max_delay))};
    return {};
  }
};

}  // namespace mrroc::link
