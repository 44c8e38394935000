#include "tasks/rex_drive/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/camera_config.hpp"
#include "base/closest_match.hpp"
#include "base/room_config.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

namespace mrroc::rex_drive {
namespace {

std::int64_t macrosteps(double seconds) { return std::llround(seconds / kPlatformPeriod); }

LegCheck way_check(const Room& room) {
  return [room](const MapPoint& from, const MapPoint& to) {
    return obstruction(room, {from.x, from.y}, {to.x, to.y}, kReach);
  };
}

/// @param plan   number of a plan of the list
/// @param index  of its point, or behind its last one
/// @return the name of the point for the operator
std::string name_of(const PlanList& list, std::int64_t plan, std::int32_t index) {
  const MapPoints& points = list.plans[static_cast<std::size_t>(plan - 1)];
  const MapPoint& p = points[std::min(static_cast<std::size_t>(index), points.size() - 1)];
  const std::string line = p.line > 0 ? fmt::format(":{}", p.line) : "";
  return fmt::format("{}{}: ({:g}, {:g})", list.name, line, p.x, p.y);
}

/// Looks at the curves that are driven, which are not quite the legs. @throws FaultError  bad_plan
void check_ways(const PlanList& list, const PlannerSurvey& survey, const LegCheck& wrong_with) {
  for (const auto& [plan, t] : survey.found)
    for (std::size_t k = 1; k < t.knot.size(); ++k) {
      const PlanarPose &from = t.knot[k - 1].p, &to = t.knot[k].p;
      const std::string wrong = wrong_with({from.x, from.y}, {to.x, to.y});
      if (!wrong.empty())
        throw FaultError(FaultCode::bad_plan,
                         fmt::format("{}, the curve to this point: {}", name_of(list, plan, t.index), wrong),
                         "move the points into free space, or give more of them where the way turns");
    }
}

}  // namespace

double read_speed(const Config& config) {
  return config.number("task.speed", 0.6, {0.05, PathLimits{}.speed}, "m/s");
}

Parameters read_parameters(const Config& config) {
  // The grid of the platform's kernels is one of these macrosteps.
  std::ignore = config.number("time.dt", kPlatformPeriod / kPlatformSteps,
                              {kPlatformPeriod / kPlatformSteps, kPlatformPeriod / kPlatformSteps}, "s");
  std::ignore = config.integer("time.n_s", kPlatformSteps, {kPlatformSteps, kPlatformSteps}, "steps");
  const Config t = config.section("task");
  Parameters k;
  RouteLimits& route = k.planner.route;
  route.lateral = t.number("lateral", route.lateral, {0.05, k.planner.path.lateral}, "m/s^2, of curves");
  route.acceleration = t.number("acceleration", route.acceleration, {0.05, 2}, "m/s^2");
  route.turn_rate = t.number("turn_rate", route.turn_rate, {0.1, k.planner.path.turn_rate}, "rad/s");
  k.planner.planning =
      t.integer("planning", k.planner.planning, {0, 100}, "macrosteps that a fragment takes");
  k.planner.lead =
      t.number("lead", k.planner.lead, {0, 6}, "s before its end that a fragment asks for the next");
  if (k.planner.lead < k.planner.planning * kPlatformPeriod)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format(
            "task.lead: {:g} s before its end a fragment asks for the next one, which takes {:g} s to be "
            "planned; it would come too late to go on at speed",
            k.planner.lead, k.planner.planning * kPlatformPeriod),
        "make task.lead longer, or task.planning shorter");
  k.grip = t.number("grip", k.grip, {0.05, 1}, "share of the friction that a curve may need");
  k.lost = t.number("position_lost", k.lost, {0.01, 10}, "m, standard deviation");
  return k;
}

OntologyParameters read_ontology(const Config& config) {
  const Config t = config.section("task");
  OntologyParameters k;
  k.think = t.integer<std::int64_t>("think", k.think, {0, 10'000}, "macrosteps from an ack to the next plan");
  k.timeout = macrosteps(t.number("position_timeout", 30, {0, 3600}, "s, 0: for ever"));
  return k;
}

std::optional<link::SensorClock> read_eyes(const Config& config) {
  if (!config.flag("task.eyes", true)) return std::nullopt;
  const std::string left = config.text(std::string("odometry.") + kPlatform + ".left", std::nullopt);
  const CameraSetup camera = read_camera(config, left);
  if (camera.period % kPlatformSteps != 0)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("cameras.{}.period: the estimator needs pictures at macrosteps, which take {} steps; "
                    "{} is no multiple of that",
                    left, kPlatformSteps, camera.period));
  return link::SensorClock{camera.period, camera.latency};
}

PlanList read_plan_list(const Config& config) {
  const std::string plan = config.text("task.plan", "figure_eight");
  const auto names = built_in_plan_names();
  if (is_built_in(plan)) return built_in_plan(plan);
  if (std::filesystem::exists(plan)) return load_plans(plan);
  throw FaultError(FaultCode::bad_plan,
                   fmt::format("{}: there is no such file, nor a plan of this name{}", plan,
                               did_you_mean(std::filesystem::path(plan).filename().string(),
                                            WordSet(names.begin(), names.end()))),
                   fmt::format("give a file of points, or one of: {}", fmt::join(names, ", ")));
}

void examine_start(const PlanList& list, const Config& config) {
  check_start(list, way_check(read_room(config)));
}

Itinerary examine(const PlanList& list, const Config& config) {
  const LegCheck wrong_with = way_check(read_room(config));
  check_start(list, wrong_with);
  check_legs(list, wrong_with);
  Itinerary it;
  it.list = list;
  it.plans = to_messages(list, read_speed(config));
  const Parameters k = read_parameters(config);
  it.survey = survey(it.plans, list.start, k.planner);
  if (const auto& missed = it.survey.missed)
    throw FaultError(FaultCode::path_not_found,
                     fmt::format("{}: the planner finds no trajectory to this point",
                                 name_of(list, missed->plan, missed->point)));
  check_ways(list, it.survey, wrong_with);
  return it;
}

}  // namespace mrroc::rex_drive
