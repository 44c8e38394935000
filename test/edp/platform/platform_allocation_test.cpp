// The steps of a platform's driver must not allocate.
#include <gtest/gtest.h>

#include <random>

#include "edp/platform/record.hpp"
#include "test/edp/platform/platform_rig.hpp"
#include "test/heap.hpp"

namespace mrroc::edp::test {
namespace {

/// One macrostep with a command. @return blocks that the driver took from the heap
long allocations(PlatformRig& rig, const PlatformCommand& command) {
  long count = 0;
  {
    const mrroc::test::AllocationCounter heap;
    rig.driver.take(command);
    count += heap.count();
  }
  do {
    const PlatformReading reading = rig.ground.reading();
    const mrroc::test::AllocationCounter heap;
    rig.last = rig.driver.step(reading);
    const PlatformStepRecord record = record_of(rig.driver, reading, rig.last);
    count += heap.count();
    EXPECT_EQ(record.step, reading.step);
    rig.ground.apply(rig.last);
  } while (!rig.driver.at_boundary());
  return count;
}

TEST(PlatformAllocation, TakeAndStepNeverAllocateWhateverTheCommand) {
  std::mt19937_64 random(1);
  PlatformRig rig;
  long count = allocations(rig, rig.command(Instruction::synchro));
  while (rig.driver.state() == DriverState::homing) count += allocations(rig, rig.keep());
  ASSERT_EQ(rig.driver.state(), DriverState::ready);
  Way way = rig.way();
  int faults = 0;
  for (int k = 0; k < 5'000; ++k) {
    PlatformCommand c = rig.keep();
    if (random() % 20 == 0) {
      c = rig.set(way.next(0.2, 0.3, 30));
      if (random() % 4 == 0) c.fragment.knot[5].v = 9;
    }
    if (k % 500 == 250) rig.ground.imu_silent = true;
    if (k % 500 == 260) {
      rig.ground.imu_silent = false;
      c = rig.command(Instruction::reset);
      rig.number = 0;
    }
    count += allocations(rig, c);
    faults += rig.driver.state() == DriverState::faulted;
    if (rig.driver.state() != DriverState::executing) {
      way = rig.way();
      way.number = rig.driver.protocol().owner() ? rig.driver.reply().accepted : 0;
    }
    if (rig.driver.protocol().owner()) rig.number = rig.driver.protocol().expected() - 1;
  }
  EXPECT_EQ(count, 0);
  EXPECT_GT(faults, 10) << "the way of an error must have been taken too";
}

}  // namespace
}  // namespace mrroc::edp::test
