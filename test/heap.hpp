// Counts what goes to the heap.
#pragma once

namespace mrroc::test {

/// Counts the allocations of this thread while it lives; one at a time.
class AllocationCounter {
 public:
  AllocationCounter() noexcept;
  ~AllocationCounter();
  AllocationCounter(const AllocationCounter&) = delete;
  AllocationCounter& operator=(const AllocationCounter&) = delete;

  /// @return blocks asked for since the counter was made
  [[nodiscard]] long count() const noexcept;
};

}  // namespace mrroc::test
