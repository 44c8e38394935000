// Records which numbers of one sender have come, so that each is taken once, in any order.
#pragma once
#include <bitset>
#include <cstddef>
#include <cstdint>

namespace mrroc::link {

/// Remembers the highest number and which of those below it have come. What is older than that counts as come.
class ReplayWindow {
 public:
  static constexpr std::size_t kWidth = 128;  ///< numbers that may come late

  /// @param number  0 is none @return whether it comes for the first time; then it has come. Real-time safe
  bool take(std::uint64_t number) noexcept {
    if (number > highest_) {
      const std::uint64_t jump = number - highest_;
      come_ = jump < kWidth ? come_ << static_cast<std::size_t>(jump) : std::bitset<kWidth>();
      come_.set(0);
      highest_ = number;
      return true;
    }
    const std::uint64_t age = highest_ - number;
    if (number == 0 || age >= kWidth || come_.test(static_cast<std::size_t>(age))) return false;
    come_.set(static_cast<std::size_t>(age));
    return true;
  }

 private:
  std::uint64_t highest_{};
  std::bitset<kWidth> come_;  // [k]: highest_ - k
};

}  // namespace mrroc::link
