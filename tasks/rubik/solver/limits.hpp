// Limits of a search, and the request to end it.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>

namespace mrroc::rubik {

/// Limits that end a search which could go on.
struct SearchLimits {
  std::chrono::microseconds budget{std::chrono::microseconds::max()};  ///< of wall time; max: none
  /// Nodes after which the search ends. With one thread and no budget the result is the same in every run.
  std::uint64_t nodes{std::numeric_limits<std::uint64_t>::max()};
  int threads{1};  ///< at least 1
};

/// The limits while a search runs. Shared by its threads.
class Stopwatch {
 public:
  /// The time begins now.
  explicit Stopwatch(const SearchLimits& limits)
      : end_(limits.budget == std::chrono::microseconds::max() ? Clock::time_point::max()
                                                               : Clock::now() + limits.budget),
        nodes_left_(limits.nodes) {}

  /// @return whether the time has come; reads the clock
  [[nodiscard]] bool over() const {
    return stopped_.load(std::memory_order_relaxed) ||
           (end_ != Clock::time_point::max() && Clock::now() >= end_);
  }
  /// Counts nodes. @return false when they are used up
  bool spend(std::uint64_t nodes) {
    std::uint64_t left = nodes_left_.load(std::memory_order_relaxed);
    while (!nodes_left_.compare_exchange_weak(left, left > nodes ? left - nodes : 0)) {
    }
    return left > nodes;
  }
  /// Ends all threads of the search.
  void stop() { stopped_.store(true, std::memory_order_relaxed); }

 private:
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end_;
  std::atomic<std::uint64_t> nodes_left_;
  std::atomic<bool> stopped_{false};
};

/// One thread's share in the limits: looks at the clock every some hundred nodes.
class NodeCounter {
 public:
  /// @param watch  must outlive the counter
  explicit NodeCounter(Stopwatch& watch) : watch_(watch) {}
  ~NodeCounter() { watch_.spend(since_); }
  NodeCounter(const NodeCounter&) = delete;
  NodeCounter& operator=(const NodeCounter&) = delete;

  /// @return whether the search is to end; then it stays so
  bool count() {
    if (++since_ < kInterval) return over_;
    over_ = over_ || !watch_.spend(since_) || watch_.over();
    since_ = 0;
    return over_;
  }
  /// @return what count() has said last
  [[nodiscard]] bool over() const { return over_; }

 private:
  static constexpr std::uint64_t kInterval = 128;
  Stopwatch& watch_;
  std::uint64_t since_{};
  bool over_{};
};

}  // namespace mrroc::rubik
