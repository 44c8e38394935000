// The nodes of a task of platforms, and what is refused before any of them starts.
#include "launch/platform_nodes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/config.hpp"
#include "base/fault.hpp"
#include "launch/cell_nodes.hpp"

namespace mrroc::launch {
namespace {

const std::vector<CellPlatform> kPlatforms{{"rex", "rex"}};

Config config_with(const std::string& text) {
  Config config = Config::parse("[robots]\norder = []\n[platforms]\norder = [\"rex\"]\n", "test.toml");
  config.overlay(Config::parse(text, "more.toml"));
  return config;
}

TEST(PlatformNodes, AreTheSimulatorAndOneDriverEach) {
  const Config config = config_with("");
  check_cell(config, {}, kPlatforms);
  const auto nodes = cell_nodes(config, {}, kPlatforms);
  ASSERT_EQ(nodes.size(), 2U);
  EXPECT_EQ(nodes[0].name, "simulator");
  EXPECT_EQ(nodes[0].program, "simulator");
  EXPECT_EQ(nodes[1].name, "edp-rex");
  EXPECT_EQ(nodes[1].program, "edp_rex");
  EXPECT_EQ(nodes[1].plant, "simulator");
}

TEST(PlatformNodes, EverythingThatTheyReadIsKnownBeforeTheyStart) {
  const Config config = config_with("");
  check_cell(config, {}, kPlatforms);
  for (const char* key :
       {"robots.order", "platforms.rex.tracker", "platforms.rex.estimator", "sim.platforms.rex.mass",
        "sim.ground.model", "motion_capture.period", "room.walls", "platforms.rex.command_link.loss"})
    EXPECT_TRUE(config.has(key)) << key;
  EXPECT_FALSE(config.has("sim.paper.stiffness")) << "there are no arms";
}

TEST(PlatformNodes, WhatIsWrongIsRefusedWithItsKey) {
  for (const auto& [key, text] : std::vector<std::pair<std::string, std::string>>{
           {"platforms.order", "[platforms]\norder = []"},
           {"platforms.order", "[platforms]\norder = [\"rex\", \"rex2\"]"},
           {"platforms.order", "[robots]\norder = [\"rex\"]"},
           {"robots.order", "[robots]\norder = [\"arm1\"]"},
           {"platforms.rex.model", "[platforms.rex]\nmodel = \"wheelbarrow\""},
           {"platforms.rex.tracker", "[platforms.rex]\ntracker = \"none\""},
           {"platforms.rex.estimator", "[platforms.rex]\nestimator = \"none\""},
           {"platforms.rex.synchro_timeout", "[platforms.rex]\nsynchro_rest = 5\nsynchro_timeout = 5"},
           {"platforms.rex.synchro_timeout", "[motion_capture]\nperiod = 1000"},
           {"motion_capture.period",
            "[platforms.rex]\nsynchro_rest = 0.5\nsynchro_timeout = 1\n[motion_capture]\nperiod = 100"},
           {"motion_capture.latency", "[motion_capture]\nlatency = 200"},
           {"platforms.rex.friction", "[platforms.rex]\nfriction = [0.7]"},
           {"time.n_s", "[time]\nn_s = 20"},
           {"sim.platforms.rex.start", "[sim.platforms.rex]\nstart = [9, 0, 0]"},
           {"sim.platforms.rex.start", "[sim.platforms.rex]\nstart = [2.9, 0.5, 0]"}}) {
    try {
      check_cell(config_with(text), {}, kPlatforms);
      ADD_FAILURE() << text << " was taken";
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(e.what()).find(key), std::string::npos) << e.what();
    }
  }
}

TEST(PlatformNodes, ATaskWithoutPlatformsKnowsNoneOfTheirKeys) {
  const Config config = Config::parse("[robots]\norder = [\"arm1\"]\n", "test.toml");
  check_cell(config, {{"arm1", "irb6_postument"}});
  for (const char* key : {"platforms.order", "room.walls", "motion_capture.period"})
    EXPECT_FALSE(config.has(key));
  EXPECT_TRUE(config.has("sim.paper.stiffness"));
}

}  // namespace
}  // namespace mrroc::launch
