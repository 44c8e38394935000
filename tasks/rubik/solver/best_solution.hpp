// The shortest solution so far, shared by all threads of a search.
#pragma once
#include <atomic>
#include <mutex>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Any number of threads offer solutions. Every function but moves() may be called at any time.
class BestSolution {
 public:
  /// Before there is a solution, one of this length is taken to be known.
  static constexpr int kNone = 31;

  /// @param good_enough  no need to search on when a solution has at most so many turns
  explicit BestSolution(int good_enough) : good_enough_(good_enough) {}

  /// @return turns of the best solution, kNone before there is one
  [[nodiscard]] int length() const { return length_.load(std::memory_order_relaxed); }
  /// @return whether there is a solution
  [[nodiscard]] bool found() const { return length() < kNone; }
  /// @return whether the search may end
  [[nodiscard]] bool good_enough() const { return length() <= good_enough_; }
  /// Takes the solution if it is shorter.
  void offer(const Moves& moves) {
    const std::lock_guard guard(mutex_);
    const int offered = static_cast<int>(moves.size());
    if (offered >= length()) return;
    moves_ = moves;
    length_ = offered;
  }
  /// @return the solution; for when no other thread searches any more
  [[nodiscard]] const Moves& moves() const { return moves_; }

 private:
  const int good_enough_;
  std::atomic<int> length_{kNone};
  std::mutex mutex_;
  Moves moves_;
};

}  // namespace mrroc::rubik
