// What a reply tells, without a driver around it.
#include "edp/reply_builder.hpp"

#include <gtest/gtest.h>

#include "base/representation.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {
namespace {

class Replies : public testing::Test {
 protected:
  Replies() {
    model.weight = 3;
    set.set_position_known(true);
    set.stand_at(arm.motors_from_joints(joints));
    motors = arm.motors_from_joints(joints);
    motors[1] += 1;
    reading.step = 77;
    reading.inputs = 5;
    reading.analog[2] = 0.25;
  }
  [[nodiscard]] DriverView view() const {
    return {.robot = arm,
            .generator = set,
            .servo = servo,
            .gripper = nullptr,
            .model = model,
            .motors = motors,
            .state = DriverState::executing,
            .fault = standing,
            .position_known = known,
            .at_rest = false};
  }
  static MeasuredStep sample(int number) {
    return {{Matrix3::Identity(), Vector3(0.001 * number, 0, 0.1)},
            Wrench::from({0, 0, 1. * number}, {0, 0, 0})};
  }
  /// A macrostep of some steps, the last of which replies.
  EffectorReply macrostep(int steps, const Answer& answer) {
    for (int k = 1; k <= steps; ++k) {
      replies.begin_step(reading);
      const MeasuredStep measured = sample(k);
      replies.add(measured.T_0E, measured.F_a);
    }
    replies.build(view(), answer, protocol, reading);
    replies.complete(view(), answer, protocol);
    return replies.reply();
  }

  FakeArm arm;
  AxisVector joints = (AxisVector(6) << 0.1, -0.1, 0.2, 0.3, 0.4, -0.5).finished();
  StepGenerator set{{&arm, Limits{}, 0.002, 20}, Pose{Matrix3::Identity(), {0, 0, 0.1}}};
  Servo servo{arm, 0.002};
  RobotModel model;
  AxisVector motors;
  Fault standing{};
  bool known{true};
  Protocol protocol;
  HardwareReading reading{};
  ReplyBuilder replies;
};

TEST_F(Replies, SamplesAreThoseSinceTheReplyBefore) {
  macrostep(7, {});
  EXPECT_TRUE(replies.due());
  ASSERT_EQ(replies.samples().size(), 7U);
  EXPECT_EQ(replies.samples().back().T_0E.p.x(), 0.007);
  replies.begin_step(reading);
  EXPECT_FALSE(replies.due());
  EXPECT_TRUE(replies.samples().empty());
  macrostep(3, {});
  EXPECT_EQ(replies.samples().size(), 3U);
}

TEST_F(Replies, MoreSamplesThanThereIsRoomForAreLeftOut) {
  const int many = static_cast<int>(ReplyBuilder::kMaxSamples);
  macrostep(many + 5, {});
  ASSERT_EQ(replies.samples().size(), ReplyBuilder::kMaxSamples);
  EXPECT_EQ(replies.samples().back().F_a[Axis::z], many);
}

TEST_F(Replies, TellWhatWasMeasuredLastInTheStepOfTheReading) {
  const EffectorReply r = macrostep(4, {.number = 9, .verdict = Verdict::executed});
  EXPECT_EQ(r.number, 9);
  EXPECT_EQ(r.step, 77);
  EXPECT_EQ(r.T_0E[0], 0.004);
  EXPECT_EQ(r.F_a[Axis::z], 4);
  EXPECT_EQ(r.motors[1], motors[1]);
  EXPECT_EQ(r.joints[1], arm.joints_from_motors(motors)[1]);
  EXPECT_EQ(r.state, DriverState::executing);
  EXPECT_TRUE(r.position_known);
  EXPECT_EQ(r.robot_model.weight, 3);
  EXPECT_EQ(r.robot_model.set_servo_algorithm, 63);
}

TEST_F(Replies, TellNoJointsWhilePositionsAreUnknown) {
  known = false;
  const EffectorReply r = macrostep(1, {.representation = Representation::joints});
  EXPECT_FALSE(r.position_known);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(r.joints[k], 0);
    EXPECT_EQ(r.pose[k], 0);
  }
}

TEST_F(Replies, TellThePoseAsItWasAskedForMeasuredOrSet) {
  const SetPoint& now = set.set_point();
  const auto pose = [&](Representation r, Feedback f) {
    return macrostep(2, {.representation = r, .feedback = f}).pose;
  };
  EXPECT_EQ(pose(Representation::motors, Feedback::measured)[1], motors[1]);
  EXPECT_EQ(pose(Representation::motors, Feedback::set_value)[1], now.axes.motors[1]);
  EXPECT_EQ(pose(Representation::joints, Feedback::measured)[1], arm.joints_from_motors(motors)[1]);
  EXPECT_EQ(pose(Representation::joints, Feedback::set_value)[1], now.axes.joints[1]);
  for (const Representation r :
       {Representation::frame, Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
    EXPECT_EQ(pose(r, Feedback::measured), numbers_from_pose(r, sample(2).T_0E));
    EXPECT_EQ(pose(r, Feedback::set_value), numbers_from_pose(r, now.T_0E));
  }
}

TEST_F(Replies, InputsAreToldOnlyToWhoAsksForThem) {
  const auto io = static_cast<std::uint8_t>(Part::io);
  EXPECT_EQ(macrostep(1, {}).inputs, 0);
  const EffectorReply r = macrostep(1, {.parts = io});
  EXPECT_EQ(r.inputs, 5);
  EXPECT_EQ(r.analog[2], 0.25);
}

TEST_F(Replies, TheFaultThatStandsIsToldWhenNoCommandHasOneOfItsOwn) {
  standing.code = FaultCode::over_current;
  Answer refused{.verdict = Verdict::refused};
  refused.fault.code = FaultCode::too_fast;
  EXPECT_EQ(macrostep(1, {}).fault.code, FaultCode::over_current);
  EXPECT_EQ(macrostep(1, refused).fault.code, FaultCode::too_fast);
}

TEST_F(Replies, AQueryGetsTheReplyThatWasStored) {
  const EffectorReply stored = macrostep(5, {.number = 4, .verdict = Verdict::executed, .store = true});
  reading.step = 90;
  macrostep(2, {.number = 5, .verdict = Verdict::refused});
  const EffectorReply again = macrostep(3, {.replay = true});
  EXPECT_EQ(again.number, 4);
  EXPECT_EQ(again.step, 77);
  EXPECT_EQ(again.T_0E, stored.T_0E);
}

}  // namespace
}  // namespace mrroc::edp::test
