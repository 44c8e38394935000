// MG (60)-(63): both arms change behaviour in the same macrostep, and each event ends only its own behaviour.
#include "tasks/rubik/turn/coordination.hpp"

#include <gtest/gtest.h>

#include "tasks/rubik/turn/stepped_arm.hpp"

namespace mrroc::rubik {
namespace {

TEST(Coordination, AnEventOfTheBehaviourInForceEndsIt) {
  Coordination c;
  std::array<Report, 2> reports;
  EXPECT_EQ(coordinate(c, reports).m, 1);
  reports[1].event = 1;
  c = coordinate(c, reports);
  EXPECT_EQ(c.m, 2);
  EXPECT_EQ(c.go_on, (std::array{true, false}));
}

TEST(Coordination, AnEventThatIsStillSetEndsNothingMore) {
  Coordination c;
  std::array<Report, 2> reports;
  reports[0].event = 1;
  for (int k = 0; k < 5; ++k) c = coordinate(c, reports);
  EXPECT_EQ(c.m, 2);
  reports[0].event = 2;
  c = coordinate(c, reports);
  EXPECT_EQ(c.m, 3);
  EXPECT_EQ(c.go_on, (std::array{false, true})) << "the other element is cleared";
}

TEST(Coordination, BothArmsChangeTogetherThroughAllSixBehaviours) {
  // The images of a whole turn; each arm reads what a_0 sent in the macrostep before, as over the links.
  std::array<SteppedArm, 2> arms;
  EXPECT_EQ(arms[0].m(), 0) << "no step yet";
  std::array<Arm::X, 2> x;
  x[0].e.gripper = x[1].e.gripper = 0.074;
  Coordination a_0, sent;
  std::int64_t i = 0;
  int changes = 0, before = 1;
  while (sent.m <= 6 && i < 2000) {
    std::array<Report, 2> reports;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      x[arm].i = i;
      x[arm].T = order(sent);
      x[arm].T.variant = (arm == 0) == (sent.m <= 4) ? kActs : kStands;
      const int m = arms[arm].m();
      if (m == 1) x[arm].e.F_a[Axis::z] += 0.1;
      if (m == 3 || m == 4) x[arm].e.gripper -= 0.001;
      if (m == 4) x[arm].e.blocked = x[arm].e.gripper < 0.057;
      if (m == 5) x[arm].e.T_0E[5] = 0.05 * static_cast<double>(i - x[arm].i_0);
      if (m == 6) x[arm].e.gripper += 0.001;
      const ArmReport told = arms[arm].step(x[arm]).T;
      reports[arm] = static_cast<const Report&>(told);
    }
    ASSERT_EQ(arms[0].m(), arms[1].m()) << "macrostep " << i;
    changes += arms[0].m() != before;
    before = arms[0].m();
    sent = a_0;
    a_0 = coordinate(a_0, reports);
    ++i;
  }
  EXPECT_EQ(before, 6);
  EXPECT_EQ(changes, 5);
  EXPECT_EQ(sent.m, 7);
}

}  // namespace
}  // namespace mrroc::rubik
