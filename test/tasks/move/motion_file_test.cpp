#include "tasks/move/motion_file.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <random>

#include "test/tasks/move/straight_arm.hpp"

namespace mrroc::any_motion {
namespace {

const std::string kGood = R"(together = true
[arm1]
start = [0, 0, 0, 0, 0, 0]
order = ["a", "b", "a"]
[arm1.a]
generator = "cubic"
space = "xyz_euler_zyz"
reference = "relative"
interpolation = "tcim"
times = [1.0, 2.5]
positions = [
  0.1, 0, 0, 0, 0, 0,
  0, 0.2, 0, 0, 0, 0.3,
]
[arm1.b]
generator = "hold"
time = 0.5
)";

/// @return what is wrong with a text
std::string error(const std::string& text) {
  try {
    std::ignore = file_of_text(text);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(MotionFile, HasTheMotionsInTheirOrderAsOftenAsTheyAreNamed) {
  const MotionFile file = file_of_text(kGood);
  EXPECT_TRUE(file.together);
  ASSERT_EQ(file.arms.size(), 2U);
  EXPECT_FALSE(file.arms[1].moves());
  const ArmMotions& arm = file.arms[0];
  ASSERT_EQ(arm.motions.size(), 3U);
  EXPECT_EQ(arm.motions[0].name, "arm1.a");
  EXPECT_EQ(arm.motions[1].generator, Generator::hold);
  EXPECT_EQ(arm.motions[1].duration, 0.5);
  const MotionSpec& a = arm.motions[2];
  EXPECT_EQ(a.generator, Generator::cubic);
  EXPECT_EQ(a.space, Representation::xyz_euler_zyz);
  EXPECT_EQ(a.reference, Reference::relative);
  EXPECT_EQ(a.mu, Interpolation::tcim_pose);
  EXPECT_EQ(a.times, (std::vector{1.0, 2.5}));
  ASSERT_EQ(a.positions.size(), 2U);
  EXPECT_EQ(a.positions[1][5], 0.3);
}

TEST(MotionFile, ErrorsNameFileLineAndKey) {
  const auto expect = [](const std::string& what, const std::string& by, const std::string& place,
                         const std::string& words) {
    const std::string told = error(replaced(kGood, what, by));
    EXPECT_TRUE(told.starts_with("my.toml:" + place)) << told;
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  expect("\"cubic\"", "\"cubical\"", "6:", "did you mean \"cubic\"");
  expect("0, 0.2, 0, 0, 0, 0.3", "0, 0.2, 0",
         "11:", "'arm1.a.positions' has 9 numbers, and a position has 6: position 2 is cut off");
  expect("times = [1.0, 2.5]", "times = [1.0]", "10:", "'arm1.a.times' has 1 time for 2 positions");
  expect("[1.0, 2.5]", "[2.5, 1.0]", "10:", "'arm1.a.times' has a time 2 that does not rise");
  expect("[1.0, 2.5]", "3", "10:", "and it is 3; a list stands in brackets: [3]");
  expect("[1.0, 2.5]", "[[1.0], [2.5]]", "10:", "without lists in it: all numbers one after another");
  expect("\"xyz_euler_zyz\"", "\"joints\"", "9:", "TCIM takes poses in space");
  expect("\"b\", \"a\"]", "\"c\", \"a\"]", "4:", "there is no table [arm1.c]; there are a, b");
  expect("start = [0, ", "start = [", "3:", "'arm1.start' has 5 numbers, and arm1 has 6 joints");
  expect("time = 0.5", "time = -1", "17:", "'arm1.b.time'");
  expect("times", "tines", "10:", "unknown key 'arm1.a.tines', did you mean 'arm1.a.times'");
  expect("[arm1]", "[arm3]", "", "unknown key");
  EXPECT_EQ(error(kGood), "");
}

TEST(MotionFile, KeysOfOtherGeneratorsAreUnknown) {
  const auto with = [](const std::string& generator, const std::string& key) {
    return error("[arm1]\norder = [\"a\"]\n[arm1.a]\ngenerator = \"" + generator +
                 "\"\npositions = [0, 0, 0, 0, 0, 1]\n" + key + "\n");
  };
  EXPECT_EQ(with("trapezoid", "pass = true"), "");
  EXPECT_NE(with("trapezoid", "times = [1.0]"), "");
  EXPECT_NE(with("cubic", "pass = true"), "");
  EXPECT_EQ(with("cubic", "times = [1.0]"), "");
  EXPECT_EQ(with("nurbs", "degree = 1"), "");
  EXPECT_NE(with("linear", "degree = 1"), "");
  EXPECT_EQ(with("replay", "times = [1.0]"), "");
  EXPECT_NE(with("replay", ""), "") << "times are required";
  EXPECT_NE(with("replay", "times = [1.0]\nforces = [0, 0, 1, 0, 0, 0]").find("tcim"), std::string::npos);
}

TEST(MotionFile, AMatrixIsAPoseAndAnythingElseIsNone) {
  const auto with = [](const std::string& matrix) {
    return "[arm1]\norder = [\"a\"]\n[arm1.a]\nspace = \"frame\"\npositions = [" + matrix + "]\n";
  };
  const MotionFile file = file_of_text(with("0, -1, 0, 0.5,  1, 0, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1"));
  const ecp::Coordinates& q = file.arms[0].motions[0].positions[0];
  EXPECT_EQ(file.arms[0].motions[0].planned(), Representation::xyz_angle_axis);
  EXPECT_NEAR(q[0], 0.5, 1e-12);
  EXPECT_NEAR(q[5], M_PI / 2, 1e-12);
  EXPECT_NE(error(with("0, -1, 0, 0.5,  1, 0, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1"))
                .find("position 1 that is no homogeneous matrix"),
            std::string::npos);
}

TEST(MotionFile, WithoutTheNumberOfAxesPositionsOfJointsAreNotCounted) {
  const Config config =
      Config::parse("[arm1]\norder = [\"a\"]\n[arm1.a]\npositions = [1, 2, 3, 4, 5, 6, 7]\n", "f");
  EXPECT_NO_THROW(std::ignore = read_motions(config, {{"arm1", std::nullopt}}));
  EXPECT_THROW(std::ignore = read_motions(config, {{"arm1", 6}}), ConfigError);
  EXPECT_NO_THROW(std::ignore = read_motions(config, {{"arm1", 7}}));
}

// Whatever becomes of the bytes of a file: it is read, or refused by an error that tells the file.
TEST(MotionFile, ADamagedFileIsReadOrRefusedWithItsName) {
  std::mt19937 random(1);
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string text = kGood;
    for (std::size_t n = 1 + random() % 3; n > 0 && !text.empty(); --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, 1 + random() % 20);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), random() % 20));
          break;
        default:
          text.resize(at);
      }
    }
    try {
      const MotionFile file = file_of_text(text);
      for (const ArmMotions& arm : file.arms)
        for (const MotionSpec& m : arm.motions)
          for (const ecp::Coordinates& q : m.positions) ASSERT_TRUE(q.size() == 6 && q.allFinite()) << text;
    } catch (const ConfigError& e) {
      ++refused;
      ASSERT_TRUE(std::string(e.what()).starts_with("my.toml")) << e.what();
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace mrroc::any_motion
