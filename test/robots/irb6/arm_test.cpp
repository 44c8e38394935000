// The tables, and the arm as the effector driver sees it.
#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

using ArmTable = Irb6;
INSTANTIATE_TEST_SUITE_P(Arms, ArmTable, kTrackKept, arm_case_name);

TEST(MakeArm, KnowsTwoNames) {
  EXPECT_EQ(make_arm("irb6_postument")->axes(), 6);
  EXPECT_EQ(make_arm("irb6_track")->axes(), 7);
  EXPECT_EQ(make_arm("irb6"), nullptr);
  EXPECT_EQ(make_arm(""), nullptr);
}

TEST(MakeArm, SelectsTheParameterSet) {
  const auto nominal = make_arm("irb6_postument"),
             other = make_arm("irb6_postument", model_number(ParameterSet::calibrated));
  const AxisVector q = nominal->front();
  const double off = (nominal->forward(q).p - other->forward(q).p).norm();
  EXPECT_GT(off, 0.003);
  EXPECT_LT(off, 0.010);
}

TEST_P(ArmTable, DiffersFromTheNominalOneByNoMoreThanACalibrationFinds) {
  const auto nominal = make_arm(GetParam().name);
  int compared = 0;
  for (int k = 0; k < kCases / 10; ++k) {
    const AxisVector motors = random_motors();
    const AxisVector believed = nominal->joints_from_motors(motors), joints = arm_.joints_from_motors(motors);
    if (!legal(*nominal, believed)) continue;
    ++compared;
    const auto distance = [&](const AxisVector& q) {
      const Pose a = arm_.forward(q) * arm_.tool_in_wrist();
      return (a.p - (nominal->forward(believed) * nominal->tool_in_wrist()).p).norm();
    };
    ASSERT_LT((joints - believed).cwiseAbs().maxCoeff(), 0.07) << believed.transpose();
    ASSERT_LT(distance(believed), 0.020) << believed.transpose();
    ASSERT_LT(distance(joints), 0.080) << believed.transpose();
  }
  EXPECT_GT(compared, kCases / 100);
}

TEST(MakeArm, RefusesAModelThatThereIsNot) {
  EXPECT_EQ(make_arm("irb6_postument", -1), nullptr);
  EXPECT_EQ(make_arm("irb6_postument", 99), nullptr);
}

// The pointers outlive the arm that gave them.
TEST(MakeArm, LeadsFromEveryModelToEveryOther) {
  for (const char* name : {"irb6_postument", "irb6_track"}) {
    const int models = make_arm(name)->models();
    EXPECT_GE(models, 2);
    for (int from = 0; from < models; ++from)
      for (int to = 0; to < models; ++to) {
        const edp::Robot* other = make_arm(name, from)->with_model(to);
        ASSERT_NE(other, nullptr);
        EXPECT_EQ(other->model(), to);
        EXPECT_EQ(other->models(), models);
        EXPECT_EQ(other->name(), name);
        const AxisVector q = make_arm(name)->front();
        EXPECT_EQ(other->forward(q).p, make_arm(name, to)->forward(q).p);
      }
    EXPECT_EQ(make_arm(name)->with_model(models), nullptr);
    EXPECT_EQ(make_arm(name)->with_model(-1), nullptr);
  }
}

TEST(Arm, OfItsOwnTableHasOneModel) {
  const Arm arm(kTrackCalibrated);
  EXPECT_EQ(arm.models(), 1);
  EXPECT_EQ(arm.with_model(0), &arm);
  EXPECT_EQ(arm.with_model(1), nullptr);
}

TEST_P(ArmTable, NamesItsAxes) {
  std::string names;
  for (int k = 0; k < arm_.axes(); ++k) names += std::string(arm_.axis(k).name) + ", ";
  EXPECT_EQ(names, std::string(first_ == 1 ? "track, " : "") + "column, lower arm, upper arm, T, V, N, ");
}

TEST_P(ArmTable, HasTheFrontPoseWithinItsLimits) { EXPECT_TRUE(legal(arm_, arm_.front())); }

TEST_P(ArmTable, SynchronisesWithinItsLimits) {
  EXPECT_TRUE(legal(arm_, arm_.synchronised())) << arm_.synchronised().transpose();
  EXPECT_LE(arm_.motors_from_joints(arm_.synchronised()).cwiseAbs().maxCoeff(), 1e-9);
}

// The motors are the legal range; joint limits cut it only where the linkages fold the arm.
TEST_P(ArmTable, JointLimitsOnlyCutTheFoldOfTheArm) {
  for (int k = 0; k < kCases / 10; ++k) {
    const AxisVector q = random_joints();
    for (const int joint : {0, 1, 4, 5})
      ASSERT_TRUE(arm_.axis(first_ + joint).joint.contains(q[first_ + joint]))
          << arm_.axis(first_ + joint).name;
    if (first_ == 1) {
      ASSERT_TRUE(arm_.axis(0).joint.contains(q[0]));
    }
  }
}

TEST_P(ArmTable, PoseOfTheMotorsIsThePoseOfTheirJoints) {
  for (int k = 0; k < kCases / 10; ++k) {
    const AxisVector m = random_motors();
    ASSERT_LE(difference(arm_.forward_from_motors(m), arm_.forward(arm_.joints_from_motors(m))), 1e-12)
        << m.transpose();
  }
}

TEST_P(ArmTable, EncodersAndSpeedsAreTheDrives) {
  for (int k = 0; k < arm_.axes(); ++k) {
    const bool last = k == arm_.axes() - 1;
    EXPECT_NEAR(arm_.axis(k).increments_per_rad * 2 * kPi, last ? 2000 : 4000, 1e-9);
    EXPECT_DOUBLE_EQ(arm_.axis(k).max_motor_speed * 0.002, 0.5);
    const edp::RegulatorCoefficients& c = arm_.axis(k).servo.incremental[0];
    EXPECT_GT(c.b0, c.b1);
  }
}

TEST_P(ArmTable, ForceSensorSitsOnTheAxisOfTheTool) {
  EXPECT_EQ(arm_.sensor_in_wrist().p, Vector3(0, 0, 0.09));
  EXPECT_NEAR(arm_.sensor_in_wrist().R(2, 2), 1, 1e-15);
  EXPECT_NEAR(std::atan2(arm_.sensor_in_wrist().R(1, 0), arm_.sensor_in_wrist().R(0, 0)),
              first_ == 1 ? -kPi / 2 : kPi, 1e-12);
  EXPECT_EQ(arm_.tool_in_wrist().p, Vector3(0, 0, 0.25));
}

}  // namespace
}  // namespace mrroc::irb6::test
