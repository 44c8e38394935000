#include "test/contract/robot_contract.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "test/heap.hpp"

namespace mrroc::contract {

using edp::AxisProperties;
using edp::InverseSolution;
using edp::Robot;

RobotContract::RobotContract() : robot_(GetParam()()) {
  for (int k = 0; robot_ && k < robot_->models(); ++k)
    if (const Robot* model = robot_->with_model(k)) models_.push_back(model);
}

AxisVector RobotContract::random_motors(const Robot& robot) {
  AxisVector m(robot.axes());
  for (int k = 0; k < m.size(); ++k) m[k] = uniform(robot.axis(k).motor.lower, robot.axis(k).motor.upper);
  return m;
}

namespace {

constexpr int kCases = 2000;
constexpr double kExact = 1e-9;

double difference(const Pose& a, const Pose& b) {
  return std::max((a.p - b.p).cwiseAbs().maxCoeff(), (a.R - b.R).cwiseAbs().maxCoeff());
}
double difference(const AxisVector& a, const AxisVector& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// @return smallest change of the pose per change of the joints, in any direction that changes it at all: small
/// near a singular pose; with an axis to spare of all axes that a rule may keep the worst
double conditioning(const Robot& robot, const AxisVector& q) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, robot.axes());
  const Pose T = robot.forward(q);
  for (int k = 0; k < robot.axes(); ++k) {
    AxisVector moved = q;
    moved[k] += kStep;
    const Pose near = robot.forward(moved);
    const Matrix3 turn = near.R * T.R.transpose();
    J.col(k) << (near.p - T.p) / kStep, Vector3(turn(2, 1), turn(0, 2), turn(1, 0)) / kStep;
  }
  const auto least = [](const Eigen::MatrixXd& of) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(of).singularValues().minCoeff();
  };
  double worst = least(J);
  for (int kept = 0; robot.axes() > 6 && kept < robot.axes(); ++kept) {
    Eigen::MatrixXd others(6, robot.axes() - 1);
    others << J.leftCols(kept), J.rightCols(robot.axes() - 1 - kept);
    worst = std::min(worst, least(others));
  }
  return worst;
}

}  // namespace

TEST_P(RobotContract, LeadsFromEveryModelToEveryOther) {
  ASSERT_NE(robot_, nullptr);
  ASSERT_GE(robot_->models(), 1);
  ASSERT_EQ(static_cast<int>(models_.size()), robot_->models());
  for (std::size_t k = 0; k < models_.size(); ++k) {
    const Robot& robot = *models_[k];
    EXPECT_EQ(robot.model(), static_cast<int>(k));
    EXPECT_EQ(robot.models(), robot_->models());
    EXPECT_EQ(robot.name(), robot_->name());
    ASSERT_EQ(robot.axes(), robot_->axes());
    for (std::size_t j = 0; j < models_.size(); ++j)
      EXPECT_NE(robot.with_model(static_cast<int>(j)), nullptr);
    for (const int none : {-1, robot.models(), 1'000'000}) EXPECT_EQ(robot.with_model(none), nullptr);
    for (int a = 0; a < robot.axes(); ++a) {
      EXPECT_EQ(robot.axis(a).name, robot_->axis(a).name);
      EXPECT_EQ(robot.axis(a).motor.lower, robot_->axis(a).motor.lower);
      EXPECT_EQ(robot.axis(a).motor.upper, robot_->axis(a).motor.upper);
    }
  }
}

TEST_P(RobotContract, NamesItselfAndItsAxesWithSaneRanges) {
  EXPECT_FALSE(robot_->name().empty());
  ASSERT_GE(robot_->axes(), 1);
  ASSERT_LE(robot_->axes(), kMaxAxes);
  std::set<std::string_view> names;
  for (int k = 0; k < robot_->axes(); ++k) {
    const AxisProperties& a = robot_->axis(k);
    SCOPED_TRACE(std::string(a.name));
    EXPECT_FALSE(a.name.empty());
    EXPECT_TRUE(names.insert(a.name).second) << "two axes of that name";
    for (const edp::Range& range : {a.joint, a.motor}) {
      EXPECT_TRUE(std::isfinite(range.lower) && std::isfinite(range.upper));
      EXPECT_LT(range.lower, range.upper);
    }
    EXPECT_GT(a.increments_per_rad, 0);
    EXPECT_LT(a.increments_per_rad * (a.motor.upper - a.motor.lower),
              std::numeric_limits<std::int32_t>::max());
    EXPECT_GT(a.max_motor_speed, 0);
    EXPECT_GT(a.servo.drive.current_limit, 0);
    EXPECT_LE(a.servo.drive.current_limit, a.servo.drive.max_current);
  }
}

TEST_P(RobotContract, HasRoomWithinItsLimits) {
  for (const Robot* robot : models_) {
    int legal = 0;
    for (int k = 0; k < kCases; ++k) {
      const AxisVector q = random_joints(*robot);
      bool inside = true;
      for (int a = 0; a < q.size(); ++a) inside = inside && robot->axis(a).joint.contains(q[a]);
      legal += inside;
    }
    EXPECT_GT(legal, kCases / 100) << "joint and motor limits of model " << robot->model()
                                   << " exclude each other";
  }
}

TEST_P(RobotContract, ConvertsMotorsAndJointsIntoOneAnother) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) {
      const AxisVector m = random_motors(*robot);
      const AxisVector q = robot->joints_from_motors(m);
      ASSERT_EQ(q.size(), robot->axes());
      ASSERT_TRUE(q.allFinite()) << m.transpose();
      const AxisVector back = robot->motors_from_joints(q);
      ASSERT_EQ(back.size(), robot->axes());
      ASSERT_LE(difference(back, m), 1e-7 * std::max(1.0, m.cwiseAbs().maxCoeff())) << m.transpose();
      ASSERT_LE(difference(robot->joints_from_motors(back), q), kExact);
    }
}

TEST_P(RobotContract, MovesItsJointsWithoutJumpsWhenTheMotorsDo) {
  constexpr double kSmall = 1e-6;  // [rad] of the motor
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) {
      const AxisVector m = random_motors(*robot);
      AxisVector moved = m;
      for (double& x : moved) x += uniform(-kSmall, kSmall);
      ASSERT_LE(difference(robot->joints_from_motors(moved), robot->joints_from_motors(m)), 100 * kSmall)
          << "model " << robot->model() << " at motors " << m.transpose();
    }
}

// The simulated world drives the joints by it.
TEST_P(RobotContract, KnowsHowItsMotorsFollowItsJoints) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases / 10; ++k) {
      const AxisVector q = random_joints(*robot);
      const AxisMatrix J = robot->motors_per_joints(q), differences = robot->Robot::motors_per_joints(q);
      ASSERT_EQ(J.rows(), robot->axes());
      ASSERT_EQ(J.cols(), robot->axes());
      ASSERT_LE((J - differences).cwiseAbs().maxCoeff(), 1e-4 * J.cwiseAbs().maxCoeff()) << q.transpose();
    }
}

TEST_P(RobotContract, GivesPosesThatAreRotationAndPosition) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) ASSERT_TRUE(is_proper(robot->forward(random_joints(*robot))));
}

TEST_P(RobotContract, ReturnsTheJointsThatRealiseThePoseAlready) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) {
      const AxisVector q = random_joints(*robot);
      const Pose T = robot->forward(q);
      const InverseSolution s = robot->inverse(T, q);
      ASSERT_TRUE(s.reached) << q.transpose();
      ASSERT_EQ(s.missing, 0);
      ASSERT_LE(difference(robot->forward(s.joints), T), kExact) << q.transpose();
      ASSERT_LE(difference(s.joints, q), kExact) << "model " << robot->model() << " at " << q.transpose();
    }
}

// From anywhere: what is called reached is reached, and what is not has a distance.
TEST_P(RobotContract, ReachesExactlyOrSaysHowFarItFallsShort) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) {
      const Pose T = robot->forward(random_joints(*robot));
      const InverseSolution s = robot->inverse(T, random_joints(*robot));
      ASSERT_EQ(s.joints.size(), robot->axes());
      ASSERT_TRUE(s.joints.allFinite());
      ASSERT_EQ(s.reached, s.missing == 0);
      ASSERT_GE(s.missing, 0);
      if (s.reached) {
        ASSERT_LE(difference(robot->forward(s.joints), T), kExact);
      }
    }
}

TEST_P(RobotContract, RefusesWhatIsOutOfReachByItsDistance) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases / 10; ++k) {
      const AxisVector near = random_joints(*robot);
      Pose T = robot->forward(near);
      const Vector3 away = Vector3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
      T.p = 100 * away;
      const InverseSolution s = robot->inverse(T, near);
      T.p = 200 * away;
      const InverseSolution farther = robot->inverse(T, near);
      ASSERT_FALSE(s.reached || farther.reached);
      ASSERT_TRUE(s.joints.allFinite() && farther.joints.allFinite());
      ASSERT_GT(s.missing, 50);
      ASSERT_LT(s.missing, 150);
      ASSERT_NEAR(farther.missing - s.missing, 100, 10);
    }
}

// Along a path no axis moves much faster than the pose asks for, except near a singular pose.
TEST_P(RobotContract, NeverJumpsOnAPath) {
  constexpr double kStep = 2e-4;  // [rad, m] of each joint
  constexpr double kMost = 20;    // times as much as the pose asks for where it is well conditioned
  for (const Robot* robot : models_) {
    long steps = 0;
    for (int path = 0; path < 20; ++path) {
      AxisVector q = random_joints(*robot), speed(robot->axes()), solved = q;
      for (double& v : speed) v = uniform(-kStep, kStep);
      for (int k = 0; k < 500; ++k, ++steps) {
        const Pose before = robot->forward(solved);
        q += speed;
        const Pose T = robot->forward(q);
        const InverseSolution s = robot->inverse(T, solved);
        const double well = conditioning(*robot, solved);
        if (!s.reached || s.singular || well < 0.02) break;
        ASSERT_LE(difference(robot->forward(s.joints), T), kExact);
        ASSERT_LE(difference(s.joints, solved), kMost * difference(T, before) / well + kExact)
            << "model " << robot->model() << " from " << solved.transpose() << " to " << s.joints.transpose();
        solved = s.joints;
      }
    }
    EXPECT_GT(steps, 500) << "paths that end at once say nothing";
  }
}

TEST_P(RobotContract, NeverGivesWhatIsNotANumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k)
      for (const double x : {kNan, kInf, -kInf, 1e308, -1e154, 1e7}) {
        Pose T = robot->forward(random_joints(*robot));
        AxisVector near = random_joints(*robot);
        switch (k % 3) {
          case 0:
            T.p[static_cast<int>(uniform(0, 2.999))] = x;
            break;
          case 1:
            T.R(static_cast<int>(uniform(0, 2.999)), static_cast<int>(uniform(0, 2.999))) = x;
            break;
          default:
            near[static_cast<int>(uniform(0, robot->axes() - 0.001))] = x;
        }
        const InverseSolution s = robot->inverse(T, near);
        ASSERT_EQ(s.joints.size(), robot->axes());
        ASSERT_TRUE(s.joints.allFinite()) << s.joints.transpose();
        ASSERT_FALSE(std::isnan(s.missing));
        ASSERT_FALSE(s.reached) << x;
      }
}

// What is not finite must not come out as a position.
TEST_P(RobotContract, DoesNotMakeAPositionOfWhatIsNotANumber) {
  for (const Robot* robot : models_)
    for (int k = 0; k < robot->axes(); ++k) {
      AxisVector x = random_joints(*robot);
      x[k] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(robot->motors_from_joints(x).allFinite()) << robot->axis(k).name;
      AxisVector m = random_motors(*robot);
      m[k] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(robot->joints_from_motors(m).allFinite()) << robot->axis(k).name;
    }
}

// Without the masses only their smoothness can be told.
TEST_P(RobotContract, GivesSmoothTorquesAgainstGravity) {
  for (const Robot* robot : models_)
    for (int k = 0; k < kCases; ++k) {
      const AxisVector q = random_motors(*robot);
      const AxisVector torque = robot->gravity(q);
      ASSERT_EQ(torque.size(), robot->axes());
      ASSERT_TRUE(torque.allFinite());
      AxisVector moved = q;
      for (double& x : moved) x += uniform(-1e-7, 1e-7);
      ASSERT_LE(difference(robot->gravity(moved), torque),
                1e-4 * std::max(1.0, torque.cwiseAbs().maxCoeff()));
    }
}

TEST_P(RobotContract, AnswersTheSameTwice) {
  for (const Robot* robot : models_)
    for (int k = 0; k < 100; ++k) {
      const AxisVector q = random_joints(*robot), near = random_joints(*robot);
      const Pose T = robot->forward(q);
      const InverseSolution first = robot->inverse(T, near);
      (void)robot->inverse(robot->forward(near), q);
      const InverseSolution second = robot->inverse(T, near);
      ASSERT_EQ(first.joints, second.joints);
      ASSERT_EQ(first.missing, second.missing);
    }
}

TEST_P(RobotContract, NeverAllocates) {
  for (const Robot* robot : models_) {
    const AxisVector q = random_joints(*robot), m = random_motors(*robot);
    Pose out_of_reach = robot->forward(q);
    out_of_reach.p *= 100;
    const mrroc::test::AllocationCounter heap;
    for (int k = 0; k < 100; ++k) {
      const Robot* other = robot->with_model(k % robot->models());
      const Pose T = other->forward(q);
      (void)other->inverse(T, q);
      (void)other->inverse(out_of_reach, q);
      (void)other->motors_from_joints(q);
      (void)other->joints_from_motors(m);
      (void)other->gravity(m);
      (void)other->forward_from_motors(m);
      (void)other->axis(k % other->axes()).motor.contains(0);
    }
    EXPECT_EQ(heap.count(), 0);
  }
}

}  // namespace mrroc::contract
