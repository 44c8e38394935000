// A Port that plays images from memory: for tests by value, and for replaying what a log holds.
#pragma once
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "base/motion.hpp"

namespace mrroc {

/// Gives one image after the other and keeps what the behaviours decide. The own memory, i and i_0 of a given image do not
/// matter: Move carries them on.
template <Images A>
class ScriptPort {
 public:
  /// Images of the agent.
  using X = typename A::X;
  using Y = typename A::Y;

  /// Decision of a behaviour in one macrostep.
  struct Decision {
    int m;  ///< number of the behaviour
    Y y;    ///< as it was dispatched
  };

  /// @param images  what read() gives, one per macrostep
  explicit ScriptPort(std::vector<X> images) : images_(std::move(images)) {}

  /// Keeps the decision.
  void dispatch(const Motion<A>& motion, const Y& y) { decisions_.push_back({motion.m, y}); }

  /// @return aborted when the images are used up
  Outcome wait() { return next_ < images_.size() ? Outcome::terminated : Outcome::aborted; }

  /// Takes e, V and T of the next image, and counts i.
  void read(X& x) {
    const X& given = images_[next_++];
    x.e = given.e;
    x.V = given.V;
    x.T = given.T;
    ++x.i;
  }

  /// @return everything that has been dispatched, in order
  [[nodiscard]] const std::vector<Decision>& decisions() const { return decisions_; }

 private:
  std::vector<X> images_;
  std::size_t next_{};
  std::vector<Decision> decisions_;
};

}  // namespace mrroc
