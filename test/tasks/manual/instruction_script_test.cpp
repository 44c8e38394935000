// The operator's language: what is understood, and what is refused with the way to write it.
#include "tasks/manual/instruction_script.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/fault.hpp"
#include "robots/irb6/arm.hpp"
#include "tasks/manual/config.hpp"

namespace mrroc::manual {
namespace {

const std::vector<ArmInfo> kArms{{"arm1", 6, {{"front", {0, -1.57, 0, 1.56, 1.57, -1.57}}}, true},
                                 {"arm2", 7, {{"front", {0.1, 0, -1.57, 0, 1.56, 1.57, -1.57}}}}};

ManualOrder only(std::string_view line) {
  const Instructions i = understand(line, kArms);
  EXPECT_EQ(i.orders.size(), 1U) << line;
  return i.orders.at(0);
}

std::string refusal(std::string_view line) {
  try {
    static_cast<void>(understand(line, kArms));
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    return e.error_line();
  }
  return "";
}

TEST(Words, AMotionHasAsManyNumbersAsItsSpace) {
  const ManualOrder o = only("move arm1 joints 0.1 -1.5 0 1.5 1.5 -1.5 speed 0.3 acceleration 0.1");
  EXPECT_EQ(o.kind, Kind::move);
  EXPECT_EQ(o.space, Representation::joints);
  EXPECT_EQ(o.reference, Reference::absolute);
  EXPECT_EQ(o.value[1], -1.5);
  EXPECT_EQ(o.velocity, 0.3);
  EXPECT_EQ(o.acceleration, 0.1);
  EXPECT_EQ(only("jog arm2 motors 1 2 3 4 5 6 7").reference, Reference::relative);
  EXPECT_EQ(only("jog arm2 motors 1 2 3 4 5 6 7").value[6], 7);
  EXPECT_EQ(only("move arm2 angle-axis 1 2 3 4 5 6").space, Representation::xyz_angle_axis);
  EXPECT_EQ(only("jog arm1 euler 0 0 0.01 0 0 0").space, Representation::xyz_euler_zyz);
  EXPECT_NE(refusal("move arm1 joints 1 2 3 4 5").find("missing"), std::string::npos);
  EXPECT_NE(refusal("move arm1 joints 1 2 3 4 5 6 7").find("one word too many"), std::string::npos);
  EXPECT_NE(refusal("move arm2 joints 1 2 3 4 5 6").find("a number is missing: arm2 wants 7, there are 6"),
            std::string::npos);
  EXPECT_NE(refusal("jog arm1 motors 1 speed 0.5").find("arm1 wants 6, there is 1"), std::string::npos);
}

TEST(Words, AnInstructionIsForOneArmSeveralOrAll) {
  EXPECT_EQ(understand("home all", kArms).arms, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(understand("home arm2,arm1,arm2", kArms).arms, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(understand("stop arm2", kArms).arms, std::vector<std::size_t>{1});
  const Instructions presets = understand("preset all front speed 0.5", kArms);
  EXPECT_EQ(presets.orders.at(0).value[1], -1.57);
  EXPECT_EQ(presets.orders.at(1).value[0], 0.1);
  EXPECT_NE(refusal("home arm3").find("there are arm1, arm2 and all"), std::string::npos);
  EXPECT_NE(refusal("preset arm1 rear").find("it has front"), std::string::npos);
}

TEST(Words, EveryPresetOfTheOriginalIsThereForEveryArm) {
  const std::vector<ArmInfo> arms = read_arms(Config::parse(std::string(config()), "manual.toml"));
  ASSERT_EQ(arms.size(), 2U);
  for (const char* name : {"synchro", "front", "0", "1", "2"})
    EXPECT_EQ(understand(fmt::format("preset all {}", name), arms).orders.size(), 2U) << name;
}

TEST(Words, SynchroIsWhereAllMotorsAreAtZero) {
  const std::vector<ArmInfo> arms = read_arms(Config::parse(std::string(config()), "manual.toml"));
  for (const auto& [info, model] : {std::pair{arms.at(0), "irb6_postument"}, {arms.at(1), "irb6_track"}}) {
    const auto robot = irb6::make_arm(model);
    const AxisVector zero = robot->joints_from_motors(AxisVector::Zero(robot->axes()));
    for (int k = 0; k < robot->axes(); ++k)
      EXPECT_NEAR(info.presets.at("synchro")[static_cast<std::size_t>(k)], zero[k], 2e-5) << model << k;
  }
}

TEST(Words, EverythingElseThatAnArmCanBeTold) {
  EXPECT_EQ(only("reset arm1").kind, Kind::reset);
  EXPECT_EQ(only("bias arm1").kind, Kind::bias);
  EXPECT_EQ(only("tool arm1 0 0 0.2 0 0 0").value[2], 0.2);
  EXPECT_EQ(only("weight arm1 7.5").value[0], 7.5);
  EXPECT_EQ(only("weight arm1 7.5 0 0 0.06").value[3], 0.06);
  EXPECT_EQ(only("model arm1 2").model, 2);
  EXPECT_EQ(only("servo arm1 1").algorithm, 1);
  EXPECT_EQ(only("servo arm1 0 1").parameter_set, 1);
  EXPECT_EQ(only("gripper arm1 0.07").value[0], 0.07);
  EXPECT_TRUE(understand("end", kArms).end);
}

TEST(Words, WhatIsNotUnderstoodIsRefusedWithTheWayToWriteIt) {
  EXPECT_NE(refusal("jgo arm1 motors 1 2 3 4 5 6").find("did you mean 'jog'"), std::string::npos);
  EXPECT_NE(refusal("move arm1 legs 1 2 3").find("motors, joints, euler and angle-axis"), std::string::npos);
  EXPECT_NE(refusal("gripper arm1").find("gripper ARM METRES"), std::string::npos);
  EXPECT_NE(refusal("gripper all 0.07").find("arm2 has no gripper"), std::string::npos);
  for (const char* line :
       {"", "home", "home arm1 now", "gripper arm1 -1", "gripper arm1 nan", "model arm1 1.5",
        "move arm1 joints 1 2 3 4 5 inf", "jog arm1 joints 1 2 3 4 5 6 speed 0",
        "jog arm1 joints 1 2 3 4 5 6 speed 2", "end now", "servo arm1 -1"})
    EXPECT_NE(refusal(line), "") << line;
}

TEST(Words, NumbersHaveTheirBounds) {
  EXPECT_EQ(only("model arm1 1000").model, 1000);
  EXPECT_EQ(only("model arm1 0").model, 0);
  EXPECT_NE(refusal("model arm1 1001").find("a model is a whole number from 0 to 1000"), std::string::npos);
  EXPECT_EQ(only("servo arm1 255 255").parameter_set, 255);
  EXPECT_EQ(only("servo arm1 255 255").algorithm, 255);
  EXPECT_NE(refusal("servo arm1 256").find("an algorithm is a whole number from 0 to 255"),
            std::string::npos);
  EXPECT_NE(refusal("servo arm1 0 256").find("a parameter set is a whole number from 0 to 255"),
            std::string::npos);
  EXPECT_EQ(only("jog arm1 joints 1 2 3 4 5 6 speed 1 acceleration 1").acceleration, 1);
  EXPECT_NE(refusal("jog arm1 joints 1 2 3 4 5 6 speed 1.001").find("a share is above 0 and at most 1"),
            std::string::npos);
  EXPECT_NE(refusal("gripper arm1 0").find("a distance of jaws is above 0"), std::string::npos);
  EXPECT_NE(refusal("weight arm1 7 1 2").find("the mass centre is missing"), std::string::npos);
  EXPECT_NE(refusal("tool arm1 1 2 3 4 5").find("arm1 wants 6, there are 5"), std::string::npos);
}

TEST(Words, ALongWordIsToldByItsBeginning) {
  EXPECT_NE(refusal(std::string(32, 'q') + " arm1").find("there is no '" + std::string(32, 'q') + "'"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(33, 'q') + " arm1").find("there is no '" + std::string(32, 'q') + "..'"),
            std::string::npos);
}

TEST(Words, SpeedsOfPresetsAndTheUsualOnes) {
  const ManualOrder o = only("preset arm1 front speed 0.5 acceleration 0.25");
  EXPECT_EQ(o.kind, Kind::move);
  EXPECT_EQ(o.space, Representation::joints);
  EXPECT_EQ(o.reference, Reference::absolute);
  EXPECT_EQ(o.velocity, 0.5);
  EXPECT_EQ(o.acceleration, 0.25);
  EXPECT_EQ(only("preset arm1 front").velocity, ManualOrder{}.velocity);
  EXPECT_NE(refusal("preset arm1 front now").find("'now' is one word too many"), std::string::npos);
  EXPECT_NE(refusal("end arm1").find("`end` stands alone"), std::string::npos);
  EXPECT_NE(refusal("").find("what is to be done is missing"), std::string::npos);
  EXPECT_NE(refusal("home").find("the arm is missing; it is written `home ARM`"), std::string::npos)
      << refusal("home");
}

TEST(Words, AScriptIsReadInTheOrderOfMacrostepsAndRefusedWithItsLine) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "instruction_script_test.txt";
  const auto read = [&](const std::string& text) {
    std::ofstream(file) << text;
    return load_script(file, kArms);
  };
  const auto script = read("# all\n\n 20 home all # later\n5   bias arm1\n20 stop arm2\n");
  ASSERT_EQ(script.size(), 3U);
  EXPECT_EQ(script[0].i, 5);
  EXPECT_EQ(script[0].instruction, "bias arm1");
  EXPECT_EQ(script[1].instruction, "home all ");
  EXPECT_EQ(script[2].i, 20);
  const auto wrong = [&](const std::string& text) -> std::string {
    try {
      static_cast<void>(read(text));
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_script);
      return e.what();
    }
    return "";
  };
  EXPECT_NE(
      wrong("1 home all\n0 home all\n").find("instruction_script_test.txt:2: a line is MACROSTEP WORDS..."),
      std::string::npos);
  EXPECT_NE(wrong("\nhome all\n").find("instruction_script_test.txt:2: a line is MACROSTEP WORDS..."),
            std::string::npos);
  EXPECT_NE(wrong("1 home all\n\n3 dance\n").find("instruction_script_test.txt:3: there is no 'dance'"),
            std::string::npos);
  EXPECT_EQ(wrong("1 home all\n"), "");
  EXPECT_EQ(wrong("# " + std::string(1'000'000 - 2, 'x')), "");
  EXPECT_NE(wrong("# " + std::string(1'000'000 - 1, 'x')), "");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace mrroc::manual
