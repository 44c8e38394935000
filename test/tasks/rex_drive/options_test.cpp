#include "tasks/rex_drive/options.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/fault.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

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
    std::ignore = settings_of({.ground = "glue"});
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    EXPECT_NE(e.remedy().find("slippery"), std::string_view::npos);
  }
}

TEST(DriveOptions, OfAGroundThatIsNotKnownTheNearestIsNamed) {
  const auto error_of = [](const std::string& ground) {
    try {
      std::ignore = settings_of({.ground = ground});
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error_of("ice").find("did you mean 'ice_right'?"), std::string::npos) << error_of("ice");
  EXPECT_NE(error_of("slipery").find("did you mean 'slippery'?"), std::string::npos);
  EXPECT_EQ(error_of("concrete").find("did you mean"), std::string::npos);
}

class GroundFile : public ::testing::Test {
 protected:
  ~GroundFile() override { std::filesystem::remove(file_); }

  /// @return what is wrong with a file of that text; empty: it is a ground
  std::string error_of(const std::string& text) const {
    std::ofstream(file_) << text;
    Config c = config_with({"task.eyes=false"});
    PlanList plans = built_in_plan("slalom");
    try {
      complete_drive(c, {.ground = file_.string()}, plans);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      return e.error_line();
    }
    return {};
  }

  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("ground-" + std::to_string(::getpid()) + ".toml");
};

TEST_F(GroundFile, HasATableOfAGround) {
  EXPECT_EQ(error_of("[sim.ground]\nfriction = [0.5, 0.4]\n"), "");
  EXPECT_EQ(error_of("[sim.ground.patches.puddle]\narea = [0, 0, 1, 1]\n"), "");
}

TEST_F(GroundFile, ThatIsEmptyOrSaysSomethingElseIsToldWhatIsWanted) {
  for (const char* text : {"", "# nothing\n", "friction = [0.5, 0.4]\n"})
    EXPECT_NE(error_of(text).find("has no table; a ground is a table [sim.ground]"), std::string::npos)
        << error_of(text);
  for (const char* text : {"[ground]\nfriction = [0.5, 0.4]\n", "[sim.platforms.rex]\nstart = [0, 0, 0]\n",
                           "[sim.ground]\nfriction = [0.5, 0.4]\n[task]\nspeed = 1\n",
                           "[sim.ground]\nfriction = [0.5, 0.4]\n[sim.platforms.rex]\nstart = [0, 0, 0]\n"})
    EXPECT_NE(error_of(text).find("has other tables than [sim.ground]; a ground is"), std::string::npos)
        << error_of(text);
}

TEST(DriveOptions, AnEmptyWordIsNotTheDefault) {
  for (const DriveOptions& o : {DriveOptions{.plan = ""}, DriveOptions{.tracker = ""},
                                DriveOptions{.estimator = ""}, DriveOptions{.ground = ""}})
    try {
      std::ignore = settings_of(o);
      ADD_FAILURE();
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
      EXPECT_NE(std::string(e.what()).find("empty"), std::string::npos);
    }
}

TEST(DriveOptions, EveryKeyThatIsSetHasItsOption) {
  const auto options = options_of_keys();
  for (const std::string& setting :
       settings_of({.plan = "slalom", .speed = 0.4, .tracker = "kinematic", .estimator = "ekf"}))
    EXPECT_TRUE(options.contains(setting.substr(0, setting.find('=')))) << setting;
}

TEST(DriveOptions, ThePlatformStandsWhereThePlanBegins) {
  Config c = config_with({});
  PlanList plans = built_in_plan("figure_eight");
  complete_drive(c, {}, plans);
  EXPECT_NEAR((c.numbers<3>("sim.platforms.rex.start", {{0, 0, 0}})[2]), 0.785, 1e-3);
}

TEST(DriveOptions, ThePlansBeginWhereTheConfigurationLetsThePlatformStand) {
  Config c = config_with({"sim.platforms.rex.start=[1, 0.5, 7]"});
  PlanList plans = built_in_plan("figure_eight");
  complete_drive(c, {}, plans);
  EXPECT_EQ((c.numbers<3>("sim.platforms.rex.start", {{0, 0, 0}})[0]), 1);
  EXPECT_EQ(plans.start.x, 1);
  EXPECT_EQ(plans.start.y, 0.5);
  EXPECT_NEAR(plans.start.phi, 7 - 2 * std::numbers::pi, 1e-12);
  const PathPoint begin = examine(plans, c).survey.found.front().trajectory.knot.front();
  EXPECT_EQ(begin.p.x, 1);
}

TEST(DriveOptions, AStartThatIsNotFreeNamesWhatItStandsInOrHowFarTheWallsGo) {
  const auto error_of = [](const std::string& start) {
    Config c = config_with({});
    PlanList plans = parse_plans("start " + start + "\n1 0\n2 0\n", "my.txt");
    try {
      complete_drive(c, {}, plans);
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error_of("2.9 0 0").find("my.txt:1: the start (2.9, 0): in the obstacle 'bench'"),
            std::string::npos);
  EXPECT_NE(error_of("2.5 0 0").find("0.30 m from the obstacle 'bench', 0.55 m are needed"),
            std::string::npos)
      << error_of("2.5 0 0");
  EXPECT_NE(error_of("0 1.8 0").find("0.20 m from a wall"), std::string::npos);
  EXPECT_NE(error_of("5 0 0").find("outside the room, whose walls are at x -3 and 3 m, y -2 and 2 m"),
            std::string::npos);
  EXPECT_EQ(error_of("0 0 0"), "");
}

TEST(DriveOptions, AStartOfThePlanAtAWallIsToldWithItsLineAndOneOfTheConfigurationLater) {
  const std::string at_the_wall = "start 2.9 0 0\n1 0\n2 0\n";
  Config c = config_with({});
  PlanList plans = parse_plans(at_the_wall, "my.txt");
  try {
    complete_drive(c, {}, plans);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_plan);
    EXPECT_TRUE(std::string(e.what()).starts_with("my.txt:1: the start (2.9, 0): in the obstacle 'bench'"))
        << e.what();
  }
  Config elsewhere = config_with({"sim.platforms.rex.start=[2.9, 0.5, 0]"});
  complete_drive(elsewhere, {}, plans);
  EXPECT_EQ(plans.start_line, 0) << "no line of the plan is named, but by check_cell() the key";
  EXPECT_EQ(plans.start.x, 2.9);
}

/// A configuration as the program completes it.
Config completed(const DriveOptions& options, const std::vector<std::string>& settings = {}) {
  std::vector<std::string> all = settings_of(options);
  all.insert(all.end(), settings.begin(), settings.end());
  Config c = config_with(all);
  PlanList plans = built_in_plan("figure_eight");
  complete_drive(c, options, plans);
  return c;
}

TEST(DriveOptions, EyesAreThePairOfTheBuiltInFileWhereTheConfigurationSaysNothingElse) {
  EXPECT_FALSE(read_eyes(completed({.eyes = "off"})));
  EXPECT_FALSE(completed({.eyes = "off"}).has("odometry.rex.left"));
  EXPECT_TRUE(read_eyes(completed({.eyes = "on"})));
  const auto clock = read_eyes(completed({}));
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->period, 40);
  EXPECT_EQ(clock->latency, 40);
  const auto own = read_eyes(completed({.eyes = "on"}, {"cameras.rex_left.period=20"}));
  ASSERT_TRUE(own);
  EXPECT_EQ(own->period, 20);
  EXPECT_EQ(own->latency, 40);
  EXPECT_FALSE(read_eyes(completed({.eyes = "on"}, {"task.eyes=false", "cameras.order=[\"rex_left\"]"})))
      << "the cameras of a run's configuration do not decide";
}

TEST(DriveOptions, SettingsOfCamerasAreRefusedWithoutEyes) {
  for (const char* setting : {"cameras.light.exposure=0.01", "cameras.rex_left.noise=5",
                              "cameras.profile=\"fast\"", "odometry.rex.inliers=30"})
    try {
      std::ignore = completed({.eyes = "off"}, {setting});
      ADD_FAILURE() << setting;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      const std::string text = e.what(), key = setting;
      EXPECT_TRUE(text.starts_with(key.substr(0, text.find(':')))) << text;
      EXPECT_NE(std::string(e.remedy()).find("--eyes on"), std::string::npos) << e.remedy();
    }
  EXPECT_NO_THROW(std::ignore = completed({.eyes = "on"}, {"cameras.light.exposure=0.01"}));
}

TEST(DriveConfig, PicturesAreTakenAtMacrosteps) {
  try {
    std::ignore = read_eyes(completed({.eyes = "on"}, {"cameras.rex_left.period=45"}));
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    EXPECT_NE(std::string(e.what()).find("cameras.rex_left.period"), std::string::npos) << e.what();
  }
}

TEST(DriveOptions, NamesOfAlgorithmsAreWhateverThePlatformHas) {
  const Config c = config_with(settings_of({.tracker = "mine", .estimator = "a \"b\""}));
  EXPECT_EQ(c.text("platforms.rex.tracker", ""), "mine");
  EXPECT_EQ(c.text("platforms.rex.estimator", ""), "a \"b\"");
}

TEST(DriveConfig, RefusesWhatTheKernelsCannotDo) {
  EXPECT_THROW(std::ignore = read_parameters(config_with({"time.n_s=20"})), ConfigError);
  EXPECT_THROW(std::ignore = read_parameters(config_with({"task.lateral=5"})), ConfigError);
  EXPECT_NO_THROW(std::ignore = read_parameters(config_with({})));
}

TEST(DriveConfig, AFragmentIsAskedForEarlyEnoughToBePlanned) {
  for (const std::vector<std::string>& late :
       {std::vector<std::string>{"task.lead=0"}, {"task.lead=0.08"}, {"task.planning=100"}})
    EXPECT_THROW(std::ignore = read_parameters(config_with(late)), FaultError) << late.front();
  EXPECT_NO_THROW(std::ignore = read_parameters(config_with({"task.lead=0.1"})));
  EXPECT_NO_THROW(std::ignore = read_parameters(config_with({"task.lead=0", "task.planning=0"})));
}

TEST(DriveConfig, ACurveThatIsNotFreeIsRefusedWithItsPoint) {
  // Both legs are free, and the curve of the way through their common point is beyond them.
  const Config c = config_with({"room.furniture=false", "room.walls=[-1, -2, 3, 2]"});
  const PlanList list = parse_plans("start 0 -0.5 0\n1.2 -0.9\n2.44 0\n2.44 1\n0 1\n", "my.txt");
  try {
    std::ignore = examine(list, c);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_plan);
    EXPECT_NE(std::string(e.what()).find("my.txt:4: (2.44, 1), the curve to this point"), std::string::npos)
        << e.what();
  }
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
  const auto told = [](const std::string& plan) -> std::string {
    try {
      std::ignore = read_plan_list(config_with({"task.plan=\"" + plan + "\""}));
      return {};
    } catch (const FaultError& e) {
      return e.what();
    }
  };
  EXPECT_NE(told("figure_nine").find("there is no such file"), std::string::npos);
  EXPECT_NE(told("/somewhere/slalon").find("did you mean 'slalom'?"), std::string::npos)
      << "as the option writes it";
  EXPECT_EQ(told("/somewhere/points.txt").find("did you mean"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::rex_drive
