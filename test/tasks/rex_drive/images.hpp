// What the agent of a platform perceives, for tests of its functions.
#pragma once
#include "tasks/rex_drive/locomotion.hpp"

namespace mrroc::rex_drive {

inline Plan straight_plan(std::int64_t number) {
  return {.number = number, .n = 2, .point = {{{0.5, 0}, {1, 0}}}, .speed = 0.5};
}

inline Locomotion::X idle_image() {
  Locomotion::X x;
  x.c = begin({});
  x.e.position_known = true;
  x.e.at_rest = true;
  return x;
}

/// An estimate that tells how the wheels have turned.
inline PlatformEstimate wheels_at(std::int64_t step, const PerWheel& theta) {
  PlatformEstimate estimate;
  estimate.step = step;
  estimate.theta = theta;
  return estimate;
}

/// Fragments in c.traj, of half a second each.
inline Locomotion::X image_with(int fragments) {
  Locomotion::X x = idle_image();
  for (int k = 0; k < fragments; ++k) {
    Trajectory t;
    t.duration = 0.5 + 0.1 * k;
    t.index = k;
    x.c.traj.push_back(t);
  }
  return x;
}

/// An image of which everything that is told is something.
inline Locomotion::X telling_image() {
  Locomotion::X x = idle_image();
  x.e.state = DriverState::holding;
  x.e.estimate.p = {1.5, -0.5, 0.25};
  x.e.estimate.v = {0.1, 0.2, 0.3};
  x.c.handed = x.e.notified = 6;
  return x;
}

}  // namespace mrroc::rex_drive
