// Reports that a host is too slow for the wall clock.
#pragma once
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace mrroc::mp {

/// At most one line in ten seconds.
class LatenessNotice {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time

  /// Call it often. @param late  periods of all processes so far @return a line for a person; nothing: no news, or too soon
  [[nodiscard]] std::optional<std::string> look(Clock::time_point now, std::int64_t late) {
    constexpr std::chrono::seconds kApart{10};
    if (late <= told_ || now - told_at_ < kApart) return std::nullopt;
    const std::int64_t more = late - told_;
    told_ = late;
    told_at_ = now;
    return fmt::format("late periods: {} more, {} in all; this host is too slow or too busy for --clock wall",
                       more, late);
  }

 private:
  std::int64_t told_{};
  Clock::time_point told_at_{};
};

}  // namespace mrroc::mp
