#include "sim/platform/simulated_box.hpp"

#include <algorithm>
#include <cmath>

#include "sim/platform/ground.hpp"
#include "sim/seed.hpp"

namespace mrroc::sim {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]
/// A cell that is slower than this has no direction in which it slips [m/s].
constexpr double kNoSpeed = 1e-9;

PlanarBody body_of(const BoxParameters& box, double inertia) {
  return {.mass = box.mass, .inertia = inertia, .length = box.length, .width = box.width, .grip = box.grip};
}

PlanarState at_rest(const PlanarPose& p) { return {.x = p.x, .y = p.y, .phi = p.phi}; }

}  // namespace

double SlidingBase::inertia() const { return k_.mass * (k_.length * k_.length + k_.width * k_.width) / 12; }

PlanarForce SlidingBase::friction(const PlanarState& state, const GroundParameters& ground, double time,
                                  double h) const {
  const double c = std::cos(state.phi), s = std::sin(state.phi);
  const double weight =
      k_.friction * k_.mass * kGravity / (kCells * kCells);  // of a cell, times its friction [N]
  const auto place = [](std::size_t n, double side) {
    return side * ((static_cast<double>(n) + 0.5) / kCells - 0.5);
  };
  PlanarForce slips;
  double most_force = 0, most_moment = 0;
  for (std::size_t n = 0; n < kCells * kCells; ++n) {
    const double along = place(n / kCells, k_.length), across = place(n % kCells, k_.width);
    const double x = c * along - s * across, y = s * along + c * across;
    const double most = weight * scale_at(ground, state.x + x, state.y + y, time);
    most_force += most;
    most_moment += most * std::hypot(x, y);
    const double vx = state.vx - state.w * y, vy = state.vy + state.w * x;
    const double speed = std::hypot(vx, vy);
    if (speed < kNoSpeed) continue;
    const double fx = -most * vx / speed, fy = -most * vy / speed;
    slips.x += fx;
    slips.y += fy;
    slips.moment += x * fy - y * fx;
  }
  const PlanarForce stops{
      .x = -k_.mass * state.vx / h, .y = -k_.mass * state.vy / h, .moment = -inertia() * state.w / h};
  return holds(stops, most_force, most_moment) ? stops : at_most(slips, state, h);
}

/// The forces and moments that a base can hold against are an ellipsoid, nearly.
bool SlidingBase::holds(const PlanarForce& f, double most_force, double most_moment) {
  if (most_force <= 0) return false;
  const double force = std::hypot(f.x, f.y) / most_force, moment = f.moment / most_moment;
  return force * force + moment * moment <= 1;
}

/// Friction takes energy out: where a whole step of it would bring some in again, there is less.
PlanarForce SlidingBase::at_most(const PlanarForce& f, const PlanarState& state, double h) const {
  const double power = f.x * state.vx + f.y * state.vy + f.moment * state.w;
  const double turns = h * ((f.x * f.x + f.y * f.y) / k_.mass + f.moment * f.moment / inertia());
  const double share = turns > 0 ? std::clamp(-power / turns, 0.0, 1.0) : 0;
  return {.x = share * f.x, .y = share * f.y, .moment = share * f.moment};
}

SimulatedBox::SimulatedBox(const BoxParameters& box, const PlatformWorldParameters& world,
                           PlanarBodies& bodies, std::uint64_t seed)
    : base_(box),
      mass_(box.mass),
      world_(world),
      bodies_(bodies),
      body_(bodies.add(body_of(box, base_.inertia()), at_rest(box.start))),
      capture_(world.motion_capture, mixed(seed), kPlatformStep),
      state_(bodies.state(body_)) {
  observe(0, {});
}

/// What touches the box pushes it as it did in the integration before: so a box that is pushed with less than its friction
/// stands, instead of creeping from one integration to the next.
void SimulatedBox::push(double time, double h) {
  PlanarState pushed = state_;
  pushed.vx += h * contact_.x / mass_;
  pushed.vy += h * contact_.y / mass_;
  pushed.w += h * contact_.moment / base_.inertia();
  friction_ = base_.friction(pushed, world_.ground, time, h);
  bodies_.push(body_, friction_);
}

void SimulatedBox::follow(double h) {
  const PlanarState before = state_;
  state_ = bodies_.state(body_);
  contact_.x = mass_ * (state_.vx - before.vx) / h - friction_.x;
  contact_.y = mass_ * (state_.vy - before.vy) / h - friction_.y;
  contact_.moment = base_.inertia() * (state_.w - before.w) / h - friction_.moment;
  sum_.x += contact_.x;
  sum_.y += contact_.y;
  sum_.moment += contact_.moment;
}

void SimulatedBox::end_step(std::int64_t step, int integrations) {
  observe(step,
          {.x = sum_.x / integrations, .y = sum_.y / integrations, .moment = sum_.moment / integrations});
  sum_ = {};
}

void SimulatedBox::observe(std::int64_t step, const PlanarForce& push) {
  truth_.p = {.x = state_.x, .y = state_.y, .phi = state_.phi};
  truth_.speed = {state_.vx, state_.vy, state_.w};
  truth_.push = {push.x, push.y, push.moment};
  captured_ = capture_.step(step, truth_.p);
}

}  // namespace mrroc::sim
