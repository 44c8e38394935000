// The largest force of every step between two rows of an arm's table, from the log.
#include "mp/step_forces.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/link/event_log.hpp"
#include "mrroc/step_samples_t.hpp"

namespace mrroc::mp {
namespace {

TEST(StepForces, ARowHasTheLargestOfTheStepsOfTheMacrostepBefore) {
  const auto file =
      std::filesystem::temp_directory_path() / ("step_forces_test." + std::to_string(::getpid()) + ".lcm");
  {
    link::EventLog log(file, 7);
    std::int64_t messages = 0;
    const auto write = [&](std::int64_t macrostep, std::int32_t n, double least) {
      step_samples_t m{};
      ++messages;
      m.header = {7, messages, messages};
      m.macrostep = macrostep;
      m.n = n;
      for (int k = 0; k < 32; ++k)
        for (int a = 0; a < 6; ++a) m.sample[k].F_a[a] = least + k % 3 + 10 * a;
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
      m.encode(bytes.data(), 0, m.getEncodedSize());
      log.receive("s.arm1.samples", bytes);
    };
    write(4, 3, 1);
    write(5, 1, 100);
    write(6, 1000, -50);  // of somebody who cannot count
    write(8, -3, 70);
  }
  ArmTrace trace(4);
  for (std::size_t k = 0; k < 4; ++k) trace[k].i = std::array{5, 6, 7, 9}[k];
  trace[2].F[Axis::z] = 33;
  ArmTrace other = trace;
  other[0].i = 50;
  add_step_forces(trace, link::LogReader(file), "arm1");
  ASSERT_TRUE(trace[0].F_most && trace[1].F_most && trace[2].F_most && trace[3].F_most);
  for (const Axis a : kAxes) {
    const int row = static_cast<int>(a);
    EXPECT_EQ((*trace[0].F_most)[a], 3 + 10 * row);
    EXPECT_EQ((*trace[1].F_most)[a], 100 + 10 * row) << "of one step";
    EXPECT_EQ((*trace[3].F_most)[a], 0) << "of none: the row's own";
  }
  EXPECT_EQ((*trace[2].F_most)[Axis::z], 33) << "the row's own is larger";
  EXPECT_EQ((*trace[2].F_most)[Axis::az], 2) << "-48 + 50";
  add_step_forces(other, link::LogReader(file), "arm2");
  for (const ArmRow& row : other) EXPECT_FALSE(row.F_most) << "nothing is known of that arm's steps";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace mrroc::mp
