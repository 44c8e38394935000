#include "tasks/ball/law.hpp"

#include <gtest/gtest.h>

#include "ecp/generators/force.hpp"
#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

Report report_at(const Pose& T_0E, const Vector3& force_U) {
  Report r;
  const AngleAxisPose p = angle_axis_from_pose(T_0E);
  std::copy(p.begin(), p.end(), r.T_0E.begin());
  r.F_a = Wrench::from(T_0E.R.transpose() * force_U, Vector3::Zero());
  return r;
}

/// Both palms hold an object between them.
std::array<Report, kArms> holding(double press, const Vector3& first, const Vector3& second) {
  return {report_at({palm_orientation(0), {0.3, 1.15, 1}}, first - press * kLine),
          report_at({palm_orientation(1), {0.3, 0.95, 1}}, second + press * kLine)};
}

TEST(BallLaw, TakesForcesApartAlongAndAcrossTheLine) {
  const PairState s = pair_state({}, holding(12.5, {1, 0, 2}, {-1, 0, 3}));
  EXPECT_NEAR(s.distance, 0.2, 1e-12);
  for (const double press : s.press) EXPECT_NEAR(press, 12.5, 1e-9);
  EXPECT_LT((s.across[0] - Vector3(1, 0, 2)).norm(), 1e-9);
  EXPECT_LT((s.across[1] - Vector3(-1, 0, 3)).norm(), 1e-9);
}

TEST(BallLaw, LetsThePalmThatBearsMoreGiveWay) {
  Vector3 shift = Vector3::Zero();
  const PairState second_bears_more = pair_state({}, holding(12.5, {0, 0, 1}, {0, 0, 4}));
  for (int k = 0; k < 10; ++k) shift = share_load(shift, second_bears_more);
  EXPECT_LT(shift.z(), 0) << "the second palm goes down against the first";
  for (int k = 0; k < 100'000; ++k) shift = share_load(shift, second_bears_more);
  EXPECT_LE(shift.norm(), 0.00301) << "a wrong force does not lead the palms apart";
}

TEST(BallLaw, TellsAPersonFromTheLoad) {
  EXPECT_EQ(pushed_by_hand(pair_state({}, holding(12.5, {0, 0, 2.5}, {0, 0, 2.5})), 5), Vector3::Zero());
  // A person's force on a tool is felt as if the tool pushed against it.
  const Vector3 hand(8, 0, 0);
  const Vector3 felt =
      pushed_by_hand(pair_state({}, holding(12.5, Vector3(0, 0, 2.5) - hand, {0, 0, 2.5})), 5);
  EXPECT_GT(felt.x(), 5);
  EXPECT_NEAR(felt.z(), 0, 1e-9);
}

TEST(BallLaw, YieldsTheWayOfThePushAndComesBack) {
  Vector3 yielded = Vector3::Zero();
  for (int k = 0; k < 200; ++k) yielded = yield(yielded, {6, 0, 0});
  EXPECT_GT(yielded.x(), 0.01);
  for (int k = 0; k < 10'000; ++k) yielded = yield(yielded, {100, 0, 0});
  EXPECT_LE(yielded.norm(), 0.0501);
  for (int k = 0; k < 1000; ++k) yielded = yield(yielded, Vector3::Zero());
  EXPECT_LT(yielded.norm(), 1e-4);
}

TEST(BallLaw, FindsTheForceOnTheObjectWhateverAPersonAddsToOneArm) {
  PairState s;
  s.distance = 0.199;  // pressed together
  s.press = {21 - 30.0, 21};
  EXPECT_EQ(contact_force(s, 0.2), 21) << "the first arm is pushed towards the second one";
  s.distance = 0.201;
  s.press = {9 + 30.0, 9};
  EXPECT_EQ(contact_force(s, 0.2), 9) << "and away from it";
}

TEST(BallLaw, DrawsAPalmToItsPlaceAndTurnsItToTheOther) {
  const Pose T_UE{palm_orientation(1), {0.3, 0.95, 1}};
  const TaskFrameCommand there = hold_place(1, T_UE, {T_UE.p, Vector3::Zero()});
  for (const Axis a : kAxes) EXPECT_NEAR(there[a].velocity, 0, 1e-9);
  const TaskFrameCommand below = hold_place(1, T_UE, {T_UE.p + Vector3(0, 0, 0.01), Vector3::Zero()});
  EXPECT_GT(below.x.velocity, 0) << "x of a palm is up";
  const Pose turned{palm_orientation(1) * rotation_from_angle_axis({0.1, 0, 0}), T_UE.p};
  EXPECT_LT(hold_place(1, turned, {T_UE.p, Vector3::Zero()}).ax.velocity, 0);
}

TEST(BallLaw, PressesWithTheSameForceInItsPlaceAndWithMoreWhenDriven) {
  const PairState s = pair_state({}, holding(12.5, Vector3::Zero(), Vector3::Zero()));
  const Vector3 middle(0.3, 1.05, 1);
  EXPECT_NEAR(press_in_place(12.5, s, middle).force, press(12.5).force, 1e-9);
  EXPECT_GT(press_in_place(12.5, s, middle - 0.01 * kLine).force, 12.5);
  EXPECT_LT(press_in_place(12.5, s, middle + 0.01 * kLine).force, 12.5);
}

}  // namespace
}  // namespace mrroc::ball
