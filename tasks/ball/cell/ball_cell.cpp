#include "tasks/ball/cell/ball_cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "edp/guard.hpp"
#include "robots/catalogue.hpp"
#include "sim/config.hpp"
#include "sim/free_body_config.hpp"
#include "tasks/ball/config.hpp"
#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

constexpr std::array<const char*, kArms> kKeys{"arm1", "arm2"};
constexpr std::array<const char*, kArms> kModels{"irb6_postument", "irb6_track"};
constexpr int kPlaces = 32;  // of the circle that are tried

/// An arm as everybody believes it.
struct BelievedArm {
  const robots::RobotType* type;
  std::unique_ptr<edp::Robot> robot;
  Pose T_UB, T_WE;
};

BelievedArm read_arm(const Config& config, std::size_t arm) {
  BelievedArm a;
  a.type = &robots::read_type(config, kKeys[arm], robots::catalogue(), kModels[arm]);
  a.robot = robots::read_robot(config, kKeys[arm], *a.type);
  a.T_UB = robots::read_place(config, kKeys[arm], "cell", *a.type);
  a.T_WE = a.type->driver.T_WE;
  return a;
}

[[noreturn]] void refuse(std::size_t arm, const Vector3& p, const std::string& why) {
  throw FaultError(FaultCode::bad_configuration,
                   fmt::format("{} is to put its palm at ({:.3f}, {:.3f}, {:.3f}) m: {}", kKeys[arm], p.x(),
                               p.y(), p.z(), why),
                   "move free_body.pedestal, or make task.radius or task.lift smaller");
}

AxisVector usual_joints(const BelievedArm& a) {
  return Eigen::Map<const Eigen::VectorXd>(a.type->start.data(),
                                           static_cast<Eigen::Index>(a.type->start.size()));
}

/// @return joints with the palm there, near those of a place before
AxisVector joints_at(const BelievedArm& a, std::size_t arm, const Vector3& p_U, const AxisVector& near) {
  const Pose T_UE{palm_orientation(arm), p_U};
  const edp::InverseSolution s = a.robot->inverse(a.T_UB.inverse() * T_UE * a.T_WE.inverse(), near);
  if (!s.reached) refuse(arm, p_U, "it does not reach that");
  const edp::AxisPositions to{s.joints, a.robot->motors_from_joints(s.joints)};
  // From where it may stand: from beyond a limit the way back would be legal.
  const AxisVector usual = usual_joints(a);
  const edp::AxisPositions from{usual, a.robot->motors_from_joints(usual)};
  if (const auto fault = edp::check_range(*a.robot, from, to, 0)) refuse(arm, p_U, describe(*fault));
  return s.joints;
}

/// @param out  distance of the palm from the middle of the object [m]
Vector3 palm_place(const Parameters& k, std::size_t arm, double out) {
  return k.body.pedestal + k.body.size / 2 * Vector3::UnitZ() + (arm == 0 ? out : -out) * kLine;
}

double out_at_start(const Parameters& k) { return k.body.size / 2 + k.gap; }

/// The palms stand where an object as it is told leaves room for them: a larger one would begin inside them.
void check_room(const Config& config, const Parameters& k) {
  const auto true_body = sim::read_true_body(config);
  if (!true_body) return;
  const double aside = std::abs((true_body->pedestal - k.body.pedestal).dot(kLine));
  const double most = 2 * (out_at_start(k) - aside);
  if (true_body->size < most) return;
  throw FaultError(
      FaultCode::bad_configuration,
      fmt::format("sim.free_body.size: {:g} m do not fit between the palms, which begin {:.3g} m apart{}",
                  true_body->size, 2 * out_at_start(k),
                  aside > 0 ? fmt::format(" and {:.3g} m beside the object", aside) : ""),
      fmt::format("take less than {:.3g} m, or tell of a larger object by free_body.size (0.3 m at most)",
                  most));
}

/// The whole way of the palm.
void check_reach(const Parameters& k, const BelievedArm& a, std::size_t arm) {
  AxisVector near = joints_at(a, arm, palm_place(k, arm, out_at_start(k)), usual_joints(a));
  const double least = (1 - k.size_tolerance) * k.body.size / 2;
  for (const double out : {out_at_start(k), least})
    for (int m = kLift; m <= kCircle; ++m)
      for (int n = 0; n <= kPlaces; ++n)
        near = joints_at(a, arm, palm_place(k, arm, out) + path(k, m, n * duration(k, m) / kPlaces), near);
}

}  // namespace

void complete_start(Config& config) {
  const Parameters k = read_parameters(config);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const std::string key = fmt::format("robots.{}.start_joints", kKeys[arm]);
    if (config.has(key)) continue;
    const BelievedArm a = read_arm(config, arm);
    const AxisVector q = joints_at(a, arm, palm_place(k, arm, out_at_start(k)), usual_joints(a));
    config.set(fmt::format("{}=[{:.6f}]", key, fmt::join(q.data(), q.data() + q.size(), ", ")));
  }
}

Parameters read_setup(const Config& config) {
  Parameters k = read_parameters(config);
  check_room(config, k);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const BelievedArm a = read_arm(config, arm);
    k.T_UB[arm] = a.T_UB;
    check_reach(k, a, arm);
  }
  return k;
}

Vector3 force_in_sheet(const Config& config, const HandPush& push) {
  const sim::WorldParameters world = sim::read_world(config);
  const sim::ArmParameters& arm = world.arms.at(push.arm);
  return (arm.T_UB * arm.paper.T_0P).R.transpose() * push.force;
}

}  // namespace mrroc::ball
