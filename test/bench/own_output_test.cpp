// With figures as JSON on standard output, nothing else is written there.
#include "bench/own_output.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace mrroc::bench {
namespace {

TEST(OwnOutput, WhatIsPrintedMeanwhileGoesToTheStandardErrorAlsoByProgramsThatAreStarted) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::printf("before\n");
  {
    const OwnOutput out;
    std::printf("progress\n");
    std::fflush(stdout);
    EXPECT_EQ(std::system("echo child"), 0);
    out.write("{\"figures\": {}}\n");
    std::printf("late\n");
  }
  std::printf("after\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "before\n{\"figures\": {}}\nafter\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "progress\nchild\nlate\n");
}

}  // namespace
}  // namespace mrroc::bench
