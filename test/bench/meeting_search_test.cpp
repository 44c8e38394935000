// The search for the place where two arms turn faces of a cube.
#include "bench/meeting_search.hpp"

#include <gtest/gtest.h>

#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"

namespace mrroc::bench {
namespace {

class MeetingSearch : public testing::Test {
 protected:
  rubik::CubePlanCell cell{rubik::usual_cell()};
};

TEST_F(MeetingSearch, ThePlaceOfTheCellIsReachedWithMarginAndFree) {
  EXPECT_GT(meeting_reach(cell, cell.meeting()), 0.4);
  EXPECT_TRUE(meeting_is_free(cell, cell.meeting()));
}

TEST_F(MeetingSearch, APlaceThatOneArmDoesNotComeToHasNoReach) {
  rubik::Meeting far = cell.meeting();
  far.T_UM.p.y() += 1.5;
  EXPECT_LT(meeting_reach(cell, far), 0);
}

TEST_F(MeetingSearch, AnArmWhoseCubeIsInTheOtherOnesWristIsNotFree) {
  rubik::Meeting meeting = cell.meeting();
  meeting.joints[cube::index(cube::Hand::track)][0] += 0.1;  // the whole arm, along the track
  EXPECT_FALSE(meeting_is_free(cell, meeting));
}

TEST_F(MeetingSearch, FindsAFreePlaceAndTheSameOneAgain) {
  constexpr int kDraws = 2000;
  const MeetingCandidate found = search_meeting(cell, kDraws, 3);
  ASSERT_GT(found.reach, 0.2);
  EXPECT_NEAR(meeting_reach(cell, found.meeting), found.reach, 1e-12) << "in its own branches";
  EXPECT_TRUE(meeting_is_free(cell, found.meeting));
  EXPECT_EQ(search_meeting(cell, kDraws, 3).reach, found.reach);
}

}  // namespace
}  // namespace mrroc::bench
