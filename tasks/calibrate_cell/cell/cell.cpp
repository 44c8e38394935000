#include "tasks/calibrate_cell/cell/cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "base/artefact.hpp"
#include "base/camera_config.hpp"
#include "robots/catalogue.hpp"
#include "sim/camera/config.hpp"
#include "sim/config.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/believed_arm.hpp"
#include "tasks/calibrate_cell/cell/view_plan.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr double kReadyDistance = 0.1;  // of the tip from the nearest ball, before the search begins [m]

Bases read_bases(const Config& config) {
  Bases bases;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto& type = robots::read_type(config, kKeys[arm], robots::catalogue(), kModels[arm]);
    bases[arm] = robots::read_place(config, kKeys[arm], "cell", type);
  }
  return bases;
}

std::vector<sim::SimulatedCamera> read_cameras(const Config& config) {
  return sim::read_camera_world(config, {kKeys.begin(), kKeys.end()}, {}).cameras;
}

ArtefactDescription artefact_of(const Config& config) {
  const auto artefact = read_artefact(config);
  if (!artefact) throw FaultError(FaultCode::bad_configuration, "artefact.balls: there is nothing to touch");
  return *artefact;
}

/// @return joints with the front of the tip there
AxisVector joints_at(const BelievedArm& a, std::size_t arm, const Vector3& p_U) {
  const Reach r = reach(a, {a.R_UE, p_U}, a.usual_joints());
  if (r.why.empty()) return r.joints;
  throw FaultError(FaultCode::bad_configuration,
                   fmt::format("{} is to put its tip at ({:.3f}, {:.3f}, {:.3f}) m: {}", kKeys[arm], p_U.x(),
                               p_U.y(), p_U.z(), r.why),
                   "move artefact.place or artefact.balls");
}

/// Before all balls, in the middle of them.
Vector3 ready_place(const BelievedArm& a, const ArtefactDescription& artefact) {
  const Vector3 z = a.R_UE.col(2);
  Vector3 middle = Vector3::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3& ball : artefact.balls) {
    const Vector3 p = artefact.T_UA * ball;
    middle += p / static_cast<double>(artefact.balls.size());
    nearest = std::min(nearest, p.dot(z));
  }
  return middle + (nearest - artefact.diameter / 2 - kReadyDistance - middle.dot(z)) * z;
}

}  // namespace

Bases believed_bases(const Config& config) { return read_bases(config); }
Bases true_bases(const Config& config) {
  const sim::WorldParameters world = sim::read_world(config);
  return {world.arms.at(0).T_UB, world.arms.at(1).T_UB};
}

Pose true_camera(const Config& config, const std::string& key) {
  const auto cameras = read_cameras(config);
  const auto camera =
      std::ranges::find(cameras, key, [](const sim::SimulatedCamera& c) { return c.setup.key; });
  return camera->setup.place * camera->error;
}

std::array<ViewPlan, kArms> views_of(const Config& config) {
  return {read_views(config, kKeys[0]), read_views(config, kKeys[1])};
}

SetNumbers true_sets(const Config& config) {
  const sim::WorldParameters world = sim::read_world(config);
  SetNumbers sets{};
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto& type = robots::read_type(config, kKeys[arm], robots::catalogue(), kModels[arm]);
    sets[arm] = world.arms.at(arm).model % std::max(1, static_cast<int>(type.parameter_sets.size()));
  }
  return sets;
}

namespace {

void set_joints(Config& config, const std::string& key, const std::vector<double>& joints) {
  config.set(fmt::format("{}=[{:.6f}]", key, fmt::join(joints, ", ")));
}

std::vector<double> one_list(const std::vector<std::vector<double>>& poses) {
  std::vector<double> all;
  for (const auto& q : poses) all.insert(all.end(), q.begin(), q.end());
  return all;
}

/// Reads all cameras that are described, so that those which do not take part are no errors; without pictures none does.
void choose_cameras(Config& config) {
  const std::vector<std::string> order =
      read_ways(config).board ? camera_keys(config) : std::vector<std::string>{};
  std::vector<std::string> all;
  for (const std::string& key : config.tables("cameras"))
    if (config.has("cameras." + key + ".pose")) all.push_back(key);
  const auto set = [&](const std::vector<std::string>& keys) {
    config.set(keys.empty() ? "cameras.order=[]"
                            : fmt::format("cameras.order=[\"{}\"]", fmt::join(keys, "\", \"")));
  };
  set(all);
  std::ignore = read_cameras(config);
  set(order);
}

/// What arms do for the pictures, unless it is told.
void complete_views(Config& config) {
  choose_cameras(config);
  if (camera_keys(config).empty()) return;
  const auto wanted = config.integer<std::size_t>("task.views", 20, {8, 200}, "poses of each turn");
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const std::string key = fmt::format("task.{}.", kKeys[arm]);
    if (config.has(key + "stand")) continue;
    const ViewPlan plan = plan_views(config, arm, wanted);
    set_joints(config, key + "stand", plan[0].from);
    set_joints(config, key + "views", one_list(plan[0].joints));
    if (arm == kBoardArm) {
      set_joints(config, key + "present", one_list(plan[1].joints));
    } else {
      set_joints(config, key + "risen", plan[1].from);
      set_joints(config, key + "aside", plan[2].from);
    }
  }
}

}  // namespace

void complete(Config& config) {
  const ArtefactDescription artefact = artefact_of(config);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const BelievedArm a = read_arm(config, arm);
    std::vector<double> balls;
    for (const Vector3& ball : artefact.balls) {
      const Vector3 p = a.T_UB.inverse() * (artefact.T_UA * ball);
      balls.insert(balls.end(), p.data(), p.data() + 3);
    }
    set_joints(config, fmt::format("task.{}.balls", kKeys[arm]), balls);
    const std::string key = fmt::format("robots.{}.start_joints", kKeys[arm]);
    if (config.has(key)) continue;
    const AxisVector q = joints_at(a, arm, ready_place(a, artefact));
    set_joints(config, key, {q.begin(), q.end()});
  }
  complete_views(config);
}

void check_reach(const Config& config) {
  const ArtefactDescription artefact = artefact_of(config);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const BelievedArm a = read_arm(config, arm);
    const ProbePlan plan = read_plan(config, kKeys[arm]);
    const double away = plan.ball_radius + plan.tip_radius + plan.wide_gap + plan.beyond;
    for (const Vector3& ball : artefact.balls)
      for (const Direction& d : kDirections)
        std::ignore = joints_at(a, arm, artefact.T_UA * ball - away * in_base(d, a.R_UE));
  }
}

}  // namespace mrroc::calibrate_cell
