// What a configuration makes of simulated platforms, and what it may not say.
#include "sim/platform/config.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "base/fault.hpp"
#include "robots/platforms.hpp"
#include "sim/platform/platform_world.hpp"
#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

const robots::PlatformType& cart() {
  static const robots::PlatformType made = [] {
    robots::PlatformType t;
    t.name = "cart";
    t.plant = test::ideal_platform().body;
    return t;
  }();
  return made;
}

PlatformWorldParameters read(const Config& config, const std::vector<std::string>& keys = {"a"}) {
  static const std::vector<const robots::PlatformType*> types{&cart()};
  return read_platform_world(config, keys, types);
}

PlatformWorldParameters world(const std::string& text, const std::vector<std::string>& keys = {"a"}) {
  return read(Config::parse(text, "test.toml"), keys);
}

TEST(PlatformConfig, APlatformIsThatOfItsTypeUnlessToldOtherwise) {
  const PlatformParameters p = world("").platforms.at(0);
  EXPECT_EQ(p.body.mass, 40);
  EXPECT_EQ(p.body.inertia, 2.5);
  EXPECT_EQ(p.centre[0], 0);
  EXPECT_EQ(p.faults.wheel_blocked.to, 0);
  const PlatformParameters other =
      world(
          "[sim.platforms.a]\nmass = 44\ncentre = [0.04, -0.01]\nstart = [1, 0.5, 3]\nimu.noise = 0.01\n"
          "[sim.platforms.a.faults]\nwheel = 2\nwheel_blocked = [100, 200]\n")
          .platforms.at(0);
  EXPECT_EQ(other.body.mass, 44);
  EXPECT_NEAR(other.body.inertia, 2.75, 1e-12) << "in proportion";
  EXPECT_EQ(other.centre[1], -0.01);
  EXPECT_EQ(other.start.phi, 3);
  EXPECT_EQ(other.imu.noise, 0.01);
  EXPECT_EQ(other.faults.wheel, 2);
  EXPECT_TRUE(other.faults.wheel_blocked.contains(100));
  EXPECT_FALSE(other.faults.wheel_blocked.contains(200));
  EXPECT_FALSE(other.faults.encoder_stuck.contains(100));
}

TEST(PlatformConfig, GroundAndMotionCapture) {
  const PlatformWorldParameters w = world(
      "[sim.ground]\nmodel = \"smooth\"\nfriction = [0.5, 0.4]\n"
      "[sim.ground.patches.ice]\narea = [0, -2, 4, 0]\nscale = 0.3\n[sim.ground.patches.late]\narea = [0, 0, "
      "1, 1]\n"
      "from = 15\n[motion_capture]\nperiod = 25\nlost = [1, 2, 4, 5]\noffset = [0.2, 0, 0]\ndisplaced = [6, "
      "7]\n");
  EXPECT_EQ(w.ground.model, GroundModel::smooth);
  EXPECT_EQ(w.ground.friction.mu_y, 0.4);
  ASSERT_EQ(w.ground.patches.size(), 2U);
  EXPECT_EQ(w.ground.patches[0].scale, 0.3);
  EXPECT_EQ(w.ground.patches[0].upper[0], 4);
  EXPECT_EQ(w.ground.patches[1].from, 15);
  EXPECT_EQ(w.motion_capture.setup.period, 25);
  ASSERT_EQ(w.motion_capture.lost.size(), 2U);
  EXPECT_EQ(w.motion_capture.lost[1].from, 4);
  EXPECT_EQ(w.motion_capture.displaced.to, 7);
}

TEST(PlatformConfig, BoxesStandWhereTheyAreTold) {
  EXPECT_TRUE(world("").boxes.empty());
  const PlatformWorldParameters w = world(
      "[sim.boxes.crate]\nsize = [0.5, 1]\nmass = 30\nfriction = 0.3\ngrip = 0.2\nstart = [1, 0.5, 2]\n"
      "[sim.boxes.barrel]\nstart = [-1.5, 0, 0]\n");
  ASSERT_EQ(w.boxes.size(), 2U);
  EXPECT_EQ(w.boxes[0].name, "barrel") << "in alphabetical order";
  EXPECT_EQ(w.boxes[0].mass, BoxParameters{}.mass);
  EXPECT_EQ(w.boxes[1].length, 0.5);
  EXPECT_EQ(w.boxes[1].width, 1);
  EXPECT_EQ(w.boxes[1].mass, 30);
  EXPECT_EQ(w.boxes[1].friction, 0.3);
  EXPECT_EQ(w.boxes[1].grip, 0.2);
  EXPECT_EQ(w.boxes[1].start.phi, 2);
}

TEST(PlatformConfig, ABoxThatBeginsNowhereMayBeAnotherOneMisspelt) {
  try {
    std::ignore = world("[sim.boxes.crate]\nstart = [1, 0.5, 2]\n[sim.boxes.crat]\nmass = 30\n");
    ADD_FAILURE() << "was not refused";
  } catch (const FaultError& e) {
    EXPECT_NE(
        std::string(e.what()).find("sim.boxes.crat.start: it is missing, and the box begins nowhere; did you "
                                   "mean 'crate'?"),
        std::string::npos)
        << e.what();
  }
}

TEST(PlatformConfig, WhatARunHasWrittenMakesTheSameWorldOfTwo) {
  const Config config = Config::parse(
      "[sim.platforms.b]\nstart = [1.5, 0, 0]\nfaults.imu_nan = [5, 9]\n[sim.ground.patches.ice]\narea = [0, "
      "0, 1, 1]\n",
      "test.toml");
  const auto first = read(config, {"a", "b"});
  EXPECT_NO_THROW(config.check_all_used());
  const auto again = world(config.dump(), {"a", "b"});
  PlatformWorld one(first, 2), other(again, 2);
  for (int step = 0; step < 100; ++step) {
    const PlatformDrive d = test::drive({3, 4, 5, 6});
    one.step({&d, 1});
    other.step({&d, 1});
  }
  EXPECT_EQ(one.state_hash(), other.state_hash());
}

TEST(PlatformConfig, RefusesWhatMakesNoSenseByItsKey) {
  for (const auto& [key, text] : std::vector<std::pair<std::string, std::string>>{
           {"sim.platforms.a.mass", "[sim.platforms.a]\nmass = 0"},
           {"sim.platforms.a.mass", "[sim.platforms.a]\nmass = nan"},
           {"sim.platforms.a.centre", "[sim.platforms.a]\ncentre = [0.25, 0.1]"},
           {"sim.platforms.a.centre", "[sim.platforms.a]\ncentre = [0.1]"},
           {"sim.platforms.a.start", "[sim.platforms.a]\nstart = [3.5, 0, 0]"},
           {"sim.platforms.a.start", "[sim.platforms.a]\nstart = [2.7, 0, 0]"},
           {"sim.platforms.a.faults.wheel", "[sim.platforms.a.faults]\nwheel = 5"},
           {"sim.platforms.a.faults.wheel", "[sim.platforms.a.faults]\nwheel = 4"},
           {"sim.platforms.a.faults.wheel_blocked", "[sim.platforms.a.faults]\nwheel_blocked = [5]"},
           {"sim.platforms.a.faults.wheel_blocked", "[sim.platforms.a.faults]\nwheel_blocked = [5, 4]"},
           {"sim.platforms.a.faults.imu_silent", "[sim.platforms.a.faults]\nimu_silent = [1.5, 4]"},
           {"sim.ground.model", "[sim.ground]\nmodel = \"ice\""},
           {"sim.ground.friction", "[sim.ground]\nfriction = [0.7, 0]"},
           {"sim.ground.patches.x.area", "[sim.ground.patches.x]\nscale = 1"},
           {"sim.ground.patches.x.area", "[sim.ground.patches.x]\narea = [1, 0, 0, 1]"},
           {"motion_capture.lost", "[motion_capture]\nlost = [1, 2, 3]"},
           {"motion_capture.lost", "[motion_capture]\nlost = [2, 1]"},
           {"motion_capture.displaced", "[motion_capture]\ndisplaced = [1, 2, 3, 4]"},
           {"motion_capture.period", "[motion_capture]\nperiod = 0"},
           {"motion_capture.outliers", "[motion_capture]\noutliers = 2"},
           {"sim.boxes.x.start", "[sim.boxes.x]\nmass = 10"},
           {"sim.boxes.x.start", "[sim.boxes.x]\nstart = [0.6, 0, 0]"},
           {"sim.boxes.x.start", "[sim.boxes.x]\nstart = [2.6, 0, 0]"},
           {"sim.boxes.y.start", "[sim.boxes.x]\nstart = [1.5, 0, 0]\n[sim.boxes.y]\nstart = [1.9, 0, 0]"},
           {"sim.boxes.x.mass", "[sim.boxes.x]\nstart = [1.5, 0, 0]\nmass = 0"},
           {"sim.boxes.x.size", "[sim.boxes.x]\nstart = [1.5, 0, 0]\nsize = [1]"},
           {"sim.boxes.a", "[sim.boxes.a]\nstart = [1.5, 0, 0]"},
           {"platforms.a.model", "[platforms.a]\nmodel = \"tank\""}}) {
    try {
      world(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(e.what()).find(key), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(world("", {}), FaultError);
  EXPECT_THROW(world("", {"a", "b", "c"}), FaultError);
  EXPECT_THROW(world("", {"a", "b"}), FaultError) << "both at the same place";
  EXPECT_THROW(std::ignore = read_platform_world(Config(), {"a"}, {}), FaultError) << "no platform was built";
}

TEST(PlatformOrder, NamesPlatformsOnceAndNoArms) {
  const auto order = [](const std::string& text) {
    return robots::read_platform_order(Config::parse(text, "test.toml"));
  };
  EXPECT_TRUE(order("").empty());
  EXPECT_EQ(order("[platforms]\norder = [\"b\", \"a\"]"), (std::vector<std::string>{"b", "a"}));
  EXPECT_THROW(order("[platforms]\norder = [\"a\", \"a\"]"), FaultError);
  EXPECT_THROW(order("[platforms]\norder = [\"a.b\"]"), FaultError);
  EXPECT_THROW(order("[platforms]\norder = [\"a\"]\n[robots]\norder = [\"a\"]"), FaultError);
}

}  // namespace
}  // namespace mrroc::sim
