// The Move instruction: algorithm (10) of MG, over any agent and any port.
#pragma once
#include <concepts>
#include <cstdint>
#include <string_view>

namespace mrroc {

/// Images of one agent. X is everything that f' may read, Y is everything that it decides (MG 4, 5).
template <class A>
concept Images = requires(typename A::X x, typename A::Y y) {
  x.c;    // own memory
  x.e;    // effector
  x.V;    // virtual sensors
  x.T;    // transmission from other agents
  x.i;    // macrostep
  x.i_0;  // macrostep in which the present behaviour began
  y.c;
  y.e;
  y.V;
  y.T;
};

/// One row of a task's program: (^m f', ^m f_tau), f' split by output buffer as in MG (6).
/// Every function is pure: a logged x gives the logged y again.
template <Images A>
struct Motion {
  /// Images that the functions take and give.
  using X = typename A::X;
  using Y = typename A::Y;
  int m;                                ///< number of the behaviour
  std::string_view name;                ///< for the operator
  decltype(Y::c) (*f_entry)(const X&);  ///< memory at entry, once, before the first test of f_tau
  decltype(Y::c) (*f_cc)(const X&);     ///< memory
  decltype(Y::e) (*f_ce)(const X&);     ///< effector
  decltype(Y::V) (*f_cV)(const X&);     ///< virtual sensors
  decltype(Y::T) (*f_cT)(const X&);     ///< other agents
  bool (*f_tau)(const X&);              ///< terminal condition
  std::string_view until{};             ///< what it waits for, in words for the operator; may be empty
};

/// Why a Move ended.
/// terminated: f_tau held; aborted: the system ends, or images do; faulted: an error, which the port tells.
enum class Outcome : std::uint8_t { terminated, aborted, faulted };

/// Where images come from and go to: processes over a link, memory in tests, a log in replay.
template <class P, class A>
concept Port = requires(P p, const Motion<A>& motion, const typename A::Y& y, typename A::X& x) {
  {p.dispatch(motion, y)};                // y -> e_j, V_j, other agents
  { p.wait() } -> std::same_as<Outcome>;  // i := i + 1; terminated means "go on"
  {p.read(x)};                            // e_j, V_j, other agents -> x
};

/// Executes one behaviour. All of x must be valid at the start, and is valid again at the end, so that the
/// next Move can follow at once.
/// @return terminated when f_tau held; otherwise why the port gave up, with x as last read
template <Images A, Port<A> P>
Outcome move(const Motion<A>& motion, typename A::X& x, P& port) {
  x.i_0 = x.i;
  x.c = motion.f_entry(x);
  while (!motion.f_tau(x)) {
    const typename A::Y y{motion.f_cc(x), motion.f_ce(x), motion.f_cV(x), motion.f_cT(x)};
    port.dispatch(motion, y);
    if (const Outcome o = port.wait(); o != Outcome::terminated) return o;
    port.read(x);
    x.c = y.c;
  }
  return Outcome::terminated;
}

}  // namespace mrroc
