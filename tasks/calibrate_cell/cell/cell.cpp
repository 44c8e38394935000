#include "tasks/calibrate_cell/cell/cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <tuple>

#include "base/artefact.hpp"
#include "edp/guard.hpp"
#include "robots/catalogue.hpp"
#include "sim/config.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"

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

/// An arm as everybody believes it.
struct BelievedArm {
  const robots::RobotType* type;
  std::unique_ptr<edp::Robot> robot;
  Pose T_U0;
  Matrix3 R_UE;  ///< with which it touches: x up, z level to the other arm
};

BelievedArm read_arm(const Config& config, std::size_t arm) {
  BelievedArm a;
  a.type = &robots::read_type(config, kKeys[arm], robots::catalogue(), kModels[arm]);
  a.robot = robots::read_robot(config, kKeys[arm], *a.type);
  const Bases bases = believed_bases(config);
  a.T_U0 = bases[arm];
  Vector3 line = bases[1 - arm].p - bases[arm].p;
  line.z() = 0;
  a.R_UE.col(0) = Vector3::UnitZ();
  a.R_UE.col(2) = line.normalized();
  a.R_UE.col(1) = a.R_UE.col(2).cross(a.R_UE.col(0));
  return a;
}

ArtefactDescription artefact_of(const Config& config) {
  const auto artefact = read_artefact(config);
  if (!artefact) throw FaultError(FaultCode::bad_configuration, "artefact.balls: there is nothing to touch");
  return *artefact;
}

AxisVector usual_joints(const BelievedArm& a) {
  return Eigen::Map<const Eigen::VectorXd>(a.type->start.data(),
                                           static_cast<Eigen::Index>(a.type->start.size()));
}

/// @return joints with the front of the tip there
AxisVector joints_at(const BelievedArm& a, std::size_t arm, const Vector3& p_U) {
  const Vector3& p = p_U;
  const auto refuse = [&](const std::string& why) {
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("{} is to put its tip at ({:.3f}, {:.3f}, {:.3f}) m: {}", kKeys[arm], p.x(),
                                 p.y(), p.z(), why),
                     "move artefact.place or artefact.balls");
  };
  const AxisVector usual = usual_joints(a);
  const Pose T_0W = a.T_U0.inverse() * Pose{a.R_UE, p_U} * a.type->driver.T_WE.inverse();
  const edp::InverseSolution s = a.robot->inverse(T_0W, usual);
  if (!s.reached) refuse("it does not reach that");
  const edp::AxisPositions to{s.joints, a.robot->motors_from_joints(s.joints)};
  const edp::AxisPositions from{usual, a.robot->motors_from_joints(usual)};
  if (const auto fault = edp::check_range(*a.robot, from, to, 0)) refuse(describe(*fault));
  return s.joints;
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

SetNumbers true_sets(const Config& config) {
  const sim::WorldParameters world = sim::read_world(config);
  SetNumbers sets{};
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto& type = robots::read_type(config, kKeys[arm], robots::catalogue(), kModels[arm]);
    sets[arm] = world.arms.at(arm).model % std::max(1, static_cast<int>(type.parameter_sets.size()));
  }
  return sets;
}

void complete(Config& config) {
  const ArtefactDescription artefact = artefact_of(config);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const BelievedArm a = read_arm(config, arm);
    std::vector<double> balls;
    for (const Vector3& ball : artefact.balls) {
      const Vector3 p = a.T_U0.inverse() * (artefact.T_UA * ball);
      balls.insert(balls.end(), p.data(), p.data() + 3);
    }
    config.set(fmt::format("task.{}.balls=[{:.6f}]", kKeys[arm], fmt::join(balls, ", ")));
    const std::string key = fmt::format("robots.{}.start_joints", kKeys[arm]);
    if (config.has(key)) continue;
    const AxisVector q = joints_at(a, arm, ready_place(a, artefact));
    config.set(fmt::format("{}=[{:.6f}]", key, fmt::join(q.data(), q.data() + q.size(), ", ")));
  }
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
