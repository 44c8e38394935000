// The command line's options for the cube, as configuration.
#include "tasks/rubik/options.hpp"

#include <gtest/gtest.h>

#include "base/command_line.hpp"
#include "base/fault.hpp"

namespace mrroc::rubik {
namespace {

CubeOptions parsed(const std::vector<std::string>& words) {
  CubeOptions options;
  CommandLine line;
  add_cube_options(line, options);
  line.parse(words);
  return options;
}

std::string random_turns(const std::string& toml) {
  Config config = Config::parse(toml, "test.toml");
  complete_cube(config);
  return config.has("cube.random_turns") ? std::to_string(config.integer("cube.random_turns", 0)) : "none";
}

TEST(CubeOptions, SayNothingOfTheCubeUnlessTheyAreGiven) {
  EXPECT_TRUE(cube_settings(parsed({})).empty());
  EXPECT_TRUE(cube_settings(parsed({"--eyes", "none"})).empty());
  EXPECT_FALSE(parsed({}).eyes);
}

TEST(CubeOptions, AreTheWholeStateOfTheCube) {
  const std::vector<std::string> scrambled{"cube.scramble=\"R U' F2\"", "cube.state=\"\"",
                                           "cube.random_turns=0"};
  EXPECT_EQ(cube_settings(parsed({"--scramble", "R U' F2"})), scrambled);
  const std::vector<std::string> solved{"cube.scramble=\"\"", "cube.state=\"\"", "cube.random_turns=0"};
  EXPECT_EQ(cube_settings(parsed({"--scramble", ""})), solved);
  const std::vector<std::string> told{"cube.scramble=\"\"", "cube.state=\"UUU\"", "cube.random_turns=0"};
  EXPECT_EQ(cube_settings(parsed({"--state", "UUU"})), told);
}

TEST(CubeOptions, AStateWithoutFaceletsAndAStateBesideTurnsAreRefused) {
  EXPECT_THROW(std::ignore = cube_settings(parsed({"--state", ""})), FaultError);
  EXPECT_THROW(parsed({"--state", "UUU", "--scramble", "R"}), FaultError);
  EXPECT_THROW(parsed({"--eyes", "closed"}), FaultError);
}

TEST(CubeOptions, ACubeOfWhichNothingIsSaidIsScrambledByTheSeed) {
  EXPECT_EQ(random_turns(""), "20");
  EXPECT_EQ(random_turns("[cube]\nrandom_turns = 3\n"), "3");
  EXPECT_EQ(random_turns("[cube]\nscramble = \"R\"\n"), "none");
  EXPECT_EQ(random_turns("[cube]\nstate = \"UUU\"\n"), "none");
}

}  // namespace
}  // namespace mrroc::rubik
