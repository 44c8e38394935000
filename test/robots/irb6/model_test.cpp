// The URDF files against the analytic kinematics and the tables.
#include "test/robots/irb6/model.hpp"

#include <kdl/chainiksolverpos_lma.hpp>

#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

class Model : public testing::TestWithParam<const char*> {
 protected:
  AxisVector random_joints() {
    AxisVector m(arm_.axes());
    for (int k = 0; k < m.size(); ++k)
      m[k] = std::uniform_real_distribution<>(arm_.axis(k).motor.lower, arm_.axis(k).motor.upper)(random_);
    return arm_.joints_from_motors(m);
  }

  const std::unique_ptr<Arm> owner_ = make_arm(GetParam());
  const Arm& arm_ = *owner_;
  const urdf::ModelInterfaceSharedPtr model_ = read_model(GetParam());
  std::mt19937_64 random_{7};
};

INSTANTIATE_TEST_SUITE_P(Arms, Model, testing::Values("irb6_postument", "irb6_track"),
                         [](const auto& arm) { return std::string(arm.param).substr(5); });

TEST_P(Model, ChainEqualsTheDirectKinematics) {
  const KDL::Chain wrist = chain_to(*model_, "wrist"), sensor = chain_to(*model_, "sensor");
  const KDL::Chain tool = chain_to(*model_, "tool"), tip = chain_to(*model_, "pen_tip");
  for (int k = 0; k < kCases / 100; ++k) {
    const AxisVector q = random_joints();
    const Pose T_0W = arm_.forward(q);
    ASSERT_LE(difference(forward(wrist, q), T_0W), 1e-12);
    ASSERT_LE(difference(forward(sensor, q), T_0W * arm_.sensor_in_wrist()), 1e-12);
    ASSERT_LE(difference(forward(tool, q), T_0W), 1e-12);
    ASSERT_LE(difference(forward(tip, q), T_0W * arm_.tool_in_wrist()), 1e-12);
  }
}

// KDL iterates to a solution; the analytic one from there is the same. KDL takes rotations below 1e-6 rad for
// none, which a wrist near its singular pose magnifies tenfold.
TEST_P(Model, KdlAgreesWithTheInverseKinematics) {
  const KDL::Chain chain = chain_to(*model_, "wrist");
  const Eigen::Index moving = chain.getNrOfJoints();
  ASSERT_EQ(moving, arm_.axes());
  KDL::ChainIkSolverPos_LMA solver(chain, Vector6::Ones(), 1e-11, 500, 1e-16);
  int solved = 0;
  for (int k = 0; k < 300; ++k) {
    const AxisVector q = random_joints();
    if (std::abs(std::sin(q[q.size() - 2])) < 0.1) continue;
    AxisVector start = q;
    for (double& v : start) v += std::uniform_real_distribution<>(-0.05, 0.05)(random_);
    const Pose T = arm_.forward(q);
    KDL::JntArray from(static_cast<unsigned>(q.size())), found(static_cast<unsigned>(q.size()));
    from.data = start;
    if (solver.CartToJnt(from, to_kdl(T), found) < 0) continue;
    const edp::InverseSolution s = arm_.inverse(T, AxisVector(found.data));
    ASSERT_TRUE(s.reached);
    ASSERT_LE((s.joints - AxisVector(found.data)).cwiseAbs().maxCoeff(), 2e-5) << q.transpose();
    ++solved;
  }
  EXPECT_GE(solved, 250);
}

TEST_P(Model, JointsBearTheNamesAndLimitsOfTheAxes) {
  for (int k = 0; k < arm_.axes(); ++k) {
    std::string name(arm_.axis(k).name);
    std::replace(name.begin(), name.end(), ' ', '_');
    const auto joint = model_->getJoint(name);
    ASSERT_TRUE(joint) << name;
    EXPECT_DOUBLE_EQ(joint->limits->lower, arm_.axis(k).joint.lower);
    EXPECT_DOUBLE_EQ(joint->limits->upper, arm_.axis(k).joint.upper);
    const double gear = arm_.transmission().jacobian(arm_.front())(k, k);
    EXPECT_NEAR(joint->limits->velocity * std::abs(gear) / arm_.axis(k).max_motor_speed, 1, 0.1) << name;
  }
}

TEST_P(Model, MassesAreThoseOfAnIrb6) {
  double turning = 0;
  for (const char* link : {"column", "lower_arm", "upper_arm", "wrist_fork", "wrist_body", "wrist", "tool"}) {
    ASSERT_TRUE(model_->getLink(link) && model_->getLink(link)->inertial) << link;
    turning += model_->getLink(link)->inertial->mass;
  }
  EXPECT_NEAR(turning, 120, 10);
}

TEST_P(Model, InertiasAreThoseOfSolidBodies) {
  for (const auto& [name, link] : model_->links_) {
    if (!link->inertial) continue;
    const urdf::Inertial& i = *link->inertial;
    Matrix3 I;
    I << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    const Vector3 principal = Eigen::SelfAdjointEigenSolver<Matrix3>(I).eigenvalues();
    EXPECT_GT(principal[0], 0) << name;
    EXPECT_GE(principal[0] + principal[1], principal[2]) << name;
    EXPECT_LT(std::sqrt(principal[2] / i.mass), 0.5) << name << ": radius of gyration beyond the link";
  }
}

// The sensor measures what hangs beyond it: the tool, with the weight and mass centre of the table.
TEST_P(Model, TheToolAloneHangsBeyondTheSensor) {
  EXPECT_FALSE(model_->getLink("sensor")->inertial);
  EXPECT_FALSE(model_->getLink("pen_tip")->inertial);
  const urdf::Inertial& tool = *model_->getLink("tool")->inertial;
  EXPECT_NEAR(tool.mass * 9.81, arm_.parameters().tool_weight, 1e-6);
  EXPECT_DOUBLE_EQ(tool.origin.position.x, arm_.parameters().tool_mass_centre[0]);
  EXPECT_DOUBLE_EQ(tool.origin.position.y, arm_.parameters().tool_mass_centre[1]);
  EXPECT_DOUBLE_EQ(tool.origin.position.z, arm_.parameters().tool_mass_centre[2]);
}

TEST_P(Model, EveryMovingLinkHasASimpleCollisionShape) {
  for (const char* name : {"column", "lower_arm", "upper_arm", "wrist_fork", "wrist_body", "wrist", "tool"}) {
    const auto link = model_->getLink(name);
    ASSERT_TRUE(link->collision) << name;
    EXPECT_TRUE(link->collision->geometry->type == urdf::Geometry::BOX ||
                link->collision->geometry->type == urdf::Geometry::CYLINDER);
  }
}

}  // namespace
}  // namespace mrroc::irb6::test
