// The arms that a configuration gives the simulator.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "base/config.hpp"
#include "robots/catalogue.hpp"
#include "sim/config.hpp"

namespace mrroc::sim {
namespace {

TEST(WorldConfig, ArmsAreThoseOfTheCatalogueUnlessTheConfigurationSaysAnother) {
  const auto types = robots::catalogue();
  ASSERT_GE(types.size(), 2U);
  const WorldParameters usual =
      read_world(Config::parse("[robots]\norder = [\"arm1\", \"arm2\"]\n", "test.toml"));
  ASSERT_EQ(usual.arms.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(usual.arms[k].type, types[k]) << types[k]->name;

  const WorldParameters other = read_world(
      Config::parse("[robots]\norder = [\"arm1\"]\n[robots.arm1]\nmodel = \"irb6_track\"\n", "test.toml"));
  ASSERT_EQ(other.arms.size(), 1U);
  EXPECT_EQ(other.arms[0].type, robots::find("irb6_track"));
}

TEST(WorldConfig, ArmsBeyondTheCatalogueAreOfItsLastTypeThatIsNoConveyor) {
  std::string order = "\"arm1\"";
  const auto types = robots::catalogue();
  for (std::size_t k = 1; k <= types.size(); ++k) order += ", \"arm" + std::to_string(k + 1) + "\"";
  const WorldParameters world = read_world(Config::parse("[robots]\norder = [" + order + "]\n", "test.toml"));
  ASSERT_EQ(world.arms.size(), types.size() + 1);
  const robots::RobotType* last = types.front();
  for (const robots::RobotType* type : types)
    if (!type->belt) last = type;
  EXPECT_EQ(world.arms.back().type, last);
}

TEST(WorldConfig, SheetsLieAtTheHeightOfAConveyorsBelt) {
  const auto world = [](const std::string& height) {
    return read_world(
        Config::parse("[robots]\norder = [\"arm1\", \"belt\"]\n[robots.belt]\nmodel = \"conveyor\"\n"
                      "[sim.paper]\nheight = " +
                          height,
                      "test.toml"));
  };
  EXPECT_EQ(world("0.9064").arms.size(), 2U);
  EXPECT_THROW(world("0.92"), FaultError);
}

TEST(WorldConfig, StartJointsAreOnePerAxisOrNone) {
  const auto world = [](const std::string& joints) {
    return read_world(
        Config::parse("[robots]\norder = [\"arm1\"]\n[robots.arm1]\nstart_joints = " + joints, "test.toml"));
  };
  EXPECT_TRUE(world("[]").arms[0].start.empty());
  EXPECT_EQ(world("[0, -1.5, 0, 0, 1.5, 0]").arms[0].start.size(), 6U);
  for (const std::string few : {"[0, 0, 0]", "[0, 0, 0, 0, 0, 0, 0, 0]"}) {
    try {
      world(few);
      ADD_FAILURE() << few << " was taken";
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_EQ(std::string(e.what()).find("robots.arm1.start_joints: "), 0U) << e.what();
    }
  }
}

TEST(WorldConfig, ScalesOfTheMotorsAreThoseOfTheJawsMotorToo) {
  const JawParameters usual;
  const auto jaws = [](const std::string& sim) {
    return read_world(Config::parse("[robots.arm1]\ngripper = \"two_jaw\"\n[sim]\n" + sim, "test.toml"))
        .arms.front()
        .jaws.value()
        .motor;
  };
  EXPECT_EQ(jaws("").friction, usual.motor.friction);
  EXPECT_EQ(jaws("motor_friction = 2\n").friction, 2 * usual.motor.friction);
  EXPECT_EQ(jaws("robots.arm1.friction_scale = 0.5\n").friction, usual.motor.friction / 2);
  EXPECT_EQ(jaws("robots.arm1.torque_constant_scale = 1.1\n").torque_constant,
            1.1 * usual.motor.torque_constant);
  EXPECT_EQ(jaws("robots.arm2.friction_scale = 0.5\n").friction, usual.motor.friction) << "of another arm";
}

TEST(WorldConfig, DriverAndPlantHaveTheSameForceSensor) {
  for (const bool wide : {false, true}) {
    const Config config = Config::parse(
        std::string("[robots.arm1]\nstart_joints = []\n") + (wide ? "sensor = \"si_130_10\"\n" : ""),
        "test.toml");
    const ForceSensorParameters plant = read_world(config.copy()).arms.front().sensor;
    const robots::RobotType& type = *robots::catalogue().front();
    const edp::DriverParameters driver =
        robots::read_driver(config, "arm1", type, std::vector<double>(type.motors.size())).driver;
    const ForceSensorParameters usual;
    const double times = wide ? 2 : 1;
    EXPECT_EQ(plant.range_xy, times * usual.range_xy);
    EXPECT_EQ(plant.range_z, times * usual.range_z);
    EXPECT_EQ(plant.range_torque, times * usual.range_torque);
    EXPECT_EQ(plant.force_noise, times * usual.force_noise) << "what measures more does it more coarsely";
    EXPECT_EQ(plant.torque_resolution, times * usual.torque_resolution);
    EXPECT_EQ(driver.force.range[Axis::x], plant.range_xy);
    EXPECT_EQ(driver.force.range[Axis::z], plant.range_z);
    EXPECT_EQ(driver.force.range[Axis::az], plant.range_torque);
    EXPECT_EQ(driver.limits.force[Axis::az], plant.range_torque) << "what may be asked for";
  }
}

}  // namespace
}  // namespace mrroc::sim
