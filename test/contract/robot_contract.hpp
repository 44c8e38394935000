// Contract of every robot with the effector driver (edp/robot.hpp), as a test suite. A new robot uses it in
// three lines, in a test that links with mrroc_robot_contract:
//
//   #include "test/contract/robot_contract.hpp"
//   std::unique_ptr<edp::Robot> make() { return std::make_unique<MyRobot>(); }
//   INSTANTIATE_TEST_SUITE_P(MyRobot, RobotContract, testing::Values(make), robot_name);
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "edp/robot.hpp"

namespace mrroc::contract {

/// Makes the robot, with any of its kinematic models.
using MakeRobot = std::unique_ptr<edp::Robot> (*)();

/// Names the tests after the robot.
inline std::string robot_name(const testing::TestParamInfo<MakeRobot>& info) {
  return std::string(info.param()->name());
}

/// Every test goes over all kinematic models of the robot. Seeded.
class RobotContract : public testing::TestWithParam<MakeRobot> {
 protected:
  RobotContract();

  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  /// @return motors anywhere within their limits [rad]
  AxisVector random_motors(const edp::Robot& robot);
  /// @return joints anywhere within the motors' limits [rad, m]
  AxisVector random_joints(const edp::Robot& robot) { return robot.joints_from_motors(random_motors(robot)); }

  std::unique_ptr<edp::Robot> robot_;
  std::vector<const edp::Robot*> models_;
  std::mt19937_64 random_{20260601};
};

}  // namespace mrroc::contract
