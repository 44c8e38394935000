// The servo step must not allocate.
#include <gtest/gtest.h>

#include "bench/heap.hpp"
#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

TEST(Allocation, CounterSeesTheHeap) {
  const bench::AllocationCounter heap;
  int* volatile number = new int(3);
  EXPECT_EQ(heap.count(), 1);
  delete number;
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
      const bench::AllocationCounter heap;
      rig.driver.take(command);
      allocations += heap.count();
    }
    do {
      const HardwareReading reading = rig.world.reading();
      HardwareCommand drives;
      {
        const bench::AllocationCounter heap;
        drives = rig.driver.step(reading);
        allocations += heap.count();
      }
      rig.world.apply(drives);
    } while (!rig.driver.at_boundary());
    if (rig.driver.protocol().owner() && rig.number >= rig.driver.protocol().expected())
      rig.number = rig.driver.protocol().expected() - 1;
    failed += rig.driver.reply().verdict == Verdict::failed;
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(failed, 10) << "the way of an error must have been taken too";
}

}  // namespace
}  // namespace mrroc::edp::test
