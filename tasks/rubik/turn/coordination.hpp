// The coordination of the two arms by Boolean events, MG (60)-(63): both change behaviour in the same macrostep.
#pragma once
#include <array>

#include "base/transmission.hpp"

namespace mrroc::rubik {

/// c_c of the coordinator a_0.
struct Coordination {
  int m{1};                     ///< behaviour in force, 1..6
  std::array<bool, 2> go_on{};  ///< elements 1 (odd m) and 2 (even m) of y_cT_0j
};

/// One macrostep: an event that is tagged with the behaviour in force ends it. Events of other behaviours are left
/// over: those of the behaviour before are still set when a_0 is in the next one already.
/// @param reports  x_cT_0j of the arms
/// @return the memory of the next macrostep; go_on is what both arms are sent, with the element of the behaviour that
///         has ended set and the other one cleared
template <class Reports>
constexpr Coordination coordinate(Coordination c, const Reports& reports) {
  for (const Report& report : reports) {
    if (report.event != c.m) continue;
    const std::size_t element = c.m % 2 == 1 ? 0 : 1;
    c.go_on[element] = true;
    c.go_on[1 - element] = false;
    ++c.m;
    break;
  }
  return c;
}

/// @return the order for both arms
constexpr Order order(const Coordination& c) { return {.m = c.m, .go_on = c.go_on}; }

}  // namespace mrroc::rubik
