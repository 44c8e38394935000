// What is written down about a step.
#include "edp/platform/record.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

TEST(PlatformRecord, HasANumberForEveryColumn) {
  PlatformRig rig;
  ASSERT_TRUE(rig.synchronise());
  rig.macrostep(rig.set(rig.way().next(0.3, 0, 50)));
  rig.wait(10);
  const PlatformReading reading = rig.ground.reading();
  const PlatformStepRecord record = record_of(rig.driver, reading, rig.driver.step(reading));
  std::string line;
  record.append(line, PlatformDriver::kStep);
  const std::string header = PlatformStepRecord::header();
  EXPECT_EQ(std::ranges::count(header, ','), std::ranges::count(line, ','));
  EXPECT_EQ(header.back(), '\n');
  EXPECT_EQ(line.back(), '\n');
  EXPECT_NE(line.find(",executing,none,"), std::string::npos) << line;
  EXPECT_NEAR(record.p.x, rig.driver.wanted().p.x, 0.05);
  EXPECT_TRUE(record.enabled);
}

TEST(PlatformRecord, HasEveryNumberInItsColumn) {
  PlatformStepRecord r;
  r.step = 7;
  r.state = DriverState::executing;
  r.fault = FaultCode::wheel_blocked;
  r.wanted = {{1, 2, 3}, 4, 5};
  r.p = {6, 7, 8};
  r.v = {9, 10, 11};
  r.encoder = {12, 13, 14, 15};
  r.yaw = 16;
  r.yaw_rate = 17;
  r.imu_valid = true;
  r.load = {18, 19, 20, 21};
  r.current = {22, 23, 24, 25};
  r.torque = {26, 27, 28, 29.5};
  std::string line = "before\n";
  r.append(line, 0.002);
  EXPECT_EQ(line,
            "before\n7,0.0140,executing,wheel_blocked,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,1,18,19,20,"
            "21,22,23,24,"
            "25,0,26,27,28,29.5\n");
  r.imu_valid = false;
  r.enabled = true;
  line.clear();
  r.append(line, 0.002);
  EXPECT_NE(line.find(",16,17,0,18,"), std::string::npos) << line;
  EXPECT_NE(line.find(",25,1,26,"), std::string::npos) << line;
  EXPECT_EQ(PlatformStepRecord::header(),
            "step,t,state,fault,set_x,set_y,set_phi,set_v,set_w,x,y,phi,vx,vy,w,enc_fl,enc_fr,enc_rl,enc_rr,"
            "yaw,yaw_rate,"
            "imu_valid,load_fl,load_fr,load_rl,load_rr,current_fl,current_fr,current_rl,current_rr,enabled,"
            "torque_fl,"
            "torque_fr,torque_rl,torque_rr\n");
}

TEST(PlatformRecord, IsOfTheReadingTheDriverAndTheCommand) {
  PlatformRig rig;
  ASSERT_TRUE(rig.synchronise());
  rig.macrostep(rig.set(rig.way().next(0.3, 0, 50)));
  rig.wait(10);
  PlatformReading reading = rig.ground.reading();
  reading.current = {1, 2, 3, 4};
  reading.yaw = 0.7;
  reading.yaw_rate = 0.1;
  const PlatformDrive command{.torque = {5, 6, 7, 8}, .enabled = true};
  const PlatformStepRecord r = record_of(rig.driver, reading, command);
  EXPECT_EQ(r.step, reading.step);
  EXPECT_EQ(r.state, DriverState::executing);
  EXPECT_EQ(r.fault, FaultCode::none);
  EXPECT_EQ(r.wanted.v, rig.driver.wanted().v);
  EXPECT_NE(r.wanted.v, 0);
  EXPECT_EQ(r.p.x, rig.driver.estimate().estimate.p.x);
  EXPECT_EQ(r.v.vx, rig.driver.estimate().estimate.v.vx);
  EXPECT_NE(r.v.vx, 0);
  EXPECT_EQ(r.encoder, reading.encoder);
  EXPECT_EQ(r.yaw, 0.7);
  EXPECT_EQ(r.yaw_rate, 0.1);
  EXPECT_EQ(r.imu_valid, reading.imu_valid);
  EXPECT_EQ(r.load, reading.load);
  EXPECT_EQ(r.current, reading.current);
  EXPECT_TRUE(r.enabled);
  EXPECT_EQ(r.torque, command.torque);
}

}  // namespace
}  // namespace mrroc::edp::test
