// The fragments that a platform has been handed and not driven yet (paper REX, algorithm 7: e_y[traj], [steps], [notify]).
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/platform_path.hpp"

namespace mrroc::edp {

/// Fragments in the order of their numbers, and the time of the one under way. Times are counted in iterations. What it is
/// given has been checked (edp/platform/guard.hpp). Real-time safe.
class FragmentQueue {
 public:
  /// Most fragments, the one under way among them.
  static constexpr std::size_t kCapacity = 8;

  /// @return whether there is no fragment
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// @return whether there is no room for one more
  [[nodiscard]] bool full() const noexcept { return count_ == kCapacity; }

  /// Appends a fragment. Its heading is turned by whole turns, so that it goes on from the queue's end.
  void push(const Fragment& fragment) noexcept;
  /// Time passes. What ends is left, and the next one goes on with the time that is left over.
  /// @param iterations  >= 0
  void advance(double iterations) noexcept;
  /// Leaves all fragments and stands at the present point.
  void drop() noexcept;
  /// Stands elsewhere; there must be no fragment. @param p  phi may be of any turn
  void hold_at(const PlanarPose& p) noexcept { held_ = p; }
  /// The numbers begin anew: the next session's first fragment has the number 1.
  void forget_numbers() noexcept { accepted_ = notified_ = 0; }

  /// @param ahead  >= 0 from now  @return the point of the way there; behind its end the last one, standing
  [[nodiscard]] PathPoint at(double ahead) const noexcept;
  /// @return the point at which the way ends, with its speeds; without a fragment where it stands
  [[nodiscard]] PathPoint end() const noexcept;

  /// @return number of the last fragment taken; 0: none
  [[nodiscard]] std::int64_t accepted() const noexcept { return accepted_; }
  /// @return number of the last fragment that has reached its notify, as all before it have; 0: none. One that does so before
  ///         its beginning waits until there is room for the next one
  [[nodiscard]] std::int64_t notified() const noexcept { return notified_; }
  /// @return number of the fragment under way; 0: none
  [[nodiscard]] std::int64_t executing() const noexcept { return empty() ? 0 : front().number; }
  /// @return whole iterations of the fragment under way
  [[nodiscard]] std::int32_t iteration() const noexcept;
  /// @return iterations to the end of the way, rounded up
  [[nodiscard]] std::int32_t remaining() const noexcept;

 private:
  [[nodiscard]] const Fragment& fragment(std::size_t k) const noexcept {
    return ring_[(first_ + k) % kCapacity];
  }
  [[nodiscard]] const Fragment& front() const noexcept { return fragment(0); }
  void note() noexcept;

  std::array<Fragment, kCapacity> ring_{};
  std::size_t first_{};
  std::size_t count_{};
  double time_{};  // of the fragment under way
  PlanarPose held_{};
  std::int64_t accepted_{};
  std::int64_t notified_{};
};

}  // namespace mrroc::edp
