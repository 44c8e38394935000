// The table of an arm's run, and the figures that are taken from it.
#include "mp/arm_trace.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "base/text_file.hpp"

namespace mrroc::mp {
namespace {

ArmRow row(std::int64_t i, int m, double Fz) {
  ArmRow r;
  r.i = i;
  r.t = 0.02 * static_cast<double>(i);
  r.m = m;
  r.F[Axis::z] = Fz;
  return r;
}

TEST(ArmTrace, LargestForceIsOfTheStepsWhereTheyAreKnownAndOfTheseBehavioursAlone) {
  ArmTrace trace{row(1, 1, 3), row(2, 2, 9), row(3, 3, 5), row(4, 1, 4)};
  EXPECT_EQ(largest_force(trace, Axis::z, {1}), 4);
  EXPECT_EQ(largest_force(trace, Axis::z, {1, 3}), 5);
  EXPECT_EQ(largest_force(trace, Axis::z, {1, 2, 3}), 9);
  EXPECT_EQ(largest_force(trace, Axis::x, {2}), 0);
  trace[0].F_most = trace[0].F;
  (*trace[0].F_most)[Axis::z] = 7;
  EXPECT_EQ(largest_force(trace, Axis::z, {1}), 7);
  EXPECT_TRUE(std::isnan(largest_force(trace, Axis::z, {4})));
  EXPECT_EQ(largest_force({row(1, 1, -3), row(2, 1, -2)}, Axis::z, {1}), -2)
      << "the largest, not the strongest";
}

TEST(ArmTrace, MeanForceIsOfTheLastTimeOfABehaviour) {
  ArmTrace trace;
  for (int i = 1; i <= 100; ++i) trace.push_back(row(i, 2, i <= 50 ? 100 : i % 2 ? 3 : 5));
  trace.push_back(row(101, 3, 1000));
  EXPECT_NEAR(mean_force(trace, Axis::z, 2, 1.0), 4, 1e-12) << "the last 50 of 2 s";
  EXPECT_NEAR(mean_force(trace, Axis::z, 2, 0.02), 5, 1e-12) << "the last one";
  EXPECT_NEAR(mean_force(trace, Axis::z, 2, 10), 52, 1e-12) << "all";
  EXPECT_TRUE(std::isnan(mean_force(trace, Axis::z, 7, 1)));
}

class ArmTraceFile : public testing::Test {
 protected:
  ArmTraceFile()
      : file(std::filesystem::temp_directory_path() /
             ("arm_trace_test." + std::to_string(::getpid()) + ".csv")) {}
  ~ArmTraceFile() override { std::filesystem::remove(file); }
  std::filesystem::path file;
};

TEST_F(ArmTraceFile, IsReadAsItWasWritten) {
  ArmTrace trace;
  for (int i = 1; i <= 20; ++i) {
    ArmRow r = row(i, i % 4, 0.25 * i);
    for (int k = 0; k < 6; ++k) {
      r.pose[k] = 0.1 * k - 0.01 * i;
      r.F.v[static_cast<std::size_t>(k)] = 0.5 * k - i;
    }
    r.gap = 0.05 + 0.001 * i;
    r.blocked = i % 3 == 0;
    trace.push_back(r);
  }
  write_arm_trace(file, trace);
  const ArmTrace back = read_arm_trace(file);
  ASSERT_EQ(back.size(), trace.size());
  for (std::size_t n = 0; n < trace.size(); ++n) {
    EXPECT_EQ(back[n].i, trace[n].i);
    EXPECT_EQ(back[n].m, trace[n].m);
    EXPECT_EQ(back[n].blocked, trace[n].blocked);
    EXPECT_NEAR(back[n].t, trace[n].t, 1e-4);
    EXPECT_NEAR(back[n].gap, trace[n].gap, 1e-5);
    EXPECT_LT((back[n].pose - trace[n].pose).norm(), 1e-6);
    EXPECT_LT((back[n].F - trace[n].F).vector().norm(), 1e-3);
    EXPECT_FALSE(back[n].F_most);
  }
}

TEST_F(ArmTraceFile, ANumberThatIsNotFiniteIsNotWritten) {
  for (int which = 0; which < 4; ++which) {
    ArmRow r = row(7, 1, 0);
    const double nan = std::nan("");
    (which == 0 ? r.t : which == 1 ? r.pose[5] : which == 2 ? r.F.v[3] : r.gap) = nan;
    EXPECT_THROW(write_arm_trace(file, {r}), FileError) << which;
    EXPECT_FALSE(std::filesystem::exists(file));
  }
}

TEST_F(ArmTraceFile, AnotherTableOrALineTooLongOrTooShortIsRefused) {
  write_arm_trace(file, {row(1, 1, 1)});
  std::ifstream in(file);
  std::string header, line;
  std::getline(in, header);
  std::getline(in, line);
  EXPECT_EQ(header, "i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked");
  for (const std::string& text :
       {header + ",more\n" + line + "\n", header + "\n" + line + ",1\n",
        header + "\n" + line.substr(0, line.rfind(',')) + "\n", header + "\nx" + line + "\n"}) {
    std::ofstream(file, std::ios::trunc) << text;
    EXPECT_THROW((void)read_arm_trace(file), FileError) << text;
  }
}

}  // namespace
}  // namespace mrroc::mp
