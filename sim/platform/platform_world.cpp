#include "sim/platform/platform_world.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/hash.hpp"
#include "sim/platform/planar_bodies.hpp"
#include "sim/platform/simulated_box.hpp"
#include "sim/platform/simulated_platform.hpp"
#include "sim/seed.hpp"

namespace mrroc::sim {
namespace {

constexpr int kIntegrations = 2;  // of the bodies in a step

void check(bool right, const char* what) {
  if (!right) throw std::invalid_argument(std::string("platforms: ") + what);
}

const PlatformWorldParameters& checked(const PlatformWorldParameters& p) {
  check(!p.platforms.empty() && p.platforms.size() <= kMostPlatforms, "there are one or two");
  check(p.micro_steps >= 1, "micro_steps must be at least 1");
  check(p.motion_capture.setup.period >= 1, "the period of motion capture must be at least 1");
  for (const PlatformParameters& each : p.platforms) {
    const robots::SkidSteerParameters& b = each.body;
    for (const double number :
         {b.mass, b.inertia, b.wheel_radius, b.half_wheelbase, b.half_track, b.wheel_inertia, b.slip_speed,
          b.increments_per_turn, b.torque_constant, b.length, b.width, p.ground.slip_speed})
      check(number > 0, "masses, lengths, speeds and constants must be positive");
    check(b.no_torque_speed > b.full_torque_speed, "a drive's torque must fall to zero somewhere");
    check(std::hypot(each.centre[0] / b.half_wheelbase, each.centre[1] / b.half_track) < 1,
          "the centre of mass must be between the wheels");
  }
  check(p.boxes.size() <= kMostBoxes, "there are too many boxes");
  for (const BoxParameters& each : p.boxes) {
    check(each.length > 0 && each.width > 0 && each.mass > 0, "a box has a mass and an outline");
    check(each.friction >= 0 && each.grip >= 0, "the friction of a box must not be negative");
  }
  return p;
}

}  // namespace

struct PlatformWorld::Impl {
  Impl(const PlatformWorldParameters& parameters, std::uint64_t seed)
      : p(checked(parameters)), bodies(p.room) {
    for (const PlatformParameters& each : p.platforms) {
      seed = mixed(seed);
      platforms.push_back(std::make_unique<SimulatedPlatform>(each, p, bodies, seed));
    }
    for (const BoxParameters& each : p.boxes) {
      seed = mixed(seed);
      boxes.push_back(std::make_unique<SimulatedBox>(each, p, bodies, seed));
    }
  }

  const SimulatedPlatform& platform(int k) const { return *platforms.at(static_cast<std::size_t>(k)); }
  const SimulatedBox& box(int k) const { return *boxes.at(static_cast<std::size_t>(k)); }

  PlatformWorldParameters p;
  PlanarBodies bodies;
  std::vector<std::unique_ptr<SimulatedPlatform>> platforms;
  std::vector<std::unique_ptr<SimulatedBox>> boxes;
  std::int64_t steps{};
};

PlatformWorld::PlatformWorld(const PlatformWorldParameters& parameters, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(parameters, seed)) {}
PlatformWorld::~PlatformWorld() = default;
PlatformWorld::PlatformWorld(PlatformWorld&&) noexcept = default;
PlatformWorld& PlatformWorld::operator=(PlatformWorld&&) noexcept = default;

int PlatformWorld::platforms() const { return static_cast<int>(impl_->platforms.size()); }
std::int64_t PlatformWorld::steps() const { return impl_->steps; }

void PlatformWorld::step(std::span<const PlatformDrive> drives) {
  Impl& w = *impl_;
  constexpr double kH = kPlatformStep / kIntegrations;
  const double begun = static_cast<double>(w.steps) * kPlatformStep;
  ++w.steps;
  for (std::size_t k = 0; k < w.platforms.size(); ++k)
    w.platforms[k]->begin_step(w.steps, k < drives.size() ? &drives[k] : nullptr);
  for (int n = 0; n < kIntegrations; ++n) {
    for (const auto& each : w.platforms) each->push(begun + n * kH, kH);
    for (const auto& each : w.boxes) each->push(begun + n * kH, kH);
    w.bodies.integrate(kH);
    for (const auto& each : w.platforms) each->follow();
    for (const auto& each : w.boxes) each->follow(kH);
  }
  for (const auto& each : w.platforms) each->end_step(kIntegrations);
  for (const auto& each : w.boxes) each->end_step(w.steps, kIntegrations);
}

const PlatformReading& PlatformWorld::reading(int platform) const {
  return impl_->platform(platform).reading();
}
const std::optional<CapturedPose>& PlatformWorld::motion_capture(int platform) const {
  return impl_->platform(platform).motion_capture();
}
const PlatformTruth& PlatformWorld::truth(int platform) const { return impl_->platform(platform).truth(); }

const robots::SkidSteerParameters& PlatformWorld::body(int platform) const {
  return impl_->platform(platform).body();
}

int PlatformWorld::boxes() const { return static_cast<int>(impl_->boxes.size()); }
const std::optional<CapturedPose>& PlatformWorld::box_motion_capture(int box) const {
  return impl_->box(box).motion_capture();
}
const BoxTruth& PlatformWorld::box_truth(int box) const { return impl_->box(box).truth(); }

std::uint64_t PlatformWorld::state_hash() const {
  Hash hash;
  for (const auto& each : impl_->platforms)
    each->visit_state([&hash](double x) { hash.add(std::bit_cast<std::uint64_t>(x)); });
  for (const auto& each : impl_->boxes)
    each->visit_state([&hash](double x) { hash.add(std::bit_cast<std::uint64_t>(x)); });
  return hash.value();
}

}  // namespace mrroc::sim
