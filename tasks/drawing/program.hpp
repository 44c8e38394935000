// The coordinator's program: the order of its behaviours, MS fig. 6.
#pragma once
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {

/// Executes the task: teach-in unless the memory holds a recording already, then reproduction to its end.
/// @param x     images of the first macrostep
/// @param port  a Port of the coordinator
/// @return terminated at the end of the drawing; faulted when a pen found no paper, with no_contact(x), or left it,
///         with arm_off_its_sheet(x); otherwise why
///         the port gave up
template <class P>
Outcome run_program(Coordinator::X& x, P& port) {
  const auto behaviour = [&](int m) { return move(kCoordinator[static_cast<std::size_t>(m - 1)], x, port); };
  const auto nodes_left = [&] { return x.c.p < static_cast<double>(x.c.recording.size()); };
  const bool taught_before = !x.c.recording.empty();
  Outcome o = move(kWaitForStart, x, port);
  if (o == Outcome::terminated && !taught_before) {
    for (const int m : {1, 2})
      if (o == Outcome::terminated) o = behaviour(m);
    x.c.p = 0;  // reproduction begins with the first node
    x.c.recording = without_false_touches(x.c.recording);
  }
  if (o == Outcome::terminated) o = behaviour(3);
  while (o == Outcome::terminated) {
    o = behaviour(4);
    if (o == Outcome::terminated && no_contact(x)) return Outcome::faulted;
    if (o == Outcome::terminated) o = behaviour(5);
    if (o == Outcome::terminated && arm_off_its_sheet(x)) return Outcome::faulted;
    if (o == Outcome::terminated) o = behaviour(6);
    if (o != Outcome::terminated || !nodes_left()) break;
    o = behaviour(7);
    if (!nodes_left()) break;
  }
  return o;
}

}  // namespace mrroc::drawing
