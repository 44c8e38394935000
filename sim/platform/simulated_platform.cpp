#include "sim/platform/simulated_platform.hpp"

#include <cmath>

#include "sim/platform/ground.hpp"
#include "sim/seed.hpp"

namespace mrroc::sim {
namespace {

PlanarBody body_of(const PlatformParameters& p) {
  return {.mass = p.body.mass,
          .inertia = p.body.inertia,
          .length = p.body.length,
          .width = p.body.width,
          .middle = {-p.centre[0], -p.centre[1]}};
}

/// The centre of mass of a platform at rest with B at that pose.
PlanarState at_rest(const PlanarPose& p, const std::array<double, 2>& centre) {
  const double c = std::cos(p.phi), s = std::sin(p.phi);
  return {.x = p.x + c * centre[0] - s * centre[1], .y = p.y + s * centre[0] + c * centre[1], .phi = p.phi};
}

PlanarPose pose_of(const PlanarState& state, const std::array<double, 2>& centre) {
  const double c = std::cos(state.phi), s = std::sin(state.phi);
  return {.x = state.x - c * centre[0] + s * centre[1],
          .y = state.y - s * centre[0] - c * centre[1],
          .phi = state.phi};
}

PlanarVelocity velocity_of(const PlanarState& state, const std::array<double, 2>& centre) {
  const double c = std::cos(state.phi), s = std::sin(state.phi);
  return {.vx = c * state.vx + s * state.vy + state.w * centre[1],
          .vy = c * state.vy - s * state.vx - state.w * centre[0],
          .w = state.w};
}

}  // namespace

SimulatedPlatform::SimulatedPlatform(const PlatformParameters& platform, const PlatformWorldParameters& world,
                                     PlanarBodies& bodies, std::uint64_t seed)
    : k_(platform),
      world_(world),
      bodies_(bodies),
      body_(bodies.add(body_of(platform), at_rest(platform.start, platform.centre))),
      wheels_(platform, world.ground, mixed(seed)),
      sensors_(platform, mixed(seed + 1), kPlatformStep),
      capture_(world.motion_capture, mixed(seed + 2), kPlatformStep),
      state_(bodies.state(body_)) {
  motion_.load = wheels_.contacts().load;
  feel_ground(0);
  observe(false);
}

void SimulatedPlatform::begin_step(std::int64_t step, const PlatformDrive* drive) {
  step_ = step;
  drive_ = {};
  if (drive) drive_ = {.torque = drive->torque, .enabled = drive->enabled};
  if (k_.faults.wheel_blocked.contains(step)) drive_.blocked = k_.faults.wheel;
  imu_reset_ = drive && drive->imu_reset;
  motion_ = {};
}

void SimulatedPlatform::feel_ground(double time) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    const RoomPoint place = wheels_.place(state_, i);
    friction_[i] = friction_at(world_.ground, place[0], place[1], time);
  }
}

void SimulatedPlatform::push(double time, double h) {
  feel_ground(time);
  bodies_.push(body_, wheels_.step(state_, drive_, friction_, h, world_.micro_steps));
}

void SimulatedPlatform::follow() {
  const double before = state_.phi;
  state_ = bodies_.state(body_);
  motion_.turn += wrap_angle(state_.phi - before);
  const WheelContacts& contacts = wheels_.contacts();
  for (std::size_t i = 0; i < kWheels; ++i) {
    motion_.load[i] += contacts.load[i];
    motion_.torque[i] += contacts.torque[i];
  }
}

void SimulatedPlatform::end_step(int integrations) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    motion_.load[i] /= integrations;
    motion_.torque[i] /= integrations;
  }
  observe(imu_reset_);
}

void SimulatedPlatform::observe(bool imu_reset) {
  motion_.turned = wheels_.turned();
  reading_ = sensors_.measure(step_, motion_, imu_reset);
  const WheelContacts& contacts = wheels_.contacts();
  truth_.p = pose_of(state_, k_.centre);
  truth_.v = velocity_of(state_, k_.centre);
  truth_.wheel_speed = wheels_.speed();
  truth_.slip_speed = contacts.slip;
  for (std::size_t i = 0; i < kWheels; ++i) truth_.friction[i] = {friction_[i].mu_x, friction_[i].mu_y};
  truth_.load = contacts.load;
  truth_.torque = contacts.torque;
  captured_ = capture_.step(step_, truth_.p);
}

}  // namespace mrroc::sim
