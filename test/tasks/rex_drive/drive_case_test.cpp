#include "tasks/rex_drive/drive_case.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "tasks/rex_drive/config.hpp"

namespace mrroc::rex_drive {
namespace {

/// Reads some of what simulator and driver read.
void read(const Config& c) {
  std::ignore = c.numbers<2>("sim.ground.friction", {{0.7, 0.6}});
  std::ignore = c.text("sim.ground.model", "sharp");
  for (const std::string& patch : c.tables("sim.ground.patches")) {
    const Config p = c.section("sim.ground.patches." + patch);
    std::ignore = p.numbers<4>("area", std::nullopt);
    std::ignore = p.number("scale", 0.5);
  }
  std::ignore = c.number("sim.platforms.rex.mass", 40);
  std::ignore = c.numbers<3>("sim.platforms.rex.start", {{0, 0, 0}});
  std::ignore = c.text("platforms.rex.tracker", "nmpc");
  std::ignore = c.text("platforms.rex.estimator", "mhe");
}

DriveCase case_of(const std::vector<std::string>& settings) {
  Config c = Config::parse(config(), "rex_drive.toml");
  for (const std::string& s : settings) c.set(s);
  read(c);
  return drive_case(c, read);
}

TEST(DriveCase, IsToldByTheGround) {
  EXPECT_EQ(case_of({}), DriveCase::usual);
  EXPECT_EQ(case_of({"sim.ground.friction=[0.70, 0.6]", "sim.ground.model=sharp"}), DriveCase::usual);
  EXPECT_EQ(case_of({"sim.ground.friction=[0.35, 0.3]"}), DriveCase::slippery);
  EXPECT_EQ(case_of({"sim.ground.patches.ice.area=[-3, -2, 3, 0]", "sim.ground.patches.ice.scale=0.5"}),
            DriveCase::ice_right);
  EXPECT_EQ(case_of({"sim.ground.model=smooth"}), DriveCase::smooth);
  EXPECT_EQ(case_of({"sim.ground.friction=[0.5, 0.5]"}), DriveCase::other);
}

TEST(DriveCase, IsNotTheUsualOneWithAnotherKernelOrPlatform) {
  EXPECT_EQ(case_of({"platforms.rex.tracker=kinematic"}), DriveCase::other);
  EXPECT_EQ(case_of({"platforms.rex.estimator=ekf"}), DriveCase::other);
  EXPECT_EQ(case_of({"sim.platforms.rex.mass=46"}), DriveCase::other);
}

TEST(DriveCase, IsFastWithMoreThanTheBuiltInSpeeds) {
  EXPECT_EQ(case_of({"task.speed=0.4"}), DriveCase::usual);
  EXPECT_EQ(case_of({"task.speed=0.8"}), DriveCase::fast);
  EXPECT_EQ(case_of({"task.lateral=1.7"}), DriveCase::fast);
  EXPECT_EQ(case_of({"task.speed=0.8", "sim.ground.friction=[0.35, 0.3]"}), DriveCase::slippery);
}

TEST(DriveCase, IsTheUsualOneOfEveryBuiltInPlanWhereverItBegins) {
  EXPECT_EQ(case_of({"task.plan=slalom", "sim.platforms.rex.start=[1, 0, 0]"}), DriveCase::usual);
}

TEST(DriveCase, IsNotTheUsualOneWithAPlanOfTheUsers) {
  EXPECT_EQ(case_of({"task.plan=\"/somewhere/points.txt\""}), DriveCase::own_plan);
  EXPECT_EQ(case_of({"task.plan=\"/somewhere/points.txt\"", "task.speed=0.8"}), DriveCase::fast);
  EXPECT_EQ(case_of({"task.plan=\"/somewhere/points.txt\"", "platforms.rex.tracker=kinematic"}),
            DriveCase::other);
}

/// Reads some of what cameras and odometry read.
void read_eyes_too(const Config& c) {
  for (const char* const camera : {"cameras.rex_left", "cameras.rex_right"}) {
    const Config t = c.section(camera);
    std::ignore = t.number("fx", std::nullopt);
    std::ignore = t.numbers<2>("black", {{0, 0}});
  }
  std::ignore = c.number("odometry.rex.features", 600);
}

TEST(DriveCase, EyesAreChangedWhereTheyDifferFromTheBuiltInOnes) {
  const auto changed = [](const std::vector<std::string>& settings) {
    Config c = Config::parse(config(), "rex_drive.toml");
    for (const std::string& s : settings) c.set(s);
    if (c.flag("task.eyes", true)) c.underlay(Config::parse(eyes(), "eyes.toml"));
    if (c.flag("task.eyes", true)) read_eyes_too(c);
    return changed_eyes(c, read_eyes_too);
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(changed({}), Keys{});
  EXPECT_EQ(changed({"cameras.rex_left.fx=420", "odometry.rex.features=600"}), Keys{})
      << "as they are anyhow";
  EXPECT_EQ(changed({"cameras.rex_left.black=[1, 2]"}), Keys{"cameras.rex_left.black"});
  EXPECT_EQ(changed({"cameras.rex_right.fx=400", "odometry.rex.features=50"}),
            (Keys{"cameras.rex_right.fx", "odometry.rex.features"}));
  EXPECT_EQ(changed({"task.eyes=false"}), Keys{});
}

}  // namespace
}  // namespace mrroc::rex_drive
