// Plans for the real arms: what their drivers would refuse is found, and what passes is executed.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "tasks/move/cell/arm_body.hpp"
#include "tasks/move/config.hpp"

namespace mrroc::any_motion {
namespace {

Config config_of(const std::string& motions, const std::string& more = "") {
  Config config = Config::parse(std::string(any_motion::config()) + more, "move.toml");
  for (const std::string& setting : settings_of(Config::parse(motions, "my.toml"), {"arm1", "arm2"}))
    config.set(setting);
  return config;
}

std::string refusal(const std::string& motions, const std::string& more = "") {
  const Config config = config_of(motions, more);
  try {
    rehearse(config, read_plan(config, make_arm_body));
  } catch (const FaultError& e) {
    return fmt::format("{}: {}", to_string(e.fault().code), e.what());
  }
  return "";
}

/// A motion away from the front, where the wrist is near its limit.
std::string one(const std::string& keys) {
  return "[arm1]\nstart = [0, -1.57, 0, 1.2, 1.57, -1.57]\norder = [\"a\"]\n[arm1.a]\n" + keys;
}

TEST(MoveRehearsal, TheExampleIsWithinAllLimits) { EXPECT_EQ(refusal(std::string(example())), ""); }

TEST(MoveRehearsal, AJointBeyondItsRangeIsNamedWithTheMotionAndTheTime) {
  const std::string text =
      refusal(one("velocity = [0.15]\nacceleration = [0.1]\npositions = [0, -0.5, 0, 1.2, 1.57, -1.57]\n"));
  EXPECT_TRUE(text.starts_with("joint_limit: arm1.a, ")) << text;
  EXPECT_NE(text.find(" s after its beginning"), std::string::npos) << text;
}

TEST(MoveRehearsal, AStartBeyondARangeIsNamed) {
  EXPECT_TRUE(refusal("[arm1]\nstart = [0, 0, 0, 1.56, 1.57, -1.57]\n")
                  .starts_with("joint_limit: arm1.start: joint 2"));
  EXPECT_EQ(refusal("[arm1]\nstart = [0, -1.57, 0, 1.56, 1.57, -1.57]\n"), "");
}

TEST(MoveRehearsal, AMotorThatWouldTurnTooFastIsNamed) {
  const std::string text =
      refusal(one("space = \"joints\"\ngenerator = \"quintic\"\ntimes = [1.0]\n"
                  "positions = [0, -1.57, 0, 1.2, 1.57, -0.9]\n"));
  EXPECT_TRUE(text.starts_with("too_fast: arm1.a")) << text;
  EXPECT_NE(text.find("motor [rad/s]"), std::string::npos) << text;
}

TEST(MoveRehearsal, TheWorkspaceOfTheToolIsKept) {
  const std::string motion =
      one("generator = \"straight\"\nspace = \"xyz_angle_axis\"\nreference = \"relative\"\n"
          "positions = [0.1, 0, 0, 0, 0, 0]\n");
  EXPECT_EQ(refusal(motion), "");
  ecp::Coordinates start(6);
  start << 0, -1.57, 0, 1.2, 1.57, -1.57;
  const Vector3 p = make_arm_body(config_of(""), "arm1")->pose(start).p;
  const std::string text = refusal(
      motion, fmt::format("[robots.arm1.limits]\nworkspace = [{}, {}, {}, {}, {}, {}]\n", p.x() - 0.05,
                          p.y() - 0.05, p.z() - 0.05, p.x() + 0.05, p.y() + 0.05, p.z() + 0.05));
  EXPECT_TRUE(text.starts_with("outside_workspace: arm1.a")) << text;
}

TEST(MoveRehearsal, TheArmOnTheTrackHasSevenAxes) {
  EXPECT_EQ(refusal("[arm2]\norder = [\"a\"]\n[arm2.a]\npositions = [0.2, 0, -1.57, 0, 1.56, 1.57, -1.57]\n"),
            "");
}

}  // namespace
}  // namespace mrroc::any_motion
