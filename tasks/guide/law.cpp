#include "tasks/guide/law.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::guide {
namespace {

/// A row between free (0) and held (1): damping and inertia go from those of the one to those of the other.
AxisCommand between(const Law& law, double force, double held, double most_speed) {
  const double damping = (1 - held) / law.free_mobility + held / law.mobility;
  const double most = std::min(law.most_force, most_speed * damping);
  return c(std::clamp(force, -most, most), (1 - held) * law.free_inertia + held * law.inertia, 1 / damping);
}

AxisCommand across(const Law& law, double off, double share, double most_speed) {
  return between(law, -share * law.stiffness * off, share, most_speed);
}

/// @param bend  radius of the narrowest bend near the tool [m]
AxisCommand along(const Law& law, double beyond, double bend, double share, double most_speed) {
  const double held = share * smooth(std::abs(beyond) / law.wall_softness);
  AxisCommand row = between(law, share * wall_force(law, beyond), held, most_speed);
  row.mobility = std::min(row.mobility, law.free_mobility / (1 + share * std::max(0.0, law.bend / bend - 1)));
  return row;
}

}  // namespace

double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

double return_rate(const Law& law) { return std::max(law.stiffness, law.wall_stiffness) * law.mobility; }

double wall_force(const Law& law, double depth) {
  const double d = std::abs(depth), soft = law.wall_softness;
  const double pressed = d < soft ? d * d / (2 * soft) : d - soft / 2;
  return -std::copysign(law.wall_stiffness * pressed, depth);
}

double wall_energy(const Law& law, double depth) {
  const double d = std::abs(depth), soft = law.wall_softness;
  if (d < soft) return law.wall_stiffness * d * d * d / (6 * soft);
  const double more = d - soft;
  return law.wall_stiffness * (soft * soft / 6 + more * soft / 2 + more * more / 2);
}

TaskFrameCommand rows(const Law& law, const Fixture& fixture, const Standing& standing, double share,
                      double most_speed) {
  TaskFrameCommand frame;
  frame.x = along(law, standing.beyond[0], fixture.bend(standing.s), share, most_speed);
  frame.y = fixture.is_plane() ? along(law, standing.beyond[1], HUGE_VAL, share, most_speed)
                               : across(law, standing.y, share, most_speed);
  frame.z = across(law, standing.z, share, most_speed);
  return frame;
}

}  // namespace mrroc::guide
