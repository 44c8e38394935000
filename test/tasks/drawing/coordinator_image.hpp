// Images of the coordinator, for tests by value.
#pragma once
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

/// Puts the pen of arm 1 there.
inline void give_pose(Coordinator::X& x, const Pose& T) {
  Eigen::Map<AngleAxisPose>(x.T.agent[0].T_0E.data()) = angle_axis_from_pose(T);
}

}  // namespace mrroc::drawing
