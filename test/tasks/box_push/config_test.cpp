// What the task reads, and what it refuses.
#include "tasks/box_push/config.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "base/fault.hpp"
#include "tasks/box_push/options.hpp"

namespace mrroc::box_push {
namespace {

Config config_with(const std::vector<std::string>& settings) {
  Config c = Config::parse(config(), "box_push.toml");
  for (const std::string& s : settings) c.set(s);
  return c;
}

TEST(PushConfig, HasAGoalThatNeedsWayAndTurn) {
  const CoordinatorParameters k = read_coordinator(config_with({}));
  EXPECT_GT(distance({}, k.goal), 1);
  EXPECT_NEAR(k.goal.phi, std::numbers::pi * 25 / 180, 1e-12);
  EXPECT_TRUE(k.hall.room.obstacles.empty());
}

TEST(PushConfig, RefusesAGoalWithoutRoom) {
  for (const char* to : {"task.to=[4.9, 0, 0]", "task.to=[0, 10, 0]"}) try {
      std::ignore = read_coordinator(config_with({to}));
      ADD_FAILURE() << to;
    } catch (const FaultError& e) {
      EXPECT_NE(std::string(e.what()).find("task.to"), std::string::npos) << e.what();
    }
  EXPECT_THROW(std::ignore = read_coordinator(config_with({"task.to=[nan, 0, 0]"})), ConfigError);
  EXPECT_THROW(std::ignore = read_coordinator(config_with({"task.to=[1, 0]"})), ConfigError);
  EXPECT_THROW(std::ignore = read_coordinator(config_with({"task.least_radius=5"})), ConfigError);
}

TEST(PushOptions, BecomeKeysOfTheConfiguration) {
  EXPECT_TRUE(settings_of({}).empty());
  const Config c = config_with(settings_of({.to = {"-1.5", "0.5", "90"}, .box = {"1", "-0.5", "180"}}));
  const CoordinatorParameters k = read_coordinator(c);
  EXPECT_EQ(k.goal.x, -1.5);
  EXPECT_NEAR(k.goal.phi, std::numbers::pi / 2, 1e-12);
  const auto box = c.numbers<3>("sim.boxes.box.start", std::nullopt);
  EXPECT_EQ(box[1], -0.5);
  EXPECT_NEAR(box[2], std::numbers::pi, 1e-6);
}

TEST(PushOptions, AreThreeNumbers) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"1", "2"},
                                                {"1", "2", "x"},
                                                {"1", "2", "3", "4"},
                                                {"1", "inf", "3"},
                                                {"1", "", "3"}}) {
    EXPECT_THROW(std::ignore = settings_of({.to = words}), FaultError);
    EXPECT_THROW(std::ignore = settings_of({.box = words}), FaultError);
  }
}

}  // namespace
}  // namespace mrroc::box_push
