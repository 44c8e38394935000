#include "bench/arm_contact.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "edp/whole_arm.hpp"
#include "sim/engine.hpp"
#include "sim/start_joints.hpp"
#include "test/edp/contact_simulation.hpp"
#include "test/sim/link_mass.hpp"
#include "test/sim/pressing_arm.hpp"

namespace mrroc::bench {
namespace {

constexpr std::uint64_t kSeed = 24;    // of contacts that served no adjustment
constexpr std::size_t kProgress = 20;  // contacts between two lines
constexpr int kSubsteps = 8;           // integrations a step: 1 ms is too coarse beside springs of gears
constexpr double kLeast = 1e-4, kMost = 0.2;  // B that is looked at [s/kg]
constexpr double kRung = 1.25;                // between the gains B that are tried
constexpr double kPrecision = 0.03;           // of simulated limits
constexpr double kPress = 20;                 // [N]
constexpr double kPush = 4;                   // that the force is changed by when the tried law begins [N]
constexpr double kStill = 0.4;                // deviation below which encoders may keep a stable contact [N]

irb6::ArmParameters without_friction() {
  irb6::ArmParameters arm = irb6::kPostument;
  for (irb6::AxisTable& axis : arm.axes) axis.properties.servo.drive.friction = 0;
  return arm;
}

ArmContact random_contact(std::mt19937_64& random, Gears gears) {
  constexpr double kSlope = 0.15;  // of the sheet [rad]
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  ArmContact contact{sim::PressingArm::world_of_one()};
  contact.world.substeps = kSubsteps;
  sim::ArmParameters& arm = contact.world.arms[0];
  for (sim::MotorParameters& motor : arm.motors) motor.friction = 0;
  arm.paper.T_0P.p += Vector3(between(-0.1, 0.1), between(-0.1, 0.1), between(-0.05, 0.05));
  const Vector3 about(between(-kSlope, kSlope), between(-kSlope, kSlope), 0);
  arm.paper.T_0P.R =
      arm.paper.T_0P.R * Eigen::AngleAxisd(about.norm(), about.normalized()).toRotationMatrix();
  arm.paper.friction = 0;
  arm.sensor.force_noise = arm.sensor.torque_noise = 0;
  arm.paper.stiffness = std::exp(between(std::log(1e3), std::log(1e5)));
  arm.start_height = 0.001;
  contact.inertia = std::exp(between(std::log(2), std::log(40)));
  const double mode = between(8, 15);
  if (gears == Gears::elastic) arm.elasticity.frequency = mode;
  return contact;
}

/// How the force of an arm goes on after the tried law has begun.
class Watch {
 public:
  void add(double force) {
    sum_ += force;
    squares_ += force * force;
    ++n_;
    away_ = away_ || std::abs(force - kPress) > 0.75 * kPress;
  }
  /// Looks at what follows only. @return standard deviation of what was before [N]
  double turn() {
    const double mean = sum_ / n_;
    const double deviation = std::sqrt(std::max(0.0, squares_ / n_ - mean * mean));
    sum_ = squares_ = n_ = 0;
    return deviation;
  }
  /// @return whether contact is broken, or nearly
  [[nodiscard]] bool away() const { return away_; }

 private:
  bool away_{};
  double sum_{}, squares_{}, n_{};
};

/// @return whether what a push leaves grows, in the real driver @param soft  B that is stable [s/kg]
bool swings(const ArmContact& contact, double B, double soft) {
  constexpr int kSoft = 80, kThird = 60;  // macrosteps
  edp::DriverParameters p = sim::PressingArm::driver_parameters();
  p.oscillation.softest = 1;  // the law as it is commanded
  p.oscillation.force = p.oscillation.torque = std::numeric_limits<double>::infinity();
  p.limits.linear_velocity = 10;  // B F_d in free motion; nothing is free here
  p.force.stuck_after = 0;        // readings come without noise
  sim::PressingArm arm(contact.world, p, 1, without_friction());
  arm.prepare();
  const auto press = [&](double force, double mobility) {
    return arm.move({u(), u(), c(force, contact.inertia, mobility), u(), u(), u()});
  };
  for (int k = 0; k < kSoft; ++k) press(kPress - kPush, soft);
  Watch watch;
  arm.after_each_step = [&] { watch.add(arm.force()); };
  double before = 0, late = 0;
  for (int third = 0; third < 3; ++third) {
    for (int k = 0; k < kThird; ++k)
      if (press(kPress, B).fault.code != FaultCode::none || watch.away()) return true;
    before = std::exchange(late, watch.turn());
  }
  return late > std::max(before, kStill);
}

double predicted_limit(const ArmContact& contact) {
  edp::ContactLoop loop = believed_loop(contact);
  return edp::test::first_limit(kLeast, kMost, 1e-3, [&](double B) {
    loop.mobility = B;
    return edp::contact_mode(loop, contact.world.arms[0].paper.stiffness).radius >= 1;
  });
}

/// At most seven rungs from half to twice the predicted limit, and three halvings of what lies between two of them.
double simulated_limit(const ArmContact& contact, double predicted) {
  const double soft = predicted / 5;
  for (double B = predicted / 2; B <= 2 * predicted; B *= kRung)
    if (swings(contact, B, soft))
      return edp::test::limit_between(B / kRung, B, kPrecision,
                                      [&](double tried) { return swings(contact, tried, soft); });
  return std::numeric_limits<double>::infinity();
}

}  // namespace

edp::ContactLoop believed_loop(const ArmContact& contact) {
  const sim::ArmParameters& arm = contact.world.arms[0];
  const irb6::Arm robot(without_friction());
  edp::ArmBelief belief;
  belief.joints = sim::start_joints(arm);
  belief.T_WE = arm.type->driver.T_WE;
  belief.normal = (robot.forward(belief.joints) * belief.T_WE).R.transpose() * -arm.paper.T_0P.R.col(2);
  belief.rotors.resize(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    belief.rotors[k] = arm.type->motors[static_cast<std::size_t>(k)].rotor_inertia;
  belief.mass = sim::link_mass(
      sim::read_chain(arm.type->urdf, sim::lengths_of(*arm.type, 0), AxisVector::Zero(robot.axes())),
      belief.joints);
  belief.tool = arm.type->driver.tool_weight / sim::kGravity;
  belief.tool_centre = Eigen::Map<const Vector3>(robot.parameters().tool_mass_centre.data());
  return {.inertia = contact.inertia,
          // Engines take contact implicitly: its force is that of the end of an integration.
          .contact_damping = arm.paper.damping_ratio + sim::kStep / contact.world.substeps / 2,
          .servo = edp::whole_arm(robot, belief),
          .gears = {.frequency = arm.elasticity.frequency, .damping = arm.elasticity.damping}};
}

std::vector<ArmLimit> arm_limits(sim::PhysicsEngine engine, Gears gears, const char* name,
                                 std::size_t contacts) {
  std::mt19937_64 random(kSeed);
  std::vector<ArmLimit> limits;
  while (limits.size() < contacts) {
    ArmContact contact = random_contact(random, gears);
    contact.world.engine = engine;
    const double predicted = predicted_limit(contact);
    if (predicted < 2 * kLeast || predicted > kMost / 2) continue;
    const sim::ArmParameters& arm = contact.world.arms[0];
    limits.push_back({arm.paper.stiffness, contact.inertia, arm.elasticity.frequency, predicted,
                      simulated_limit(contact, predicted)});
    if (limits.size() % kProgress == 0)
      fmt::print(stderr, "stability: {}, {} of {}\n", name, limits.size(), contacts);
  }
  return limits;
}

}  // namespace mrroc::bench
