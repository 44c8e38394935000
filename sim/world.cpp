#include "sim/world.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "sim/engine.hpp"
#include "sim/seed.hpp"
#include "sim/simulated_arm.hpp"

namespace mrroc::sim {
namespace {

const WorldParameters& checked(const WorldParameters& p) {
  if (p.arms.empty()) throw std::invalid_argument("world: there is no arm");
  if (p.substeps < 1) throw std::invalid_argument("world: substeps must be at least 1");
  if (p.solver_iterations < 1) throw std::invalid_argument("world: solver_iterations must be at least 1");
  if (p.cube && (p.cube->held_by < 0 || p.cube->held_by >= static_cast<int>(p.arms.size()) ||
                 !p.arms[static_cast<std::size_t>(p.cube->held_by)].gripper))
    throw std::invalid_argument("world: the cube is held by no gripper");
  if (std::ranges::count_if(p.arms, [](const ArmParameters& arm) { return arm.type && arm.type->belt; }) > 1)
    throw std::invalid_argument("world: there are several conveyors");
  return p;
}

std::vector<ArmPlan> plans_of(const WorldParameters& p) {
  std::vector<ArmPlan> plans;
  plans.reserve(p.arms.size());
  for (const ArmParameters& arm : p.arms) plans.push_back(plan_arm(arm));
  return plans;
}

}  // namespace

struct World::Impl {
  Impl(const WorldParameters& parameters, std::uint64_t seed) : p(checked(parameters)) {
    std::vector<ArmPlan> plans = plans_of(p);
    engine = p.engine == PhysicsEngine::mujoco ? mujoco_engine(p, plans) : bullet_engine(p, plans);
    for (std::size_t k = 0; k < plans.size(); ++k) {
      seed = mixed(seed);
      arms.push_back(std::make_unique<SimulatedArm>(p.arms[k], std::move(plans[k]),
                                                    engine->arm(static_cast<int>(k)), kStep / p.substeps,
                                                    p.substeps, seed));
      if (!p.arms[k].type->belt) continue;
      belt = arms.back().get();
      belt_start = belt->T_UE().p;
    }
  }

  /// The sheets go where the belt goes.
  void carry_sheets() {
    if (!belt) return;
    for (const auto& arm : arms) arm->carry_sheet(belt->T_UE().p - belt_start);
  }

  SimulatedArm& arm(int k) { return *arms.at(static_cast<std::size_t>(k)); }

  WorldParameters p;
  std::unique_ptr<Engine> engine;
  std::vector<std::unique_ptr<SimulatedArm>> arms;
  SimulatedArm* belt{};  // one of them; null: the sheets lie on tables
  Vector3 belt_start{Vector3::Zero()};
  std::int64_t steps{};
};

World::World(const WorldParameters& parameters, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(parameters, seed)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::reset(std::uint64_t seed) { impl_ = std::make_unique<Impl>(WorldParameters(impl_->p), seed); }

int World::arms() const { return static_cast<int>(impl_->arms.size()); }

void World::step(std::span<const HardwareCommand> commands) {
  Impl& w = *impl_;
  ++w.steps;
  for (std::size_t k = 0; k < w.arms.size(); ++k)
    w.arms[k]->begin_step(k < commands.size() ? &commands[k] : nullptr);
  w.engine->begin_step();
  for (int substep = 0; substep < w.p.substeps; ++substep) {
    for (const auto& arm : w.arms) arm->push();
    w.engine->integrate();
    for (const auto& arm : w.arms) arm->follow();
    w.engine->follow();
  }
  w.carry_sheets();
  for (const auto& arm : w.arms) arm->end_step(w.steps);
  w.engine->end_step();
}

const HardwareReading& World::reading(int arm) const { return impl_->arm(arm).reading(); }
std::int64_t World::steps() const { return impl_->steps; }
Hand& World::hand(int arm) { return impl_->arm(arm).hand(); }
const AxisVector& World::start_joints(int arm) const { return impl_->arm(arm).start_joints(); }
const ArmTruth& World::truth(int arm) const { return impl_->arm(arm).truth(); }
std::vector<LinkShape> World::shapes(int arm) const { return impl_->arm(arm).shapes(); }
const std::vector<InkPoint>& World::ink(int arm) const { return impl_->arm(arm).ink().points(); }
void World::set_object(int arm, double width) { impl_->arm(arm).set_object(width); }
const CubeTruth* World::cube() const { return impl_->engine->cube(); }
const FreeBodyTruth* World::free_body() const { return impl_->engine->free_body(); }
void World::set_face_friction(cube::Face face, const FaceFriction& friction) {
  impl_->engine->set_face_friction(face, friction);
}
bool World::lay_cube(int axis) { return impl_->engine->lay_cube(axis); }
Pose World::effector(int arm) const { return impl_->arm(arm).T_UE(); }
void World::new_sheet(int arm) { impl_->arm(arm).ink().clear(); }

std::uint64_t World::state_hash() const {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a over 64-bit words
  const auto take = [&](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * kPrime; };
  for (const auto& arm : impl_->arms) arm->visit_state(take);
  impl_->engine->visit_state(take);
  return hash;
}

}  // namespace mrroc::sim
