// A cube that a configuration gives.
#include "base/cube/cube_config.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/config.hpp"
#include "base/cube/facelets.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

Cube given(const std::string& table) { return read_given_cube(Config::parse("[cube]\n" + table, "a.toml")); }

TEST(GivenCube, IsSolvedWhenNothingIsSaid) { EXPECT_EQ(given(""), Cube{}); }

TEST(GivenCube, TwistTurnsTheCornerAtURFInItsPlaceAndNothingElse) {
  const std::string solved = to_facelets(Cube{});
  const std::string once = to_facelets(given("twist = 1\n")), twice = to_facelets(given("twist = 2\n"));
  // Facelets count U R F D L B, from 0; those of the corner are U9, R1, F3.
  for (std::size_t k = 0; k < solved.size(); ++k) {
    const bool of_the_corner = k == 8 || k == 9 || k == 20;
    EXPECT_EQ(once[k] != solved[k], of_the_corner) << k;
    EXPECT_EQ(twice[k] != solved[k], of_the_corner) << k;
    EXPECT_EQ(once[k] != twice[k], of_the_corner) << k;
  }
}

TEST(GivenCube, OfRandomTurnsIsThatOfItsSeed) {
  const auto of = [](const std::string& seeds) {
    return read_given_cube(Config::parse(seeds + "\n[cube]\nrandom_turns = 12\n", "a.toml"));
  };
  EXPECT_EQ(of("seed = 5"), of("seed = 5"));
  EXPECT_NE(of("seed = 5"), of("seed = 6"));
  EXPECT_EQ(of("seed = 5"), given("random_turns = 12\nseed = 5\n")) << "its own seed or the run's";
  EXPECT_EQ(of(""), of("seed = 1"));
}

TEST(GivenCube, IsGivenInOneWayOnly) {
  EXPECT_THROW(given("scramble = \"R\"\nrandom_turns = 3\n"), FaultError);
  EXPECT_EQ(given("scramble = \"R U'\"\n"),
            given("state = \"" + to_facelets(given("scramble = \"R U'\"")) + "\"\n"));
}

}  // namespace
}  // namespace mrroc::cube
