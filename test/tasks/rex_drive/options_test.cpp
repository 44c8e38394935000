#include "tasks/rex_drive/options.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"
#include "tasks/rex_drive/config.hpp"

namespace mrroc::rex_drive {
namespace {

Config config_with(const std::vector<std::string>& settings) {
  Config c = Config::parse(config(), "rex_drive.toml");
  for (const std::string& s : settings) c.set(s);
  return c;
}

TEST(DriveOptions, SayNothingWhenTheyAreNotGiven) { EXPECT_TRUE(settings_of({}).empty()); }

TEST(DriveOptions, BecomeKeysOfTheConfiguration) {
  const Config c = config_with(settings_of(
      {.plan = "slalom", .speed = 0.4, .tracker = "kinematic", .estimator = "ekf", .ground = "slippery"}));
  EXPECT_EQ(read_plan_list(c).name, "slalom");
  EXPECT_EQ(c.number("task.speed", 0.6), 0.4);
  EXPECT_EQ(c.text("platforms.rex.tracker", ""), "kinematic");
  EXPECT_EQ(c.text("platforms.rex.estimator", ""), "ekf");
  EXPECT_EQ((c.numbers<2>("sim.ground.friction", {{0, 0}})[0]), 0.35);
}

TEST(DriveOptions, AnUnknownGroundIsTold) {
  try {
    std::ignore = settings_of({.plan = "", .speed = {}, .tracker = "", .estimator = "", .ground = "glue"});
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    EXPECT_NE(e.remedy().find("slippery"), std::string_view::npos);
  }
}

TEST(DriveOptions, ThePlatformStandsWhereThePlanBegins) {
  Config c = config_with({});
  complete_drive(c, {}, built_in_plan("figure_eight"));
  EXPECT_NEAR((c.numbers<3>("sim.platforms.rex.start", {{0, 0, 0}})[2]), 0.785, 1e-3);
  Config elsewhere = config_with({"sim.platforms.rex.start=[1, 0, 0]"});
  complete_drive(elsewhere, {}, built_in_plan("figure_eight"));
  EXPECT_EQ((elsewhere.numbers<3>("sim.platforms.rex.start", {{0, 0, 0}})[0]), 1);
}

TEST(DriveConfig, RefusesWhatTheKernelsCannotDo) {
  EXPECT_THROW(std::ignore = read_parameters(config_with({"time.n_s=20"})), ConfigError);
  EXPECT_THROW(std::ignore = read_parameters(config_with({"task.lateral=5"})), ConfigError);
  EXPECT_NO_THROW(std::ignore = read_parameters(config_with({})));
}

TEST(DriveConfig, APlanThroughAWallIsRefusedWithItsLine) {
  const Config c = config_with({});
  const PlanList list = parse_plans("1 0\n5 0\n", "my.txt");
  try {
    std::ignore = examine(list, c);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_plan);
    EXPECT_NE(std::string(e.what()).find("my.txt:2"), std::string::npos);
  }
}

TEST(DriveConfig, EveryBuiltInPlanCanBeDriven) {
  for (const std::string_view name : built_in_plan_names())
    EXPECT_GT(examine(built_in_plan(name), config_with({})).survey.duration, 1) << name;
}

TEST(DriveConfig, ANameThatIsNeitherPlanNorFileIsTold) {
  EXPECT_THROW(std::ignore = read_plan_list(config_with({"task.plan=\"figure_nine\""})), FaultError);
}

}  // namespace
}  // namespace mrroc::rex_drive
