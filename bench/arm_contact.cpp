#include "bench/arm_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "edp/whole_arm.hpp"
#include "sim/engine.hpp"
#include "sim/start_joints.hpp"
#include "test/edp/contact_simulation.hpp"
#include "test/sim/link_mass.hpp"
#include "test/sim/pressing_arm.hpp"

namespace mrroc::bench {
namespace {

constexpr int kContacts = 100;
constexpr double kLeast = 1e-4, kMost = 0.2;  // B that is looked at [s/kg]
constexpr double kPrecision = 0.02;           // of simulated limits
constexpr double kPress = 20;                 // [N]
constexpr double kPush = 2;                   // that the force is changed by when the tried law begins [N]
constexpr double kSwings = 1.5;               // deviation from which the force has not settled [N]

/// One contact of the arm.
struct ArmContact {
  sim::WorldParameters world;
  double inertia{};  // I of law (28) [kg]
};

irb6::ArmParameters without_friction() {
  irb6::ArmParameters arm = irb6::kPostument;
  for (irb6::AxisTable& axis : arm.axes) axis.properties.servo.drive.friction = 0;
  return arm;
}

template <class Random>
ArmContact random_contact(Random& random, bool elastic) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  ArmContact contact{sim::PressingArm::world_of_one()};
  sim::ArmParameters& arm = contact.world.arms[0];
  for (sim::MotorParameters& motor : arm.motors) motor.friction = 0;
  arm.paper.T_0P.p += Vector3(between(-0.1, 0.1), between(-0.1, 0.1), between(-0.05, 0.05));
  arm.paper.friction = 0;
  arm.paper.stiffness = std::exp(between(std::log(2e3), std::log(1e5)));
  arm.start_height = 0.001;
  if (elastic) arm.elasticity.frequency = between(8, 15);
  contact.inertia = std::exp(between(std::log(2), std::log(40)));
  return contact;
}

/// @return the loop as a controller may believe it, without B
edp::ContactLoop believed(const ArmContact& contact) {
  const sim::ArmParameters& arm = contact.world.arms[0];
  const irb6::Arm robot(without_friction());
  edp::ArmBelief belief;
  belief.joints = sim::start_joints(arm);
  belief.T_WE = arm.type->driver.T_WE;
  belief.rotors.resize(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    belief.rotors[k] = arm.type->motors[static_cast<std::size_t>(k)].rotor_inertia;
  belief.mass = sim::link_mass(
      sim::read_chain(arm.type->urdf, sim::lengths_of(*arm.type, 0), AxisVector::Zero(robot.axes())),
      belief.joints);
  belief.tool = arm.type->driver.tool_weight / sim::kGravity;
  belief.tool_centre = Eigen::Map<const Vector3>(robot.parameters().tool_mass_centre.data());
  return {.inertia = contact.inertia,
          .contact_damping = arm.paper.damping_ratio,
          .servo = edp::whole_arm(robot, belief),
          .gears = {.frequency = arm.elasticity.frequency, .damping = arm.elasticity.damping}};
}

/// @return whether the real driver keeps swinging after a push @param soft  B that is stable [s/kg]
bool swings(const ArmContact& contact, double B, double soft) {
  edp::DriverParameters p = sim::PressingArm::driver_parameters();
  p.oscillation.force = p.oscillation.torque = std::numeric_limits<double>::infinity();
  sim::PressingArm arm(contact.world, p, 1, without_friction());
  arm.prepare();
  const auto press = [&](double force, double B_z) {
    return arm.move({u(), u(), c(force, contact.inertia, B_z), u(), u(), u()});
  };
  for (int k = 0; k < 80; ++k) press(kPress - kPush, soft);
  double squares = 0, n = 0;
  bool late = false, away = false;
  arm.after_each_step = [&] {
    const double off = arm.force() - kPress;
    away = away || std::abs(off) > 0.75 * kPress;
    if (!late) return;
    squares += off * off;
    ++n;
  };
  for (int k = 0; k < 150 && !away; ++k) {
    late = k >= 120;
    press(kPress, B);
  }
  return away || std::sqrt(squares / n) > kSwings;
}

double predicted_limit(const ArmContact& contact) {
  edp::ContactLoop loop = believed(contact);
  return edp::test::first_limit(kLeast, kMost, 1e-3, [&](double B) {
    loop.mobility = B;
    return edp::contact_mode(loop, contact.world.arms[0].paper.stiffness).radius >= 1;
  });
}

}  // namespace

std::vector<double> arm_limit_errors(sim::PhysicsEngine engine, bool elastic) {
  std::mt19937_64 random(4);
  std::vector<double> errors;
  while (errors.size() < kContacts) {
    ArmContact contact = random_contact(random, elastic);
    contact.world.engine = engine;
    const double predicted = predicted_limit(contact);
    if (predicted < 2 * kLeast || predicted > kMost / 2) continue;
    const double simulated = edp::test::first_limit(predicted / 2, predicted * 2, kPrecision, [&](double B) {
      return swings(contact, B, predicted / 5);
    });
    errors.push_back(100 * std::abs(predicted / simulated - 1));
  }
  return errors;
}

Figures arm_limit_figures() {
  const auto worst = [](const char* key, sim::PhysicsEngine engine, bool elastic, const char* about) {
    return Figure{key, std::ranges::max(arm_limit_errors(engine, elastic)), "%", about};
  };
  Figures figures{worst("arm_limit_err_bullet_pct", sim::PhysicsEngine::bullet, false,
                        "predicted limit of the gain B of the whole arm against the real driver in the "
                        "world, without friction, worst of 100 random contacts")};
  if (sim::has_mujoco())
    figures.push_back(
        worst("arm_limit_err_mujoco_pct", sim::PhysicsEngine::mujoco, false, "the same in MuJoCo"));
  figures.push_back(worst("arm_limit_err_elastic_pct", sim::PhysicsEngine::bullet, true,
                          "the same in Bullet with elastic gears of 8 to 15 Hz"));
  return figures;
}

}  // namespace mrroc::bench
