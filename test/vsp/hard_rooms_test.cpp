// Rooms and cameras that nobody tuned the odometry to: a motion may be missing, it is not far from what is told of it.
#include "test/vsp/hard_rooms.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace mrroc::test {
namespace {

class HardRooms : public testing::TestWithParam<HardRoom> {};

/// @return whether all ways are seen too long or too short, which the covariance of one motion does not tell
bool is_off_in_scale(const HardRoom& room) { return room.look.turned.y() != 0; }

TEST_P(HardRooms, HardlyAMotionMisleadsAnEstimatorAndNoneGoesFar) {
  constexpr int kPairs = 6, kOneOf = 20;
  const HardRoomResult r = drive_through(GetParam(), kPairs);
  if (!is_off_in_scale(GetParam())) {
    EXPECT_LE(kOneOf * r.misleading, r.valid)
        << "at most " << r.worst_mm << " mm, " << r.worst_mrad << " mrad, mean square " << r.nees;
  }
  EXPECT_LE(r.worst_mm, 75) << "what a motion may differ from the one before";
}

INSTANTIATE_TEST_SUITE_P(All, HardRooms, testing::ValuesIn(hard_rooms(211)), [](const auto& room) {
  std::string name;
  for (const char c : room.param.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
});

}  // namespace
}  // namespace mrroc::test
