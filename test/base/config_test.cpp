// Values of a configuration, and the errors of wrong ones.
#include "base/config.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <tuple>

#include "test/base/robots_config.hpp"

namespace mrroc::test {
namespace {

/// The error that the call throws; fails the test if it throws none.
template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const FaultError& error) {
    EXPECT_EQ(error.fault().code, FaultCode::bad_configuration);
    return error.what();
  }
  ADD_FAILURE() << "no ConfigError";
  return {};
}

std::string syntax_error(const std::string& text) {
  return error_of([&] { Config::parse(text, "a.toml"); });
}

std::string set_error(const std::string& assignment) {
  return error_of([&] { robots().set(assignment); });
}

TEST(Config, GivesTheValuesOfTheFile) {
  const Config cfg = robots();
  EXPECT_EQ(cfg.text("clock", "wall"), "step");
  EXPECT_EQ(cfg.number("robots.arm1.track", 0), 0.5);
  EXPECT_EQ(cfg.integer("robots.arm2.n_s", 5), 10);
  EXPECT_TRUE(cfg.flag("robots.arm2.attended", false));
  EXPECT_EQ(cfg.numbers<3>("robots.arm1.gains", {{0, 0, 0}}), (std::array<double, 3>{1, 2.5, 3}));
  EXPECT_EQ(cfg.texts("robots.arm2.sensors", {{}}), (std::vector<std::string>{"pen", "camera"}));
  EXPECT_TRUE(cfg.has("clock"));
  EXPECT_FALSE(cfg.has("robots"));
}

TEST(Config, GivesTheDefaultsOfWhatTheFileLeavesOut) {
  const Config cfg;
  EXPECT_EQ(cfg.number("sim.paper.stiffness", 1e4, {100, 1e6}, "N/m"), 1e4);
  EXPECT_EQ(cfg.integer<std::uint64_t>("seed", 1), 1U);
  EXPECT_FALSE(cfg.flag("attended", false));
  EXPECT_EQ(cfg.text("name", "x y"), "x y");
  EXPECT_EQ(cfg.list("via", {{1, 2}}), (std::vector<double>{1, 2}));
  EXPECT_EQ(cfg.numbers<2>("home", {{0.5, -0.5}}), (std::array<double, 2>{0.5, -0.5}));
}

TEST(Config, KeepsTheMeaningOfAKeyForListsAlsoWhenItIsReadAgainWithoutOne) {
  const Config cfg;
  const auto meaning = [&cfg] {
    const ConfigParameter p = cfg.parameters().at(0);
    return p.unit + "; " + p.about + "; " + p.believed;
  };
  std::ignore = cfg.number("sim.mass", 2, {1, 3}, {"kg", "of the cube", "cube.mass"});
  EXPECT_EQ(meaning(), "kg; of the cube; cube.mass");
  std::ignore = cfg.number("sim.mass", 2, {1, 3}, "kg");
  EXPECT_EQ(meaning(), "kg; of the cube; cube.mass");
  std::ignore = cfg.flag("a", true, {"", "whether"});
  std::ignore = cfg.choice("b", 1, {{"one", 1}}, {"", "how many"});
  EXPECT_EQ(cfg.parameters().at(0).about, "whether");
  EXPECT_EQ(cfg.parameters().at(1).about, "how many");
}

TEST(Config, ReadsNumbersWithoutAFractionAsNumbers) {
  const Config cfg = Config::parse("a = 3\nb = [1, 2]", "a.toml");
  EXPECT_EQ(cfg.number("a", 0), 3.0);
  EXPECT_EQ(cfg.list("b", {{}}), (std::vector<double>{1, 2}));
}

TEST(Config, ChoosesAmongNamesThatAreMadeAtRunTime) {
  const std::vector<std::pair<std::string_view, int>> names{{"step", 7}, {"wall", 8}};
  const auto clock = [&](const Config& cfg) { return cfg.choice("clock", 8, std::span(names)); };
  EXPECT_EQ(clock(robots()), 7);
  EXPECT_EQ(clock(Config()), 8);
  EXPECT_THROW(clock(Config::parse("clock = 'sun'", "a.toml")), ConfigError);
}

TEST(Config, ChoosesAmongNames) {
  enum class Clock { step, wall };
  const auto clock = [](const Config& cfg) {
    return cfg.choice("clock", Clock::wall, {{"step", Clock::step}, {"wall", Clock::wall}});
  };
  EXPECT_EQ(clock(robots()), Clock::step);
  EXPECT_EQ(clock(Config()), Clock::wall);
  EXPECT_EQ(error_of([&] { clock(Config::parse("clock = 'stp'", "a.toml")); }),
            "a.toml:1: 'clock' is \"stp\", it must be step or wall; did you mean \"step\"?");
}

TEST(Config, HasSectionsAndTheirNames) {
  const Config cfg = robots();
  EXPECT_EQ(cfg.tables("robots"), (std::vector<std::string>{"arm1", "arm2"}));
  const Config arm = cfg.section("robots").section("arm1");
  EXPECT_EQ(arm.text("model", "rex"), "irb6");
  EXPECT_EQ(arm.number("offset", 2), 2);
  EXPECT_TRUE(cfg.has("robots.arm1.offset"));
}

TEST(Config, PutsTheUpperLayerOverTheLowerAndOptionsOverBoth) {
  Config cfg = robots();
  cfg.overlay(Config::parse("[robots.arm1]\ntrack = 0.75\n[robots.arm2]\nn_s = 20", "task.toml"));
  cfg.set("robots.arm2.n_s = 30");
  EXPECT_EQ(cfg.number("robots.arm1.track", 0), 0.75);
  EXPECT_EQ(cfg.integer("robots.arm2.n_s", 0), 30);
  EXPECT_EQ(cfg.text("robots.arm1.model", ""), "irb6");
}

TEST(Config, PutsALowerLayerBelowWhatIsThere) {
  Config cfg = Config::parse("[eye]\nnoise = 3", "task.toml");
  cfg.set("eye.period = 20");
  cfg.underlay(Config::parse("[eye]\nnoise = 1\nperiod = 40\nlatency = 60\n[ear]\n", "eyes.toml"));
  EXPECT_EQ(cfg.number("eye.noise", 0), 3);
  EXPECT_EQ(cfg.integer("eye.period", 0), 20);
  EXPECT_EQ(cfg.integer("eye.latency", 0), 60);
  EXPECT_EQ(cfg.tables(""), (std::vector<std::string>{"ear", "eye"}));
  EXPECT_THROW(cfg.underlay(Config::parse("[eye.noise]\nof = 1", "eyes.toml")), ConfigError);
}

TEST(Config, SetsValuesInTomlAndSingleWordsWithoutQuotationMarks) {
  Config cfg;
  for (const char* assignment :
       {"a=scripted", "b=\"two words\"", "c=[1, 2]", "d=true", "e=-1.5e3", "f=1.2.3"})
    cfg.set(assignment);
  EXPECT_EQ(cfg.text("a", ""), "scripted");
  EXPECT_EQ(cfg.text("b", ""), "two words");
  EXPECT_EQ(cfg.list("c", {{}}), (std::vector<double>{1, 2}));
  EXPECT_TRUE(cfg.flag("d", false));
  EXPECT_EQ(cfg.number("e", 0), -1500);
  EXPECT_EQ(cfg.text("f", ""), "1.2.3");
}

TEST(ConfigErrors, NameFileLineAndColumnOfASyntaxError) {
  EXPECT_EQ(syntax_error("a = 1\nb = = 2\n").substr(0, 11), "a.toml:2:5:")
      << syntax_error("a = 1\nb = = 2\n");
  EXPECT_EQ(syntax_error("a = 1\na = 2\n").substr(0, 9), "a.toml:2:");
}

TEST(ConfigErrors, NameTheMissingFile) {
  EXPECT_EQ(error_of([] { Config::load("/nowhere/a.toml"); }), "/nowhere/a.toml: there is no such file");
  EXPECT_EQ(error_of([] { Config::load(std::filesystem::temp_directory_path()); }),
            std::filesystem::temp_directory_path().string() + ": this is not a file but a folder");
}

TEST(ConfigErrors, NameTheRangeAndTheUnit) {
  const Config cfg = Config::parse("\n[sim.paper]\nstiffness = 5.0", "a.toml");
  EXPECT_EQ(error_of([&] {
              (void)cfg.number("sim.paper.stiffness", 1e4, {100, 1e6}, "N/m");
            }),
            "a.toml:3: 'sim.paper.stiffness' is 5.0, out of its range: 100 to 1000000 N/m");
  EXPECT_EQ(error_of([] { (void)Config::parse("n = -1", "b").integer("n", 1, {0}); }),
            "b:1: 'n' is -1, out of its range: at least 0");
  EXPECT_EQ(error_of([] { (void)Config::parse("x = 3.5", "b").number("x", 1, {.max = 2.5}); }),
            "b:1: 'x' is 3.5, out of its range: at most 2.5");
  EXPECT_EQ(error_of([] { (void)Config::parse("n = 'x'", "b").integer("n", 1, {.max = 9}); }),
            "b:1: 'n' must be a whole number, at most 9, and it is \"x\"");
  EXPECT_EQ(error_of([] { (void)Config::parse("x = 'y'", "b").number("x", 1); }),
            "b:1: 'x' must be a number, and it is \"y\"")
      << "what has no bounds has no range";
}

TEST(ConfigErrors, NameTheTypeThatIsWanted) {
  const Config cfg = Config::parse("a = 'x'\nb = 1.0\nc = [1, 2]\nd = 1", "a.toml");
  EXPECT_EQ(error_of([&] {
              (void)cfg.number("a", 1, {0, 2}, "N");
            }),
            "a.toml:1: 'a' must be a number, 0 to 2 N, and it is \"x\"");
  EXPECT_EQ(error_of([&] { (void)cfg.integer("b", 1); }),
            "a.toml:2: 'b' must be a whole number, and it is 1.0");
  EXPECT_EQ(error_of([&] {
              (void)cfg.numbers<3>("c", {{0, 0, 0}});
            }),
            "a.toml:3: 'c' must be a list of 3 numbers, and it has 2");
  EXPECT_EQ(error_of([&] { (void)cfg.flag("d", true); }), "a.toml:4: 'd' must be true or false, and it is 1");
}

TEST(ConfigErrors, RefuseIntegersThatTheirTypeCannotHold) {
  const Config cfg = Config::parse("a = 70000\nb = -1", "a.toml");
  EXPECT_THROW((void)cfg.integer<std::uint16_t>("a", 0), ConfigError);
  EXPECT_THROW((void)cfg.integer<std::uint64_t>("b", 0), ConfigError);
  EXPECT_EQ(cfg.integer<std::int32_t>("a", 0), 70000);
}

TEST(ConfigErrors, RefuseNumbersThatAreNotFinite) {
  for (const char* value : {"nan", "inf", "-inf"}) {
    Config cfg;
    cfg.set(std::string("x=") + value);
    EXPECT_EQ(error_of([&] { (void)cfg.number("x", 0); }),
              std::string("--set x=") + value + ": 'x' is not a finite number");
  }
}

TEST(ConfigErrors, NameTheMissingKey) {
  EXPECT_EQ(error_of([] {
              (void)robots().number("robots.arm1.weight", Config::kRequired, {0, 100}, "N");
            }),
            "robots.toml: the key 'robots.arm1.weight' is missing, it must be a number, 0 to 100 N");
}

TEST(ConfigErrors, OfAKeyThatLayersLackNameTheLowestFile) {
  const auto missing = [](Config lower) {
    lower.overlay(Config::parse("b = 2\n", "upper.toml"));
    return error_of([&] { (void)lower.number("c", Config::kRequired); });
  };
  EXPECT_TRUE(missing(Config::parse("a = 1\n", "lower.toml")).starts_with("lower.toml:"));
  EXPECT_TRUE(missing({}).starts_with("upper.toml:"));
}

TEST(ConfigErrors, NameFileLineAndNearestKeyOfAnUnknownOne) {
  const Config cfg = Config::parse("\n[sim.paper]\nstifness = 1e4\n", "a.toml");
  (void)cfg.number("sim.paper.stiffness", 1e4);
  (void)cfg.number("sim.paper.damping", 10);
  try {
    cfg.check_all_used();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "a.toml:3: unknown key 'sim.paper.stifness', did you mean 'sim.paper.stiffness'?");
    EXPECT_EQ(error.place().file, "a.toml");
    EXPECT_EQ(error.place().line, 3);
    EXPECT_EQ(error.key(), "sim.paper.stifness");
  }
}

TEST(ConfigErrors, SayWhetherTheFileOrTheOptionIsToBeCorrected) {
  const auto told = [](const auto& f) -> std::string {
    try {
      f();
    } catch (const ConfigError& error) {
      return error.error_line();
    }
    return "";
  };
  const std::string broken = told([] { Config::parse("a = = 1", "run/config.toml"); });
  EXPECT_TRUE(broken.ends_with("; correct that file")) << broken;
  Config cfg = Config::parse("a = 1", "a.toml");
  cfg.set("b=2");
  EXPECT_TRUE(told([&] { (void)cfg.text("a", ""); }).ends_with("; correct that file"));
  EXPECT_TRUE(told([&] { (void)cfg.text("b", ""); }).ends_with("; correct that --set option"));
  const std::string missing = told([&] { (void)cfg.text("c", Config::kRequired); });
  EXPECT_TRUE(missing.ends_with("; correct the file or the --set option named")) << missing;
}

TEST(ConfigErrors, FindTheKeyInAnotherTable) {
  Config cfg;
  cfg.set("stiffness=1");
  (void)cfg.number("sim.paper.stiffness", 1e4);
  EXPECT_EQ(error_of([&] { cfg.check_all_used(); }),
            "--set stiffness=1: unknown key 'stiffness', did you mean 'sim.paper.stiffness'?");
}

TEST(ConfigErrors, FindTheKeyThatLiesLeastDeep) {
  Config cfg;
  cfg.set("force=1");
  for (const char* key : {"arms.arm1.oscillation.force", "task.force", "world.force", "x.y.force"})
    (void)cfg.number(key, 1);
  EXPECT_EQ(error_of([&] { cfg.check_all_used(); }),
            "--set force=1: unknown key 'force', did you mean 'task.force'?");
}

TEST(ConfigErrors, ListTheKeysOfTheTableWhenNoneIsNear) {
  const Config cfg = Config::parse("[sim]\nxyzzy = 1\nplugh = 2", "a.toml");
  (void)cfg.number("sim.stiffness", 1e4);
  (void)cfg.number("sim.damping", 10);
  EXPECT_EQ(error_of([&] { cfg.check_all_used(); }),
            "a.toml:2: unknown key 'sim.xyzzy', known keys there: damping, stiffness (1 more is unknown)");
}

TEST(ConfigErrors, NameUnknownTablesWithoutKeys) {
  const Config cfg = Config::parse("[robots.arm1]\n[simm]\n", "a.toml");
  (void)cfg.tables("robots");
  (void)cfg.number("sim.step", 1);
  EXPECT_EQ(error_of([&] { cfg.check_all_used(); }).substr(0, 28), "a.toml:2: unknown key 'simm'");
}

TEST(ConfigErrors, AreLimitedToTheSectionThatIsChecked) {
  const Config cfg = robots();
  const Config arm = cfg.section("robots.arm1");
  (void)arm.text("model", "");
  (void)arm.number("track", 0);
  EXPECT_THROW(arm.check_all_used(), ConfigError);
  (void)arm.numbers<3>("gains", Config::kRequired);
  EXPECT_NO_THROW(arm.check_all_used());
  EXPECT_THROW(cfg.check_all_used(), ConfigError);
}

TEST(ConfigErrors, NameTheOptionThatCannotBeSet) {
  EXPECT_EQ(set_error("clock"), "--set clock: a value is set as key=value");
  EXPECT_EQ(set_error("robots=1"), "--set robots=1: 'robots' is a table and cannot have a value");
  EXPECT_EQ(set_error("clock.x=1"), "--set clock.x=1: 'clock' is a value and cannot be a table");
  for (const char* wrong : {"=1", "a=", "a=[1,", "a b=1", "a=\"", "a=x y", "a=[[1]]"})
    EXPECT_EQ(set_error(wrong).substr(0, 6), "--set ") << wrong;
}

TEST(ConfigErrors, NameTheKeyBelowWhatTheProgramTakesForAValue) {
  Config cfg = robots();
  cfg.set("sensor.gain=1.02");
  EXPECT_EQ(error_of([&] { (void)cfg.text("sensor", "small"); }),
            "--set sensor.gain=1.02: 'sensor' is a value, it has no key 'sensor.gain'");
}

TEST(ConfigErrors, NameTheSectionsWhereAKeyIsInNone) {
  Config cfg = Config::parse("", "a.toml");
  cfg.set("task.xyzzy=1");
  (void)cfg.number("sim.step", 1);
  (void)cfg.text("clock", "step");
  EXPECT_EQ(error_of([&] { cfg.check_all_used(); }),
            "--set task.xyzzy=1: unknown key 'task.xyzzy', nothing is known there; there are clock, sim");
}

TEST(ConfigErrors, NameTheValueThatStandsWhereOtherKeysBelong) {
  Config cfg = Config::parse("", "a.toml");
  cfg.set("sim.paper=3");
  EXPECT_EQ(
      error_of([&] { (void)cfg.number("sim.paper.height", 1); }),
      "--set sim.paper=3: 'sim.paper' takes no value, it has keys of its own, such as 'sim.paper.height'");
}

TEST(ConfigErrors, RefuseWhatHasNoUse) {
  for (const char* text :
       {"'a b' = 1", "'a.b' = 1", "a = [[1, 2], [3]]", "a = [1, 'x']", "[[a]]\nb = 1", "a = 07:32:00"})
    EXPECT_EQ(syntax_error(text).substr(0, 9), "a.toml:1:") << text;
}

TEST(ConfigErrors, FindTwoDefaultsOfOneKey) {
  const Config cfg;
  (void)cfg.number("a", 1);
  EXPECT_THROW((void)cfg.number("a", 2), FaultError);
  EXPECT_NO_THROW((void)cfg.number("a", 1));
}

TEST(ConfigErrors, SurviveAnyDamageToTheText) {
  std::mt19937 random(1);
  const std::string text = kRobots;
  for (int k = 0; k < 5000; ++k) {
    std::string damaged = text;
    for (int n = 0; n <= k % 3; ++n) damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    try {
      const Config cfg = Config::parse(damaged, "a.toml");
      EXPECT_EQ(Config::parse(cfg.dump(), "dump").dump(), cfg.dump());
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 7), "a.toml:");
    }
  }
}

TEST(Config, TellsWhatHasBeenAskedForWithValuesRangesAndUnits) {
  const Config c = Config::parse("b = 2\na = 'word'\nunused = 1\n[t]\nlist = [1, 2]\n", "a.toml");
  EXPECT_TRUE(c.parameters().empty()) << "nobody has asked yet";
  EXPECT_EQ(c.number("b", 1.0, {0, 5}, "m"), 2);
  EXPECT_EQ(c.text("a", std::nullopt), "word");
  EXPECT_EQ(c.number("new", 7.5, {}, "s"), 7.5);
  EXPECT_EQ(c.section("t").list("list", std::nullopt, {}, "N").size(), 2U);
  const std::vector<ConfigParameter> all = c.parameters();
  ASSERT_EQ(all.size(), 4U);
  const auto told = [&](std::size_t k) {
    return all[k].key + " = " + all[k].value + " # " + all[k].range + " # " + all[k].unit;
  };
  EXPECT_EQ(told(0), "a = \"word\" #  # ");
  EXPECT_EQ(told(1), "b = 2.0 # 0 to 5 # m");
  EXPECT_EQ(told(2), "new = 7.5 #  # s");
  EXPECT_EQ(told(3), "t.list = [1.0, 2.0] #  # N");
}

TEST(Config, LoadsFiles) {
  const auto file = std::filesystem::temp_directory_path() / "mrroc_config_test.toml";
  std::ofstream(file) << kRobots;
  EXPECT_EQ(Config::load(file).dump(), robots().dump());
  EXPECT_EQ(
      error_of([&] { (void)Config::load(file).number("clock", 1); }).substr(0, file.string().size() + 3),
      file.string() + ":1:");
  std::filesystem::remove(file);
}

TEST(Config, CopyKnowsTheSameAndRemembersForItself) {
  const Config config = Config::parse("[a]\nx = 1\ny = 2\n", "test");
  const Config copy = config.copy();
  EXPECT_EQ(copy.number("a.x", 0), 1);
  EXPECT_EQ(copy.number("a.y", 0), 2);
  EXPECT_NO_THROW(copy.check_all_used());
  EXPECT_THROW(config.check_all_used(), ConfigError);
}

}  // namespace
}  // namespace mrroc::test
