// Rooms and cameras that nobody tuned the odometry to: a motion may be missing, it is not far from what is told of it.
#include "test/vsp/hard_rooms.hpp"

#include <gtest/gtest.h>

namespace mrroc::test {
namespace {

class HardRooms : public testing::TestWithParam<HardRoom> {};

TEST_P(HardRooms, NoMotionMisleadsAnEstimator) {
  constexpr int kPairs = 6;
  const HardRoomResult r = drive_through(GetParam(), kPairs);
  EXPECT_EQ(r.misleading, 0) << "of " << r.valid << ", at most " << r.worst_mm << " mm, " << r.worst_mrad
                             << " mrad";
}

INSTANTIATE_TEST_SUITE_P(All, HardRooms, testing::ValuesIn(hard_rooms(211)), [](const auto& room) {
  std::string name;
  for (const char c : room.param.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
});

}  // namespace
}  // namespace mrroc::test
