// The virtual effector e_1 of VS 3.2 on a driver: what B_1,1 and B_1,0 are made of keeps what the paper promises.
#include "ecp/generators/virtual_effector.hpp"

#include <gtest/gtest.h>

#include "test/base/random_pose.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

using mrroc::test::distance;

const Pose kAhead{rotation_from_angle_axis({0.01, 0, 0.02}), {0.002, -0.001, 0.003}};

/// A rig that writes down its set point in every step.
struct ServoedRig : Rig {
  ServoedRig() {
    synchronise();
    after_each_step = [this] { set_points.push_back(driver.set_point()); };
  }
  EffectorReply displace(const Pose& T_dc) {
    EffectorCommand c = ecp::displace(T_dc);
    c.session = 7;
    c.number = ++number;
    return macrostep(c);
  }
  std::vector<SetPoint> set_points;
};

TEST(VirtualEffector, ADisplacementLasts21StepsAndEndsWhereItWasTold) {
  ServoedRig rig;
  const Pose start = rig.driver.set_point().T_0E;
  EXPECT_EQ(rig.displace(kAhead).verdict, Verdict::executed);
  EXPECT_EQ(rig.set_points.size(), 21u);
  rig.silence(5);
  EXPECT_LT(distance(rig.driver.set_point().T_0E, start * kAhead), 1e-9);
}

TEST(VirtualEffector, TheDisplacementOfACommandIsWhatItWasMadeOfAndOfAnyOtherCommandThereIsNone) {
  EXPECT_LT(distance(ecp::displacement_of(ecp::displace(kAhead)), kAhead), 1e-12);
  for (const Representation r : {Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    EffectorCommand part = ecp::displace(kAhead);
    part.arm.representation = r;
    part.arm.pose = numbers_from_pose(r, kAhead);
    EXPECT_LT(distance(ecp::displacement_of(part), kAhead), 1e-12) << "of a part, in any representation";
  }
  const auto is_none = [](const EffectorCommand& c) {
    return distance(ecp::displacement_of(c), Pose{}) == 0;
  };
  EXPECT_TRUE(is_none(ecp::idle()));
  EXPECT_TRUE(is_none({}));
  EffectorCommand other = ecp::displace(kAhead);
  other.arm.reference = Reference::absolute;
  EXPECT_TRUE(is_none(other));
  for (const Interpolation mu : {Interpolation::tcim_pose, Interpolation::tcim_velocity}) {
    other = ecp::displace(kAhead);
    other.arm.mu = mu;
    EXPECT_TRUE(is_none(other)) << static_cast<int>(mu);
  }
  other = ecp::displace(kAhead);
  other.set = static_cast<std::uint8_t>(Part::robot_model);
  EXPECT_TRUE(is_none(other)) << "it does not move the arm";
}

TEST(VirtualEffector, EveryStepIsTheWayThatIsLeftOverTheStepsThatAreLeft) {
  ServoedRig rig;
  rig.displace(kAhead);
  rig.set_points.clear();
  AxisVector m_c = rig.driver.set_point().axes.motors;
  rig.displace(kAhead);
  const AxisVector m_d = rig.set_points.back().axes.motors;
  for (int iota = 0; iota < 21; ++iota) {
    const SetPoint& now = rig.set_points[static_cast<std::size_t>(iota)];
    EXPECT_LT((now.motor_increment - (m_d - m_c) / (21 - iota)).cwiseAbs().maxCoeff(), 1e-9) << iota;
    m_c = now.axes.motors;
  }
}

TEST(VirtualEffector, DisplacementsFollowOneAnotherWithoutAStop) {
  ServoedRig rig;
  for (int k = 0; k < 20; ++k) ASSERT_EQ(rig.displace(kAhead).verdict, Verdict::executed);
  // The first one brakes before its end, and the second makes up for it.
  for (std::size_t k = 43; k < rig.set_points.size(); ++k) {
    const AxisVector& before = rig.set_points[k - 1].motor_increment;
    const AxisVector& now = rig.set_points[k].motor_increment;
    EXPECT_GT(now.norm(), 0.5 * before.norm());
    EXPECT_LT((now - before).norm(), 0.1 * before.norm()) << "at step " << k;
  }
}

TEST(VirtualEffector, StartsFromTheSetPoseSoThatLagIsNotSubtracted) {
  ServoedRig rig;
  Pose told = rig.driver.set_point().T_0E;
  for (int k = 0; k < 30; ++k) {
    rig.displace(kAhead);
    told = told * kAhead;
  }
  EXPECT_LT(distance(rig.driver.set_point().T_0E, told), 1e-6);
}

TEST(VirtualEffector, TellsThePoseOfEveryStepWithTheStepsNumber) {
  ServoedRig rig;
  rig.displace(kAhead);
  std::vector<std::array<double, 6>> told;
  std::vector<Pose> measured;
  std::int64_t last = 0;
  rig.after_each_step = [&] {
    measured.push_back(rig.driver.samples().back().T_0E);
    if (!rig.driver.reply_due()) return;
    for (const MeasuredStep& s : rig.driver.samples()) told.push_back(s.sample().T_0E);
    const std::int64_t step = rig.driver.reply().step;
    if (last != 0) {
      EXPECT_EQ(step - last, static_cast<std::int64_t>(rig.driver.samples().size()));
    }
    last = step;
  };
  for (int k = 0; k < 5; ++k) rig.displace(kAhead);
  rig.silence(5);
  ASSERT_GE(told.size() + 2, measured.size());
  for (std::size_t k = 1; k < told.size(); ++k)
    EXPECT_LT(
        distance(pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(told[k].data())), measured[k - 1]),
        1e-12)
        << "idle included";
}

TEST(VirtualEffector, IdleServoesOnTheLastGoalAndGoesOnFromThere) {
  ServoedRig rig;
  Pose held = rig.driver.set_point().T_0E;
  for (int k = 0; k < 5; ++k) {
    rig.displace(kAhead);
    held = held * kAhead;
  }
  rig.set_points.clear();
  rig.silence(20);
  for (std::size_t k = 1; k < rig.set_points.size(); ++k) {
    const AxisVector change = rig.set_points[k].motor_increment - rig.set_points[k - 1].motor_increment;
    EXPECT_LT(change.norm(), 0.06 * rig.set_points[0].motor_increment.norm()) << k;
  }
  for (std::size_t k = 91; k < rig.set_points.size(); ++k)
    EXPECT_EQ(rig.set_points[k].motor_increment.norm(), 0) << k;
  EXPECT_LT(distance(rig.driver.set_point().T_0E, held), 1e-6);
  EXPECT_EQ(rig.displace(kAhead).verdict, Verdict::executed);
  rig.silence(5);
  EXPECT_LT(distance(rig.driver.set_point().T_0E, held * kAhead), 1e-6);
}

TEST(VirtualEffector, ADisplacementThatComesOneMacrostepLateCountsFromTheGoalOfTheLast) {
  ServoedRig rig;
  const Pose start = rig.driver.set_point().T_0E;
  rig.displace(kAhead);
  rig.displace(kAhead);
  rig.silence(1);  // beyond its goal, on its way to rest
  EXPECT_EQ(rig.displace(kAhead).verdict, Verdict::executed);
  EXPECT_LT(distance(rig.driver.set_point().T_0E, start * kAhead * kAhead * kAhead), 1e-9);
}

}  // namespace
}  // namespace mrroc::edp::test
