// A broken force sensor under an arm that presses: whatever the way in which it breaks, the arm stops.
#include <gtest/gtest.h>

#include <array>

#include "test/sim/pressing_arm.hpp"

namespace mrroc::sim {
namespace {

struct Mode {
  SensorFault fault;
  FaultCode code;
  int component;
  int notice;  // steps from the first broken reading to the fault
};

constexpr std::array kModes{Mode{SensorFault::stuck, FaultCode::force_stuck, 0, 25},
                            Mode{SensorFault::saturated, FaultCode::force_saturated, 2, 3},
                            Mode{SensorFault::silent, FaultCode::sensor_silent, -1, 3},
                            Mode{SensorFault::nan, FaultCode::force_not_finite, 3, 3}};

class BrokenForceSensor : public testing::TestWithParam<Mode> {};

TEST_P(BrokenForceSensor, StopsAnArmThatPresses) {
  constexpr std::int64_t kBreaks = 3500;
  constexpr int kStop = 40;  // steps that the driver's own stop would take
  WorldParameters w = PressingArm::world_of_one();
  w.arms[0].sensor.fault = GetParam().fault;
  w.arms[0].sensor.fault_step = kBreaks;
  PressingArm arm(w);
  arm.prepare();
  const TaskFrameCommand press{u(), u(), g(0.01, 20, 0.005), u(), u(), u()};
  double peak = 0, speed = 0;
  Vector3 set_point;
  std::int64_t fault_step = 0, wrong = 0;
  arm.after_each_step = [&] {
    const edp::Driver& driver = *arm.driver;
    const std::int64_t step = arm.world.steps() - 1;  // of the reading that the driver had
    if (driver.state() == DriverState::faulted) {
      if (fault_step == 0) fault_step = step;
      if (step > fault_step) wrong += driver.set_point().T_0E.p != set_point;
    }
    set_point = driver.set_point().T_0E.p;
    if (step >= kBreaks) peak = std::max(peak, arm.force());
    if (fault_step > 0 && step > fault_step + kStop)
      speed = std::max(speed, arm.world.truth(0).tip_velocity.norm());
  };
  while (arm.world.steps() < kBreaks - 20) {
    ASSERT_EQ(arm.move(press).verdict, Verdict::executed);
  }
  EXPECT_NEAR(arm.force(), 2, 0.5) << "it presses before the sensor breaks";
  for (int k = 0; k < 20; ++k) arm.move(press);
  const Fault& fault = arm.driver->fault();
  EXPECT_EQ(fault.code, GetParam().code);
  EXPECT_EQ(class_of(fault.code), FaultClass::fatal);
  EXPECT_EQ(fault.axis, GetParam().component);
  EXPECT_EQ(fault_step, kBreaks + GetParam().notice - 1);
  EXPECT_EQ(wrong, 0) << "the set point stands from the fault on";
  EXPECT_LT(speed, 0.5e-3) << "the brakes hold the tip";
  EXPECT_LT(peak, 5);
}

INSTANTIATE_TEST_SUITE_P(EveryMode, BrokenForceSensor, testing::ValuesIn(kModes),
                         [](const auto& m) { return std::string(to_string(m.param.code)); });

}  // namespace
}  // namespace mrroc::sim
