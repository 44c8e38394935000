// The Move instruction: algorithm (10) of MG, over any agent and any port.
#pragma once
#include <concepts>
#include <cstdint>
#include <string_view>

#include "base/fault_policy.hpp"
#include "base/latency.hpp"

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
  FaultPolicy policy{};                 ///< what a refused or failed command leads to
};

/// Why a Move ended.
/// terminated: f_tau held; aborted: the system ends, or images do; faulted: an error, which the port tells.
enum class Outcome : std::uint8_t { terminated, aborted, faulted };

/// Source and destination of images: processes over a link, memory in tests, a log in replay.
template <class P, class A>
concept Port = requires(P p, const Motion<A>& motion, const typename A::Y& y, typename A::X& x) {
  {p.dispatch(motion, y)};                // y -> e_j, V_j, other agents
  { p.wait() } -> std::same_as<Outcome>;  // i := i + 1; terminated means "go on"
  {p.read(x)};                            // e_j, V_j, other agents -> x
};

/// @return what a mishap that x tells of leads to; go_on without one. Answers to commands of the behaviour before come in the
///         first macrosteps: they neither repeat nor end this one
template <Images A>
[[nodiscard]] Response response(const Motion<A>& motion, const typename A::X& x) {
  const Response wanted = motion.policy.to(mishap_of(x.e));
  const bool own = x.i - x.i_0 >= latency::kCommandToReply;
  return own || wanted == Response::end ? wanted : Response::go_on;
}

/// y_cT of a behaviour under its policy: a mishap that does not end the task is told with its fault, and without a verdict.
template <Images A>
[[nodiscard]] auto transmission_of(const Motion<A>& motion, const typename A::X& x) {
  auto T = motion.f_cT(x);
  if constexpr (requires { T.verdict = Verdict::none; })
    if (mishap_of(x.e) != Mishap::none && response(motion, x) != Response::end) T.verdict = Verdict::none;
  return T;
}

/// Lets the effector come to rest after a mishap: nothing is commanded until what has been is answered and it stands.
/// Memory, sensors and other agents are as in every macrostep of the behaviour, whose f_cc so learns of the mishap.
/// @return terminated when it stands; otherwise why the port gave up
template <Images A, Port<A> P>
Outcome come_to_rest(const Motion<A>& motion, typename A::X& x, P& port) {
  for (std::int64_t k = 0; k < latency::kCommandToReply || moves(x.e); ++k) {
    const typename A::Y y{motion.f_cc(x), {}, motion.f_cV(x), transmission_of(motion, x)};
    port.dispatch(motion, y);
    if (const Outcome o = port.wait(); o != Outcome::terminated) return o;
    port.read(x);
    x.c = y.c;
  }
  return Outcome::terminated;
}

/// Executes one behaviour. All of x must be valid at the start, and is valid again at the end, so that the
/// next Move can follow at once. A command that is refused or fails leads to what the behaviour's policy says.
/// @return terminated when f_tau held, or the policy says that the next behaviour follows; otherwise why the port gave up,
///         with x as last read
template <Images A, Port<A> P>
Outcome move(const Motion<A>& motion, typename A::X& x, P& port) {
  const auto begin = [&] {
    x.i_0 = x.i;
    x.c = motion.f_entry(x);
  };
  begin();
  while (!motion.f_tau(x)) {
    const typename A::Y y{motion.f_cc(x), motion.f_ce(x), motion.f_cV(x), transmission_of(motion, x)};
    port.dispatch(motion, y);
    if (const Outcome o = port.wait(); o != Outcome::terminated) return o;
    port.read(x);
    x.c = y.c;
    if constexpr (requires { moves(x.e); }) {
      const Response wanted = response(motion, x);
      if (!leaves_behaviour(wanted)) continue;
      if (const Outcome o = come_to_rest(motion, x, port); o != Outcome::terminated) return o;
      if (wanted == Response::next_behaviour) return Outcome::terminated;
      begin();
    }
  }
  return Outcome::terminated;
}

}  // namespace mrroc
