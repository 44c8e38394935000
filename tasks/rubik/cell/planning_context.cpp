#include "tasks/rubik/cell/planning_context.hpp"

#include <cstdint>

#include "tasks/rubik/cell/cell_settings.hpp"
#include "tasks/rubik/cell/cube_camera.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/config.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kThreads = 2;  // that make tables

// The same in every run, so that nodes are counted, not time.
constexpr std::uint64_t kShortestNodes = 1'000'000;  // five times what 40 cubes of 14 turns needed at most
constexpr std::uint64_t kTwoPhaseNodes = 3'000'000;

}  // namespace

RunSetup read_setup(const Config& config) {
  RunSetup s;
  s.belief = read_belief(config);
  check_synchro(config);
  s.k = read_parameters(config);
  s.tables = config.choice(
      "task.tables", TableSet::standard,
      {{"small", TableSet::small}, {"default", TableSet::standard}, {"large", TableSet::large}});
  for (std::size_t arm = 0; arm < kArms; ++arm)
    read_motion_limits(config, kArmKeys[arm], static_cast<int>(s.belief.arms[arm].start.size()));
  const std::string camera = cube_camera().key;
  if (config.has("cameras." + camera + ".pose")) s.camera = read_camera(config, camera);
  return s;
}

PlanningContext::PlanningContext(const RunSetup& s)
    : belief_(s.belief),
      camera_(s.camera),
      planning_(belief_, camera_ ? std::optional(viewing_place()) : std::nullopt),
      solver_(s.tables, table_folder(), kThreads, progress_.watch()) {}

Solution PlanningContext::solve(const Cube& cube) const {
  return solver_.solve(cube, {.shortest = {.nodes = kShortestNodes}, .two_phase = {.nodes = kTwoPhaseNodes}});
}

Planned PlanningContext::plan_reading(const PlanStart& start, int reading) {
  if (reading == 0) return planning_.planner.make_reading_plan(start);
  return Planning(belief_, viewing_place(reading)).planner.make_reading_plan(start);
}

PlannerServices PlanningContext::services() {
  PlannerServices services;
  services.camera = camera_;
  if (!camera_) services.known = belief_.known;
  services.start.grasp = belief_.grasp;
  services.start.joints = {belief_.arms[0].start, belief_.arms[1].start};
  services.solve = [this](const Cube& cube) { return solve(cube); };
  services.plan = [this](const PlanStart& start, const Moves& moves, const BlockedDirections& blocked) {
    PlanOptions options;
    options.blocked = blocked;
    return planning_.planner.make_plan(start, moves, options);
  };
  services.plan_reading = [this](const PlanStart& start, int reading) {
    return plan_reading(start, reading);
  };
  return services;
}

}  // namespace mrroc::rubik
