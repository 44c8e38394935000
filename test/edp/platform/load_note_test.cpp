// What the user is told of load cells that are wrong.
#include "edp/platform/load_note.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr PlatformProperties kPlatform{.name = "any", .increments_per_turn = 4000, .max_torque = 20};
constexpr PerWheel kAtRest{100, 100, 100, 100};

/// The load cells of a platform, macrostep by macrostep.
class Cells {
 public:
  Cells() { sensors_.set_static_load(kAtRest); }
  /// Macrosteps with the same readings. @return lines that come of them
  std::vector<std::string> tell(int macrosteps, const PerWheel& load, bool valid = true) {
    std::vector<std::string> lines;
    for (int k = 0; k < macrosteps; ++k) {
      sensors_.measure({.load = load, .load_valid = valid});
      std::ignore = sensors_.take(0);
      if (std::string line = note_.next(sensors_); !line.empty()) lines.push_back(std::move(line));
    }
    return lines;
  }

 private:
  StageCollector sensors_{kPlatform, 0.002};
  LoadNote note_;
};

constexpr PerWheel kOneWrong{100, 181, 100, 100};
constexpr int kAfter = StageCollector::kLoadsWrong;

TEST(LoadNote, CellsThatAreWrongAreToldOnceWithTheirSumAndTheWeight) {
  Cells cells;
  EXPECT_TRUE(cells.tell(100, {100, 179, 100, 100}).empty()) << "within a fifth";
  EXPECT_TRUE(cells.tell(kAfter - 1, kOneWrong).empty()) << "a bump of the ground";
  const auto lines = cells.tell(1, kOneWrong);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            "the load cells tell 481 N in all, of 400 N that were weighed: the platform goes on with the "
            "loads at rest");
  EXPECT_TRUE(cells.tell(100, kOneWrong).empty()) << "it has been told";
  EXPECT_TRUE(cells.tell(10, kAtRest).empty());
  EXPECT_TRUE(cells.tell(100, kOneWrong).empty()) << "it has been told before";
}

TEST(LoadNote, OnlyStagesInSuccessionCount) {
  Cells cells;
  for (int round = 0; round < 10; ++round) {
    EXPECT_TRUE(cells.tell(kAfter - 1, kOneWrong).empty());
    EXPECT_TRUE(cells.tell(1, kAtRest).empty());
  }
}

TEST(LoadNote, CellsThatAreSilentOrTellNoNumbersAreToldToBeSilent) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [load, valid] :
       {std::pair(kAtRest, false), std::pair(PerWheel{100, kNan, 100, 100}, true)}) {
    Cells cells;
    const auto lines = cells.tell(100, load, valid);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("the load cells are silent, of 400 N")) << lines[0];
  }
}

TEST(LoadNote, ADriverThatHasNotWeighedItsPlatformTellsNothing) {
  PlatformRig rig;
  LoadNote note;
  rig.ground.load_scale = 3;
  rig.after_each_step = [&] { EXPECT_EQ(note.next(rig.driver.sensors()), ""); };
  rig.wait(20);
  ASSERT_TRUE(rig.synchronise());
  rig.wait(20);
  rig.after_each_step = {};
  rig.ground.load_scale = 1.5;
  rig.wait(kAfter + 1);
  EXPECT_NE(note.next(rig.driver.sensors()), "");
}

}  // namespace
}  // namespace mrroc::edp::test
