// Pictures that stand still although the wheels turn.
#include "tasks/rex_drive/still_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "test/tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr std::int64_t kPair = 40;  // steps: 80 ms

/// Wheels and pictures, pair by pair.
class Still : public testing::Test {
 protected:
  /// The wheels turn by so much between two pictures, and the pictures show that. @return whether they contradict one another
  bool goes_on(double theta, double x, double turn = 0, bool valid = true) {
    for (std::int64_t k = 1; k <= kPair / 10; ++k) {
      theta_ += theta * 10 / static_cast<double>(kPair);
      step_ += 10;
      watch_ = watched(watch_, wheels_at(step_, {theta_, -theta_, theta_, -theta_}));
    }
    OdometryReading r{.step_before = step_ - kPair, .step = step_, .valid = valid};
    r.A = {std::cos(turn), -std::sin(turn), 0, x, std::sin(turn), std::cos(turn), 0, 0, 0, 0, 1, 0};
    still_ = seen(still_, r, watch_);
    return still_.against_wheels;
  }

  std::int64_t step_{};
  double theta_{};
  WheelWatch watch_ = watched({}, wheels_at(0, {}));
  StillPictures still_;
};

TEST_F(Still, ContradictWheelsThatTurnByMoreThanTheyCanSlip) {
  EXPECT_FALSE(goes_on(0.056, 0)) << "the beginning of a start";
  EXPECT_TRUE(goes_on(0.08, 0));
  EXPECT_TRUE(goes_on(0, 0)) << "until they move again";
  EXPECT_FALSE(goes_on(0.08, 0.012));
  EXPECT_FALSE(goes_on(0, 0)) << "at rest";
}

// At 0.02 m/s they turn by a hundredth of a radian from pair to pair.
TEST_F(Still, ContradictAlsoWheelsThatTurnSlowlyAndStayAPartOfTheNoise) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1e-4);
  int pairs = 0;
  while (pairs < 100 && !goes_on(-0.0107, noise(random), noise(random))) ++pairs;
  EXPECT_EQ(pairs, 5);
  for (int n = 0; n < 20; ++n) EXPECT_TRUE(goes_on(-0.0107, noise(random), noise(random))) << n;
}

TEST_F(Still, DoNotContradictAMotion) {
  for (const double theta : {0.0, 0.08, 0.6, -0.6})
    for (const auto& [x, turn] : {std::pair(0.0011, 0.), {-0.0011, 0.}, {0., 0.0011}, {0., -0.0011}})
      for (int n = 0; n < 3; ++n) EXPECT_FALSE(goes_on(theta, x, turn)) << theta << ' ' << x;
}

// 0.9 mm from pair to pair are less than a pair is trusted to show.
TEST_F(Still, DoNotContradictAPlatformThatCreeps) {
  for (int n = 0; n < 200; ++n) EXPECT_FALSE(goes_on(0.006, 0.0009)) << n;
}

TEST_F(Still, SayNothingByReadingsThatAreNotValidOrNotNew) {
  for (int n = 0; n < 10; ++n) EXPECT_FALSE(goes_on(0.08, 0, 0, false));
  EXPECT_TRUE(goes_on(0.08, 0));
  EXPECT_TRUE(goes_on(0, 0.1, 0, false)) << "they stand as they stood";
  const StillPictures before = still_;
  OdometryReading again{.step_before = step_ - kPair, .step = before.step, .valid = true};
  again.A[3] = 0.1;
  EXPECT_TRUE(seen(before, again, watch_).against_wheels);
}

TEST_F(Still, AreNotHeldAgainstWheelsOfWhichNobodyKnows) {
  OdometryReading r{.step_before = 1000, .step = 1040, .valid = true};
  r.A = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  EXPECT_FALSE(seen({}, r, watch_).against_wheels);
  EXPECT_FALSE(seen({}, r, {}).against_wheels);
}

}  // namespace
}  // namespace mrroc::rex_drive
