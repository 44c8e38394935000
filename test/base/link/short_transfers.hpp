// What the kernel may do with every read and write: move fewer bytes than it is asked for, or be interrupted.
#pragma once
#include <cstddef>

namespace mrroc::link::test {

/// While it lives, pread() and pwrite() of its thread move so many bytes at most, and every third call is interrupted.
class ShortTransfers {
 public:
  /// @param most  bytes, at least 1
  explicit ShortTransfers(std::size_t most) noexcept;
  ~ShortTransfers();
  ShortTransfers(const ShortTransfers&) = delete;
  ShortTransfers& operator=(const ShortTransfers&) = delete;

  /// @return calls so far
  [[nodiscard]] static std::size_t calls() noexcept;
};

}  // namespace mrroc::link::test
