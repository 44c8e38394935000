// The servo step must not allocate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edp/gripper.hpp"
#include "robots/gripper/jaws.hpp"
#include "test/edp/random_command.hpp"
#include "test/heap.hpp"

namespace mrroc::edp::test {
namespace {

TEST(Allocation, CounterSeesTheHeap) {
  const mrroc::test::AllocationCounter heap;
  int* volatile number = new int(3);
  EXPECT_EQ(heap.count(), 1);
  delete number;
}

/// One step of driver and world. @return blocks that the driver took from the heap
long allocations_of_step(Rig& rig) {
  const HardwareReading reading = rig.world.reading();
  long count = 0;
  {
    const mrroc::test::AllocationCounter heap;
    rig.last = rig.driver.step(reading);
    count = heap.count();
  }
  rig.world.apply(rig.last);
  return count;
}

TEST(Allocation, TakeAndStepNeverAllocateWhateverTheCommand) {
  std::mt19937_64 random(1);
  Rig rig;
  rig.synchronise();
  long allocations = 0;
  long failed = 0;
  for (int k = 0; k < 20'000; ++k) {
    EffectorCommand command = rig.set_arm(random_motion(random));
    switch (pick(random, 12)) {
      case 0:
        command.arm.frame.x = u(77);  // refused
        break;
      case 1:
        command.number += 5;  // refused, with a number in its text
        --rig.number;
        break;
      case 2:
        command.session = 8;
        --rig.number;
        break;
      case 3:
        command.arm.mu = Interpolation::tcim_velocity;  // into a limit sooner or later
        command.arm.frame = {u(), u(0.4), u(), u(), u(), u()};
        break;
      case 4:
        command.instruction = Instruction::set_get;
        command.get = static_cast<std::uint8_t>(Part::arm);
        command.get_representation = static_cast<Representation>(pick(random, 5));
        break;
      case 5:
        command.set = static_cast<std::uint8_t>(command.set | static_cast<unsigned>(Part::robot_model));
        command.robot_model.set_tool = true;
        command.robot_model.tool = numbers_from_pose(Representation::frame, Pose{});
        break;
      default:
        break;
    }
    if (k % 500 == 499) rig.world.switches[1] = static_cast<std::uint8_t>(AxisSwitch::over_current);
    if (k % 500 == 0) {
      rig.world.switches[1] = 0;
      command.instruction = Instruction::reset;
      rig.number = 0;
    }
    const bool silent = pick(random, 10) == 0;
    if (silent && command.instruction != Instruction::reset) --rig.number;
    if (!silent || command.instruction == Instruction::reset) {
      const mrroc::test::AllocationCounter heap;
      rig.driver.take(command);
      allocations += heap.count();
    }
    do allocations += allocations_of_step(rig);
    while (!rig.driver.at_boundary());
    if (rig.driver.protocol().owner() && rig.number >= rig.driver.protocol().expected())
      rig.number = rig.driver.protocol().expected() - 1;
    failed += rig.driver.reply().verdict == Verdict::failed;
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(failed, 10) << "the way of an error must have been taken too";
}

TEST(Allocation, HomingNeverAllocatesWhetherItFindsTheSwitchesOrNot) {
  for (const bool missing : {false, true}) {
    DriverParameters p = Rig::parameters();
    p.synchronisation = Synchronisation::homing;
    for (AxisHoming& axis : p.homing.axis) axis.coarse = 100;
    Rig rig(p);
    rig.world.synchro[4].missing = missing;
    rig.driver.take(rig.command(Instruction::synchro));
    long allocations = 0;
    for (int k = 0; k < 200'000 && (k < 10 || rig.driver.state() == DriverState::homing); ++k)
      allocations += allocations_of_step(rig);
    EXPECT_EQ(rig.driver.state(), missing ? DriverState::faulted : DriverState::ready);
    EXPECT_EQ(allocations, 0);
  }
}

TEST(Allocation, JawsNeverAllocate) {
  const GripperParameters p = gripper::two_jaw();
  Gripper jaws(p, 0.002);
  double motor = 0;  // [rad], stops at the opening
  double pwm = 0;
  long allocations = 0;
  jaws.start_homing();
  for (int k = 0; k < 20'000; ++k) {
    motor = std::clamp(motor + 0.02 * pwm, gripper::kOpenStop, gripper::kClosedStop);
    const auto count = static_cast<std::int32_t>(std::lround(motor * p.increments_per_rad));
    const double current = motor == gripper::kOpenStop ? 0.12 : 0.01;  // [A]
    const mrroc::test::AllocationCounter heap;
    EXPECT_FALSE(jaws.measure(count, current));
    EXPECT_TRUE(check_distance(p, 0.2));
    pwm = jaws.step();
    if (jaws.known() && k % 1000 == 0) jaws.set_distance(k % 2000 == 0 ? 0.06 : 0.085);
    if (jaws.known() && k % 3000 == 2999) jaws.braked();
    allocations += heap.count();
  }
  EXPECT_TRUE(jaws.known());
  EXPECT_EQ(allocations, 0);
}

TEST(Allocation, ObserverOfOscillationsNeverAllocates) {
  OscillationObserver observer({}, 0.002);
  long allocations = 0;
  int told = 0;
  for (int k = 0; k < 5'000; ++k) {
    Wrench F;
    F[Axis::z] = 5 + std::exp(0.0003 * k) * std::sin(0.15 * k);
    const AxisSet watched(k % 2000 == 1999 ? 0 : 0b100);
    const mrroc::test::AllocationCounter heap;
    told += observer.step(F, watched).has_value();
    allocations += heap.count();
  }
  EXPECT_GT(told, 0);
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace mrroc::edp::test
