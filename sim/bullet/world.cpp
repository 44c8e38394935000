#include "sim/world.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "sim/bullet/arm.hpp"
#include "sim/bullet/cube_body.hpp"
#include "sim/bullet/free_body.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/seed.hpp"

namespace mrroc::sim {
namespace {

constexpr double kTableEdge = 0.6;  // [m]

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

}  // namespace

struct World::Impl {
  Impl(const WorldParameters& parameters, std::uint64_t seed)
      : p(checked(parameters)), scene(p.solver_iterations) {
    const auto is_belt = [](const ArmParameters& arm) { return arm.type && arm.type->belt; };
    const bool on_belt = std::ranges::any_of(p.arms, is_belt);
    for (const ArmParameters& arm : p.arms) {
      if (!on_belt) scene.add_table(arm.T_UB * arm.paper.T_0P, kTableEdge);
      scene.add_plate(arm.T_UB * arm.paper.T_0P, arm.plate);
      seed = mixed(seed);
      arms.push_back(std::make_unique<SimulatedArm>(arm, scene, kStep / p.substeps, p.substeps, seed));
      if (!is_belt(arm)) continue;
      belt = arms.back().get();
      belt_start = belt->T_UE().p;
    }
    if (p.artefact) scene.add_artefact(*p.artefact);
    if (!p.cube && !p.free_body) return;
    scene.prepare_for_grasping();
    scene.on_contacts([this] {
      for (const auto& each : arms) each->share_stiffness();
    });
    if (p.free_body) add_free_body();
    if (!p.cube) return;
    cube = std::make_unique<CubeBody>(*p.cube, this->arm(p.cube->held_by).T_UE() * p.cube->T_EC, scene,
                                      kStep / p.substeps);
  }

  void add_free_body() {
    std::vector<PalmBearer> bearers;
    for (std::size_t k = 0; k < arms.size(); ++k)
      bearers.push_back({.body = arms[k]->body(),
                         .turning = [arm = arms[k].get()] { return arm->tool_turning(); },
                         .friction = p.arms[k].palm ? p.arms[k].palm->friction : 0});
    free_body = std::make_unique<FreeBody>(*p.free_body, std::move(bearers), scene, kStep / p.substeps);
  }

  /// The sheets go where the belt goes.
  void carry_sheets() {
    if (!belt) return;
    for (const auto& arm : arms) arm->carry_sheet(belt->T_UE().p - belt_start);
  }

  SimulatedArm& arm(int k) { return *arms.at(static_cast<std::size_t>(k)); }

  WorldParameters p;
  Scene scene;
  std::vector<std::unique_ptr<SimulatedArm>> arms;
  SimulatedArm* belt{};  // one of them; null: the sheets lie on tables
  Vector3 belt_start{Vector3::Zero()};
  std::unique_ptr<CubeBody> cube;
  std::unique_ptr<FreeBody> free_body;
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
  if (w.cube) w.cube->begin_step();
  if (w.free_body) w.free_body->begin_step();
  for (int substep = 0; substep < w.p.substeps; ++substep) {
    for (const auto& arm : w.arms) arm->push();
    if (w.cube) w.cube->push();
    if (w.free_body) w.free_body->push();
    w.scene.integrate(kStep / w.p.substeps);
    for (const auto& arm : w.arms) arm->follow();
    if (w.cube) w.cube->follow(1.0 / w.p.substeps);
    if (w.free_body) w.free_body->follow(1.0 / w.p.substeps);
  }
  w.carry_sheets();
  for (const auto& arm : w.arms) arm->end_step(w.steps);
  if (w.cube) w.cube->end_step();
  if (w.free_body) w.free_body->end_step();
}

const HardwareReading& World::reading(int arm) const { return impl_->arm(arm).reading(); }
std::int64_t World::steps() const { return impl_->steps; }
Hand& World::hand(int arm) { return impl_->arm(arm).hand(); }
const AxisVector& World::start_joints(int arm) const { return impl_->arm(arm).start_joints(); }
const ArmTruth& World::truth(int arm) const { return impl_->arm(arm).truth(); }
std::vector<LinkShape> World::shapes(int arm) const { return impl_->arm(arm).shapes(); }
const std::vector<InkPoint>& World::ink(int arm) const { return impl_->arm(arm).ink().points(); }
void World::set_object(int arm, double width) { impl_->arm(arm).set_object(width); }
const CubeTruth* World::cube() const { return impl_->cube ? &impl_->cube->truth() : nullptr; }
const FreeBodyTruth* World::free_body() const {
  return impl_->free_body ? &impl_->free_body->truth() : nullptr;
}
void World::set_face_friction(cube::Face face, const FaceFriction& friction) {
  if (impl_->cube) impl_->cube->set_friction(face, friction);
}
bool World::lay_cube(int axis) { return impl_->cube && impl_->cube->lay(axis); }
Pose World::effector(int arm) const { return impl_->arm(arm).T_UE(); }
void World::new_sheet(int arm) { impl_->arm(arm).ink().clear(); }

std::uint64_t World::state_hash() const {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a over 64-bit words
  const auto take = [&](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * kPrime; };
  for (const auto& arm : impl_->arms) arm->visit_state(take);
  if (impl_->cube) impl_->cube->visit_state(take);
  if (impl_->free_body) impl_->free_body->visit_state(take);
  return hash;
}

}  // namespace mrroc::sim
