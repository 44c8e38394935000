// Random valid motion commands.
#pragma once
#include <random>

#include "base/representation.hpp"
#include "edp/control_law.hpp"
#include "test/base/random_pose.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {

using mrroc::test::random_direction;
using mrroc::test::random_vector;
using mrroc::test::uniform;

inline int pick(std::mt19937_64& random, int n) {
  return static_cast<int>(random() % static_cast<unsigned>(n));
}

inline AxisCommand random_row(std::mt19937_64& random, bool rotational) {
  const double v = rotational ? uniform(random, -0.5, 0.5) : uniform(random, -0.1, 0.1);
  const double I = rotational ? 0.5 : uniform(random, 1, 20);
  const double B = rotational ? 0.05 : uniform(random, 0.001, 0.01);
  switch (pick(random, 3)) {
    case 0:
      return u(v);
    case 1:
      return g(v, I, B);
    default:
      return c(rotational ? uniform(random, -2, 2) : uniform(random, -10, 10), I, B);
  }
}

/// @return a motion that is legal in the middle of the workspace
inline ArmCommand random_motion(std::mt19937_64& random) {
  ArmCommand a;
  a.n_s = static_cast<std::uint16_t>(1 + pick(random, 30));
  a.n_Q = static_cast<std::uint16_t>(1 + pick(random, a.n_s));
  a.mu = static_cast<Interpolation>(pick(random, 3));
  for (const Axis axis : kAxes) a.frame[axis] = random_row(random, axis >= Axis::ax);
  a.reference = Reference::relative;
  const double time = 0.002 * a.n_s;
  if (a.mu == Interpolation::mim) {
    a.representation = Representation::motors;
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k) a.pose[k] = uniform(random, -40, 40) * time;
  } else {
    a.representation = Representation::xyz_angle_axis;
    const Vector3 p = uniform(random, 0, 0.3) * time * random_direction(random);
    const Vector3 aa = uniform(random, 0, 1) * time * random_direction(random);
    a.pose = {p.x(), p.y(), p.z(), aa.x(), aa.y(), aa.z()};
  }
  return a;
}

}  // namespace mrroc::edp::test
