// What the terminal says of the platform's sensors.
#include "tasks/rex_drive/sensor_words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrroc::rex_drive {
namespace {

TEST(SensorWords, TellTheInliersOfTheLastPairAndTheAgeOfTheMap) {
  EXPECT_EQ(sensor_words({true, 0.124, true, true, 260}), "odometry 260, map 0.1 s");
  EXPECT_EQ(sensor_words({true, 0.124, true, true, {}}), "odometry seen, map 0.1 s");
}

TEST(SensorWords, SayWhatIsLostAndForHowLong) {
  EXPECT_EQ(sensor_words({false, 3.2, true, true, 31}), "odometry 31, map lost 3.2 s");
  EXPECT_EQ(sensor_words({false, 12.4, true, false, 3}), "odometry none, map lost 12 s");
  EXPECT_EQ(sensor_words({false, {}, false, false, {}}), "map lost");
}

TEST(SensorWords, SayNothingOfAnOdometryThatThereIsNot) {
  EXPECT_EQ(sensor_words({true, 0.06, false, false, {}}), "map 0.1 s");
  EXPECT_EQ(sensor_words({true, {}, false, false, {}}), "map seen");
}

TEST(SensorWords, FindRoomInTheStatusWhateverTheNumbers) {
  constexpr std::size_t kRoom = 31;
  for (const double age : {-1e300, -1.0, 9.96, 1e300, std::numeric_limits<double>::infinity()})
    for (const int inliers : {-5, 0, std::numeric_limits<int>::max()})
      for (const bool seen : {false, true}) {
        const std::string words = sensor_words({seen, age, true, seen, inliers});
        EXPECT_LE(words.size(), kRoom) << words;
      }
}

}  // namespace
}  // namespace mrroc::rex_drive
