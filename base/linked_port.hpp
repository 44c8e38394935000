// A port with additional links that a task defines.
#pragma once
#include <utility>

#include "base/motion.hpp"

namespace mrroc {

/// A port that carries more than the one that it is made of: typed links (base/link/transmission_link.hpp), settings of
/// sensors.
/// @tparam P     a Port
/// @tparam Give  void(const Y&): hands the parts of y to their links before `port` sends
/// @tparam Take  void(X&): fills in the parts of x after `port` has filled in its own
template <class P, class Give, class Take>
class LinkedPort {
 public:
  /// @param port  must outlive this one
  LinkedPort(P& port, Give give, Take take) : port_(port), give_(std::move(give)), take_(std::move(take)) {}

  /// The operations of a Port.
  template <class A>
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    give_(y);
    port_.dispatch(motion, y);
  }
  Outcome wait() { return port_.wait(); }
  template <class X>
  void read(X& x) {
    port_.read(x);
    take_(x);
  }

 private:
  P& port_;
  Give give_;
  Take take_;
};

}  // namespace mrroc
