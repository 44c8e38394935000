#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/statistics.hpp"
#include "test/rig/engines.hpp"
#include "test/sim/driver.hpp"
#include "test/sim/pressing_arm.hpp"

namespace mrroc::sim {
namespace {

constexpr int kLeftOut = 100;  // the first 0.2 s of a stroke

// Both pens on the paper under 1 N, at rest.
class Sliding : public testing::Test {
 public:
  explicit Sliding(PhysicsEngine engine = {}) : cell_(cell_of(engine)) {}

 protected:
  static WorldParameters cell_of(PhysicsEngine engine) {
    WorldParameters p = rig::irb6_cell();
    p.engine = engine;
    return p;
  }
  void SetUp() override {
    cell_.prepare();
    press(g(0.01, 20, 0.005), 1800);
    press(c(1, 20, 0.005), 500);
  }
  void press(const AxisCommand& z, int steps) {
    for (Driver& driver : cell_.drivers) driver.command.z = z;
    cell_.run(steps);
  }
  void slide(double x, double y) {
    for (Driver& driver : cell_.drivers) {
      driver.command.x = u(x);
      driver.command.y = u(y);
    }
  }

  Cell cell_;
};

class SlidingOnAnyEngine : public Sliding, public testing::WithParamInterface<PhysicsEngine> {
 public:
  SlidingOnAnyEngine() : Sliding(GetParam()) {}
};
INSTANTIATE_TEST_SUITE_P(Engines, SlidingOnAnyEngine, testing::ValuesIn(rig::engines()), rig::engine_name);

TEST_P(SlidingOnAnyEngine, IsResistedByTheFrictionOfThePaperAgainstTheMotion) {
  constexpr double kSpeed = 0.02, kFriction = 0.2;
  for (int direction = 0; direction < 8; ++direction) {
    const double angle = direction * std::numbers::pi / 4;
    const double x = std::cos(angle), y = std::sin(angle);
    slide(kSpeed * x, kSpeed * y);
    cell_.run(kLeftOut);
    Statistics along, across;
    cell_.run(500, [&] {
      const Wrench& force = cell_.drivers[0].force();  // of the pen on the paper
      along.add(force[Axis::x] * x + force[Axis::y] * y);
      across.add(force[Axis::y] * x - force[Axis::x] * y);
    });
    EXPECT_NEAR(along.mean(), kFriction, 0.03) << angle;
    EXPECT_NEAR(across.mean(), 0, 0.03) << angle;
    slide(-kSpeed * x, -kSpeed * y);
    cell_.run(kLeftOut + 500);
  }
}

TEST_F(Sliding, KeepsOneNewtonInEveryDirection) {
  constexpr double kSpeed = 0.02;
  std::array<Statistics, 2> force;
  for (int direction = 0; direction < 8; ++direction) {
    const double angle = direction * std::numbers::pi / 4;
    const double x = kSpeed * std::cos(angle), y = kSpeed * std::sin(angle);
    slide(x, y);
    cell_.run(kLeftOut);
    cell_.run(600, [&] {
      for (int arm = 0; arm < 2; ++arm)
        force[static_cast<std::size_t>(arm)].add(cell_.world.truth(arm).paper_force);
    });
    slide(-x, -y);
    cell_.run(700);
  }
  for (const Statistics& f : force) {
    EXPECT_NEAR(f.mean(), 1, 0.02);
    EXPECT_LT(f.deviation(), 0.12);
    EXPECT_GT(f.least(), 0) << "the pen left the paper";
  }
}

TEST_F(Sliding, FollowsACircle) {
  constexpr double kSpeed = 0.02, kRadius = 0.02;
  std::array<Statistics, 2> force, error;
  int k = 0;
  const auto circle = [&](bool record) {
    return [&, record] {
      const double angle = kSpeed / kRadius * kStep * ++k;
      slide(kSpeed * std::cos(angle), kSpeed * std::sin(angle));
      for (int arm = 0; arm < 2 && record; ++arm) {
        const auto i = static_cast<std::size_t>(arm);
        const Vector3 set = cell_.drivers[i].set_pose().p;
        force[i].add(cell_.world.truth(arm).paper_force);
        error[i].add((cell_.world.truth(arm).T_0E.p - set).head<2>().norm());
      }
    };
  };
  cell_.run(kLeftOut, circle(false));
  cell_.run(3200, circle(true));
  for (const Statistics& f : force) {
    EXPECT_NEAR(f.mean(), 1, 0.02);
    EXPECT_LT(f.deviation(), 0.12);
  }
  for (const Statistics& e : error) EXPECT_LT(e.most(), 3e-4);
}

// The pen lies 5 mm deep in it, and Bullet keeps points of contact where it has been.
TEST_P(SlidingOnAnyEngine, OnASoftSheetThatSlopesForceDoesNotJump) {
  WorldParameters w = PressingArm::world_of_one();
  w.engine = GetParam();
  w.arms[0].paper.stiffness = 4000;
  w.arms[0].paper.friction = 0;
  w.arms[0].paper.T_0P.R =
      w.arms[0].paper.T_0P.R * Eigen::AngleAxisd(0.15, Vector3::UnitX()).toRotationMatrix();
  w.arms[0].start_height = 0.001;
  PressingArm arm(w);
  arm.prepare();
  const auto press = [&](double along) { arm.move({u(along), u(), c(20, 10, 0.002), u(), u(), u()}); };
  for (int k = 0; k < 80; ++k) press(0);
  double last = arm.force(), jump = 0;
  arm.after_each_step = [&] {
    jump = std::max(jump, std::abs(arm.force() - last));
    last = arm.force();
  };
  for (int k = 0; k < 60; ++k) press(0.02);
  EXPECT_LT(jump, 2);
}

}  // namespace
}  // namespace mrroc::sim
