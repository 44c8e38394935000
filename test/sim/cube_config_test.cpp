// The section [cube], and what it refuses.
#include "sim/cube_config.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "sim/config.hpp"

namespace mrroc::sim {
namespace {

constexpr std::string_view kArms = R"(
[robots]
order = ["arm1", "arm2"]
[robots.arm2]
gripper = "two_jaw"
fingers = "two_layers"
jaws = 0.0568
[cube]
held_by = "arm2"
)";

WorldParameters read(const std::string& cube) {
  return read_world(Config::parse(std::string(kArms) + cube, "test.toml"));
}

TEST(CubeConfig, WithoutAHolderThereIsNoCube) {
  EXPECT_FALSE(read_world(Config::parse("[robots]\norder = [\"arm1\"]\n", "test.toml")).cube);
}

TEST(CubeConfig, TakesAScrambleOrFaceletsOrRandomTurns) {
  const cube::Cube scrambled = cube::after({}, cube::parse_moves("R U' F2"));
  EXPECT_EQ(read("scramble = \"R U' F2\"").cube->state, scrambled);
  EXPECT_EQ(read("state = \"" + cube::to_facelets(scrambled) + "\"").cube->state, scrambled);
  const cube::Cube random = read("random_turns = 20\nseed = 3").cube->state;
  EXPECT_NE(random, cube::Cube{});
  EXPECT_EQ(read("random_turns = 20\nseed = 3").cube->state, random);
  EXPECT_NE(read("random_turns = 20\nseed = 4").cube->state, random);
}

TEST(CubeConfig, PutsTheCubeIntoTheHandThatHoldsIt) {
  const WorldParameters w = read("facing = \"F\"\nseed = 9");
  EXPECT_EQ(w.cube->held_by, 1);
  EXPECT_EQ(w.cube->faces.seed, 9u);
  EXPECT_NEAR((w.cube->T_EC.R * Vector3(0, -1, 0)).z(), 1, 1e-12) << "F points away from the palm";
  ASSERT_TRUE(w.arms[1].gripper);
  EXPECT_EQ(w.arms[1].jaws->start, 0.0568);
  EXPECT_FALSE(w.arms[0].gripper);
  EXPECT_NO_THROW(World(w, 1));
}

TEST(CubeConfig, TakesWhatIsWrongWithTheCubeAndWithItsPlace) {
  const WorldParameters right = read("");
  const WorldParameters wrong = read(
      "[sim.cube]\njam = 12\njam_direction = \"clockwise\"\njam_loosening = 0.5\nfriction = 0.01\n"
      "place_error = { x = 0.03, z = -0.002 }");
  EXPECT_EQ(right.cube->faces.mean.jam_direction, 0);
  EXPECT_EQ(wrong.cube->faces.mean.jam_direction, -1) << "a positive angle is counterclockwise";
  EXPECT_EQ(wrong.cube->faces.jam, 12);
  EXPECT_EQ(wrong.cube->faces.mean.jam_loosening, 0.5);
  EXPECT_EQ(wrong.cube->friction, 0.01);
  EXPECT_LT((wrong.cube->T_EC.p - right.cube->T_EC.p - Vector3(0.03, 0, -0.002)).norm(), 1e-12);
  EXPECT_FALSE(cube::is_reachable(read("scramble = \"R U\"\ntwist = 1").cube->state));
  EXPECT_TRUE(cube::is_reachable(read("scramble = \"R U\"").cube->state));
  EXPECT_THROW(read("[sim.cube]\njam_direction = \"up\""), FaultError);
  EXPECT_THROW(read("[sim.cube]\nplace_error.y = 0.002"), FaultError) << "farther off than a pad gives way";
}

TEST(CubeConfig, TheHandIsClosedOnACubeOfAnotherSizeAsFirmly) {
  for (const double error : {-0.0003, 0.0003}) {
    const WorldParameters w = read("[sim.cube]\nsize_error = " + std::to_string(error));
    EXPECT_NEAR(w.arms[1].jaws->start, 0.0568 + error, 1e-12);
    EXPECT_NEAR(w.cube->edge - w.arms[1].jaws->start, kCubeEdge - 0.0568, 1e-12);
  }
}

TEST(CubeConfig, RefusesWhatContradictsItselfOrCannotBe) {
  EXPECT_THROW(read("scramble = \"R\"\nrandom_turns = 3"), FaultError);
  EXPECT_THROW(read("scramble = \"R Q\""), FaultError);
  EXPECT_THROW(read("state = \"UUU\""), FaultError);
  EXPECT_THROW(read("facing = \"X\""), FaultError);
  EXPECT_THROW(read_world(Config::parse("[cube]\nheld_by = \"arm3\"\n", "test.toml")), FaultError);
}

std::string refusal(const std::string& text) {
  try {
    std::ignore = read_world(Config::parse("[robots]\norder = [\"arm1\"]\n" + text, "test.toml"));
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    return e.error_line();
  }
  return "";
}

TEST(CubeConfig, FingersAreRefusedWithoutAGripperByTheKeyThatGaveThem) {
  const std::string fingers = "fingers = \"two_layers\"\n";
  const std::string given = refusal("[robots.arm1]\n" + fingers);
  EXPECT_NE(given.find(" robots.arm1.fingers: "), std::string::npos) << given;
  EXPECT_NE(given.find("robots.arm1.gripper"), std::string::npos) << "what to give: " << given;
  const std::string own = refusal("[sim.robots.arm1]\n" + fingers);
  EXPECT_NE(own.find(" sim.robots.arm1.fingers: "), std::string::npos) << own;
  EXPECT_EQ(refusal("[robots.arm1]\ngripper = \"two_jaw\"\n" + fingers), "");
}

TEST(CubeConfig, AHandWithoutFingersHoldsNoCube) {
  const std::string error = refusal("[cube]\nheld_by = \"arm1\"\n[robots.arm1]\ngripper = \"two_jaw\"\n");
  EXPECT_NE(error.find("cube.held_by: arm1 has no fingers"), std::string::npos) << error;
}

}  // namespace
}  // namespace mrroc::sim
