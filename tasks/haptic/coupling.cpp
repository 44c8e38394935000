#include "tasks/haptic/coupling.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::haptic {
namespace {

/// The force that the master may be put to: it grows by no more than a spring of the stiffness that the arm can be without
/// swinging, and slowly by itself.
Vector3 grown(const Law& law, const Vector3& before, const Vector3& wanted, double moved) {
  if (!law.grows_gently) return wanted;
  const double most = law.grow_stiffness * moved + law.grow_rate * law.macrostep;
  const double length = before.norm() + most;
  if (wanted.norm() <= length) return wanted;
  return length / wanted.norm() * wanted;
}

/// No longer than that.
Vector3 limited(const Vector3& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3(most / length * v) : v;
}

}  // namespace

Vector3 felt(const Law& law, const Vector3& F_s) {
  const double u = std::clamp(F_s.norm() / law.least_force - 1, 0.0, 1.0);
  return u * F_s;
}

Coupling coupled(const Law& law) {
  Coupling c;
  c.there = Channel(law.channel, law.macrostep, 0);
  c.back = Channel(law.channel, law.macrostep, 1);
  return c;
}

Coupling couple(Coupling c, const Law& law, const Sides& sides, std::int64_t i, double pace) {
  const double dt = law.macrostep;
  const double power_scale = law.motion_scale / law.force_scale;  // of the slave's side per master's
  const Vector3 F_s = felt(law, sides.F_s);
  const Vector3 v_m = (sides.x_m - c.x_m) / dt;
  c.x_m = sides.x_m;

  // The force comes back: what the master port puts out against the master's velocity.
  c.back.send({.stamp = i, .value = F_s, .energy = c.slave.in});
  const Packet& from_slave = c.back.receive(i);
  c.master = hear(c.master, law.passivity, from_slave.energy / power_scale);
  const Vector3 force = limited(-law.force_scale * from_slave.value, law.most_force);
  const Passed at_master = pass(c.master, law.passivity, grown(law, c.F_d, force, dt * v_m.norm()), v_m, dt,
                                dt * v_m.squaredNorm() / law.master.mobility);
  c.master = at_master.port;
  c.F_d = at_master.output;

  // The way goes there: what the slave port puts out against the slave's force.
  c.there.send({.stamp = i, .value = sides.x_m, .energy = c.master.in});
  const Packet& from_master = c.there.receive(i);
  if (from_master.stamp >= 0) c.age = i - from_master.stamp;
  c.slave = hear(c.slave, law.passivity, power_scale * from_master.energy);
  const Vector3 before = c.asked;
  c.asked = law.motion_scale * from_master.value;
  // As far as the master has come; what was kept back before, gently.
  const double most = (c.asked - before).norm() + dt * law.catch_up;
  const Vector3 velocity = pace / dt * limited(c.asked - c.place, std::min(most, dt * law.most_speed));
  const Passed at_slave = pass(c.slave, law.passivity, velocity, F_s, dt);
  c.slave = at_slave.port;
  c.place += dt * at_slave.output;

  c.fed += dt / (dt + law.smoothing) * (at_slave.output - c.fed);
  const Vector3 back = limited(law.return_rate * (c.place - sides.x_s), law.slave.mobility * law.most_force);
  c.v_d = limited(c.fed + back, law.most_speed);
  return c;
}

}  // namespace mrroc::haptic
