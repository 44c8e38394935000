#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "base/artefact.hpp"
#include "base/representation.hpp"
#include "ecp/preparation.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/figures.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr std::ptrdiff_t kTurning = 6;  // axes of an arm behind its track, which weighing turns
constexpr double kTrackSpeed = 0.6;     // [m/s] of which the arm goes with a part

ecp::WeighingPlan read_weighing(const Config& task, const RobotModel& model,
                                const std::vector<double>& ready) {
  const auto joints = [&](std::string_view key) {
    const auto q = task.numbers<kTurning>(key, std::nullopt, {-7, 7}, "rad, of the six axes that turn");
    ecp::Coordinates all =
        Eigen::Map<const Eigen::VectorXd>(ready.data(), static_cast<Eigen::Index>(ready.size()));
    all.tail<kTurning>() = Eigen::Map<const Vector6>(q.data());
    return all;
  };
  ecp::WeighingPlan plan;
  plan.down = joints("down");
  plan.up = joints("up");
  plan.side = joints("side");
  plan.limits = ecp::default_limits(Representation::joints, static_cast<int>(ready.size()));
  if (plan.limits.velocity.size() > kTurning) plan.limits.velocity[0] = kTrackSpeed;
  plan.readings = task.integer("weighing_readings", plan.readings, {10, 1000}, "macrosteps");
  plan.T_WE = pose_from_numbers(model.tool_representation, model.tool).value_or(Pose{});
  return plan;
}

/// Joints of poses, one after another in a list.
std::vector<std::vector<double>> read_poses(const Config& t, std::string_view key, std::size_t axes) {
  const auto all =
      t.list(key, std::vector<double>{}, {-10, 10}, "rad, m, joints of poses, found by the task");
  if (all.size() % axes != 0)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("task.ARM.{}: {} joints for each pose", key, axes));
  std::vector<std::vector<double>> poses;
  for (auto first = all.begin(); first != all.end(); first += static_cast<std::ptrdiff_t>(axes))
    poses.emplace_back(first, first + static_cast<std::ptrdiff_t>(axes));
  return poses;
}

}  // namespace

Ways read_ways(const Config& config) {
  return config.choice<Ways>("task.ways", {true, true},
                             {{"touch", {true, false}}, {"board", {false, true}}, {"both", {true, true}}});
}

ViewPlan read_views(const Config& config, const std::string& arm) {
  if (!read_ways(config).board) return {};
  const Config t = config.section("task").section(arm);
  const auto stand = t.list("stand", std::vector<double>{}, {-10, 10}, "rad, m, found by the task");
  if (stand.empty()) return {};
  const auto views = read_poses(t, "views", stand.size());
  if (arm == kKeys[kBoardArm])
    return {{Turn::show, stand, views},
            {Turn::present, stand, read_poses(t, "present", stand.size())},
            {Turn::leave, stand, {}}};
  const auto place = [&](std::string_view key) {
    return t.list(key, stand, {-10, 10}, "rad, m, found by the task", stand.size());
  };
  return {
      {Turn::look, stand, views}, {Turn::rise, place("risen"), {}}, {Turn::make_room, place("aside"), {}}};
}

ProbePlan read_plan(const Config& config, const std::string& arm) {
  ProbePlan p;
  const auto artefact = read_artefact(config);
  if (!artefact) throw FaultError(FaultCode::bad_configuration, "artefact.balls: there is nothing to touch");
  p.ball_radius = artefact->diameter / 2;
  const Config t = config.section("task");
  const auto numbers = t.list(arm + ".balls", std::nullopt, {-10, 10},
                              "m, in the arm's base, found by the task", 3 * artefact->balls.size());
  for (std::size_t k = 0; k < numbers.size(); k += 3)
    p.balls.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  p.tip_radius = t.number("tip_radius", p.tip_radius, {0.001, 0.05}, "m");
  p.wide_gap = t.number("wide_gap", p.wide_gap, {0.005, 0.1}, "m, left to a ball that is believed");
  p.narrow_gap = t.number("narrow_gap", p.narrow_gap, {0.003, 0.1}, "m, left to a ball that was found");
  p.beyond = t.number("beyond", p.beyond, {0.001, 0.1}, "m, how far beyond its surface a ball is looked for");
  p.speed = t.number("speed", p.speed, {0.001, 0.05}, "m/s, of a touch");
  p.force = t.number("force", p.force, {0.5, 10}, "N, at which a touch settles");
  p.settling = t.integer("settling", p.settling, {0, 500}, "macrosteps in contact before the pose is read");
  p.readings = t.integer("readings", p.readings, {1, 500}, "macrosteps over which it is averaged");
  return p;
}

Memory read_memory(const Config& config, const std::string& arm) {
  Memory c;
  c.plan = read_plan(config, arm);
  c.views = read_views(config, arm);
  if (read_ways(config).touch)
    c.touch_turn =
        static_cast<int>(Turn::touch) + static_cast<int>(std::ranges::find(kKeys, arm) - kKeys.begin());
  c.ready = config.section("robots." + arm).list("start_joints", std::vector<double>{}, {-10, 10}, "rad, m");
  if (std::ssize(c.ready) < kTurning)
    throw FaultError(FaultCode::bad_configuration, "robots." + arm + ".start_joints: this task needs them");
  c.weighing.plan = read_weighing(config.section("task"), ecp::read_tool_model(config, arm), c.ready);
  return c;
}

}  // namespace mrroc::calibrate_cell
