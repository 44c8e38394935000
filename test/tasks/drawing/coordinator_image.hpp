// Images of the coordinator, for tests by value.
#pragma once
#include <algorithm>
#include <initializer_list>

#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {

/// @return the row of the coordinator's table
inline const Motion<Coordinator>& row(int m) { return kCoordinator[static_cast<std::size_t>(m - 1)]; }

/// @return what the coordinator sees of two pens in these states, while the task runs
inline Coordinator::X image(PenState pen_1 = PenState::above_paper, PenState pen_2 = PenState::above_paper) {
  Coordinator::X x;
  x.c.recording = Recording(0.02);
  x.T.agent[0].sensor = static_cast<int>(pen_1);
  x.T.agent[1].sensor = static_cast<int>(pen_2);
  x.T.agent[0].ready = x.T.agent[1].ready = true;
  x.T.h.started = true;
  return x;
}

/// Task time in this macrostep, as the links' TaskClock has it.
inline void note_pause(Coordinator::X& x) {
  const double change = 1.0 / x.c.k.pause;
  x.t.paused = x.T.h.paused;
  x.t.pace = std::clamp(x.t.pace + (x.t.paused ? -change : change), 0.0, 1.0);
}
/// The rest of the macrostep: the memory, and the time that has passed.
inline void finish(Coordinator::X& x, int m) {
  x.c = row(m).f_cc(x);
  x.t.time += x.t.pace;
}
/// One macrostep of behaviour m.
inline void pass(Coordinator::X& x, int m) {
  note_pause(x);
  finish(x, m);
}

/// @return a recording with these pen states, velocities (1, -2) mm/s times the number of the node
inline Recording recording(std::initializer_list<PenState> pens) {
  Recording r(0.02);
  double k = 0;
  for (const PenState pen : pens) {
    ++k;
    r = r.appended({Twist{{0.001 * k, -0.002 * k, 0.5, 0.5, 0.5, 0.5}}, pen});
  }
  return r;
}

/// Puts the pen of that arm there.
inline void give_pose(Coordinator::X& x, const Pose& T, std::size_t arm = 0) {
  Eigen::Map<AngleAxisPose>(x.T.agent[arm].T_0E.data()) = angle_axis_from_pose(T);
}

}  // namespace mrroc::drawing
