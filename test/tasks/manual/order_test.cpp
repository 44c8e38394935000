// An instruction on its way as a message, and what an arm is by its configuration.
#include "tasks/manual/order.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/fault.hpp"
#include "tasks/manual/config.hpp"

namespace mrroc::manual {
namespace {

TEST(ManualOrder, SurvivesItsWay) {
  ManualOrder o;
  o.number = 12345678901;
  o.kind = Kind::stop;
  o.space = Representation::joints;
  o.reference = Reference::relative;
  for (std::size_t k = 0; k < o.value.size(); ++k) o.value[k] = 0.5 * static_cast<double>(k) - 1;
  o.velocity = 0.3;
  o.acceleration = 0.7;
  o.model = 3;
  o.algorithm = 1;
  o.parameter_set = 2;
  const ManualOrder back = from_message(to_message(o));
  EXPECT_EQ(back.number, o.number);
  EXPECT_EQ(back.kind, o.kind);
  EXPECT_EQ(back.space, o.space);
  EXPECT_EQ(back.reference, o.reference);
  EXPECT_EQ(back.value, o.value);
  EXPECT_EQ(back.velocity, o.velocity);
  EXPECT_EQ(back.acceleration, o.acceleration);
  EXPECT_EQ(back.model, o.model);
  EXPECT_EQ(back.algorithm, o.algorithm);
  EXPECT_EQ(back.parameter_set, o.parameter_set);
}

TEST(ManualOrder, IsTakenWithAKindThatThereIsAndFiniteNumbersOnly) {
  for (int kind = 0; kind <= static_cast<int>(Kind::stop); ++kind) {
    manual_order_t m{};
    m.kind = static_cast<std::int8_t>(kind);
    EXPECT_TRUE(is_proper(m));
    EXPECT_EQ(static_cast<int>(from_message(m).kind), kind);
  }
  for (const int kind : {-1, static_cast<int>(Kind::stop) + 1, 100}) {
    manual_order_t m{};
    m.kind = static_cast<std::int8_t>(kind);
    EXPECT_FALSE(is_proper(m)) << kind;
  }
  manual_order_t m{};
  m.value[15] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_proper(m));
  m = {};
  m.velocity = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_proper(m));
}

constexpr const char* kConfig = R"(
[robots]
order = ["arm2", "arm1"]
[robots.arm1]
axes = 6
gripper = "two_jaw"
presets.synchro = [1, 2, 3, 4, 5, 6]
presets."0" = [0, 0, 0, 0, 0, 0.5]
[robots.arm1.tool]
pose = [0, 0, 0.2, 0, 0, 0]
weight = 5
mass_centre = [0, 0, 0.05]
[robots.arm2]
axes = 7
presets.front = [1, 2, 3, 4, 5, 6, 7]
[robots.arm2.tool]
pose = [0, 0, 0.1, 0, 0, 0]
weight = 6
mass_centre = [0, 0, 0.05]
[time]
n_s = 12
)";

TEST(ManualConfig, TellsTheArmsInTheirOrderWithTheirPresets) {
  const auto arms = read_arms(Config::parse(kConfig, "test.toml"));
  ASSERT_EQ(arms.size(), 2U);
  EXPECT_EQ(arms[0].key, "arm2");
  EXPECT_EQ(arms[0].axes, 7);
  EXPECT_FALSE(arms[0].jaws);
  ASSERT_EQ(arms[0].presets.size(), 1U);
  EXPECT_EQ(arms[0].presets.at("front")[6], 7);
  EXPECT_EQ(arms[1].key, "arm1");
  EXPECT_EQ(arms[1].axes, 6);
  EXPECT_TRUE(arms[1].jaws);
  ASSERT_EQ(arms[1].presets.size(), 2U);
  EXPECT_EQ(arms[1].presets.at("synchro")[5], 6);
  EXPECT_EQ(arms[1].presets.at("0")[5], 0.5);
}

TEST(ManualConfig, TheMemoryOfAnArmHasItsPaceAndItsTool) {
  const Config config = Config::parse(kConfig, "test.toml");
  const Memory c = read_memory(config, "arm2");
  EXPECT_EQ(c.axes, 7);
  EXPECT_EQ(c.pacing.n_s, 12);
  EXPECT_EQ(c.pacing.n_Q, 11);
  EXPECT_EQ(c.pacing.dt, 0.002);
  EXPECT_EQ(c.model.weight, 6);
  EXPECT_EQ(c.model.tool[2], 0.1);
  EXPECT_EQ(read_memory(config, "arm1").model.weight, 5);
}

TEST(ManualConfig, APresetOfAnotherNumberOfJointsIsRefused) {
  EXPECT_THROW(
      (void)read_arms(Config::parse("[robots.arm1]\naxes = 7\npresets.front = [1, 2, 3, 4, 5, 6]\n", "t")),
      FaultError);
  EXPECT_THROW((void)read_arms(Config::parse("[robots.arm1]\naxes = 9\n", "t")), FaultError);
}

TEST(ManualConfig, TheNumberOfStepsHasItsBoundsAndAGripperItsNames) {
  const auto with = [](const std::string& setting) {
    Config config = Config::parse(kConfig, "test.toml");
    config.set(setting);
    return config;
  };
  EXPECT_EQ(read_memory(with("time.n_s=2"), "arm1").pacing.n_Q, 1);
  EXPECT_EQ(read_memory(with("time.n_s=32"), "arm1").pacing.n_Q, 31);
  for (const char* bad : {"time.n_s=1", "time.n_s=33", "time.dt=0.001", "time.dt=0.003"})
    EXPECT_THROW((void)read_memory(with(bad), "arm1"), ConfigError) << bad;
  EXPECT_TRUE(read_arms(with("robots.arm2.gripper=two_jaw"))[0].jaws);
  EXPECT_FALSE(read_arms(with("robots.arm1.gripper=none"))[1].jaws);
  EXPECT_THROW((void)read_arms(with("robots.arm1.gripper=three_jaw")), ConfigError);
  for (const char* bad : {"robots.arm1.presets.synchro=[1, 2, 3, 4, 5, 10.1]",
                          "robots.arm1.presets.synchro=[-10.1, 2, 3, 4, 5, 6]"})
    EXPECT_THROW((void)read_arms(with(bad)), ConfigError) << bad;
  EXPECT_EQ(read_arms(with("robots.arm1.presets.synchro=[-10, 2, 3, 4, 5, 10]"))[1].presets.at("synchro")[0],
            -10);
  EXPECT_EQ(read_arms(Config())[0].key, "arm1") << "one arm, unless it is said";
}

}  // namespace
}  // namespace mrroc::manual
