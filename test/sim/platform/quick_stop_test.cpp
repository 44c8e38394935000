// What the drives of a platform do when their driver is silent.
#include "sim/shell/quick_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/platform/platform_world.hpp"
#include "sim/shell/driverless_robot.hpp"
#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

/// A platform that goes at up to 0.8 m/s, and whose driver then is silent.
class Silent : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random{GetParam()};
  PlatformWorldParameters parameters = test::ideal_world();
  Silent() {
    parameters.platforms[0].motor_lag = 0.004;
    parameters.platforms[0].ripple = 0.01;
  }
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random); }

  /// How it came to rest.
  struct Rest {
    double speed{}, way{};
    int steps{-1};
  };
  Rest rest() {
    PlatformWorld world(parameters, GetParam());
    QuickStop quick_stop(world.body(0));
    PlatformDrive drive = test::drive({});
    const double v = between(0.3, 0.8), w = between(-0.6, 0.6);
    for (int step = 0; step < 1000; ++step) {
      const PlatformTruth& truth = world.truth(0);
      for (std::size_t k = 0; k < kWheels; ++k) {
        const double side = k % 2 == 0 ? -1 : 1;
        drive.torque[k] = 30 * (v - truth.v.vx) + side * 20 * (w - truth.v.w);
      }
      drive.step = step;
      world.step({&drive, 1});
      quick_stop.measure(world.reading(0));
    }
    Rest rest{.speed = std::hypot(world.truth(0).v.vx, world.truth(0).v.vy)};
    DriverlessRobot robot;
    for (int step = 1000; step < 2000 && !robot.at_rest(); ++step) {
      const PlanarPose before = world.truth(0).p;
      quick_stop.brake(drive);
      robot.step(step, world.reading(0).encoder, !drive.enabled);
      world.step({&drive, 1});
      quick_stop.measure(world.reading(0));
      rest.way += std::hypot(world.truth(0).p.x - before.x, world.truth(0).p.y - before.y);
    }
    if (robot.at_rest()) rest.steps = robot.stop_steps();
    return rest;
  }
};

INSTANTIATE_TEST_SUITE_P(Random, Silent, testing::Range(1U, 31U));

TEST_P(Silent, DrivesBrakeUntilTheWheelsRest) {
  const Rest stopped = rest();
  EXPECT_GT(stopped.speed, 0.25);
  EXPECT_GT(stopped.steps, 10);
  EXPECT_LE(stopped.steps, 200);
  EXPECT_LE(stopped.way, 0.2);
}

TEST_P(Silent, ShortCircuitedDrivesTakeLonger) {
  parameters.platforms[0].body.quick_stop = 0;
  const Rest stopped = rest();
  EXPECT_GT(stopped.steps, 300);
  EXPECT_LE(stopped.way, 0.25);
}

}  // namespace
}  // namespace mrroc::sim
