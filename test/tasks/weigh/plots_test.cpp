#include "tasks/weigh/plots.hpp"

#include <gtest/gtest.h>

#include "tasks/weigh/weigh.hpp"

namespace mrroc::weigh {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The tool, with 10.8 N, up and then sideways.
mp::ArmTrace weighing(int last) {
  mp::ArmTrace trace;
  for (int m = 1; m <= last; ++m)
    for (int k = 0; k < 20; ++k) {
      mp::ArmRow& row = trace.emplace_back();
      row.t = 0.02 * static_cast<double>(trace.size());
      row.m = m;
      if (m == kWithToolUp) row.F[Axis::z] = 2 * 10.8;
      if (m == kWithToolSideways) row.F[Axis::z] = 10.8;
    }
  return trace;
}

TEST(WeighPlots, ShowForcesAndMomentsWithTheMeansAndTheToolFound) {
  TimeChart chart = forces_chart(weighing(10));
  chart.to = 4;
  const std::string s = time_chart_script(chart);
  ASSERT_EQ(chart.panels.size(), 2U);
  for (const char* words :
       {"using 2:10", "using 2:15", "force [N]", "moment [N m]", "'F_z'", "mean of the readings"})
    EXPECT_TRUE(has(s, words)) << words;
  EXPECT_TRUE(has(s, "first 21.6 to first 2.4000, first 21.6 nohead")) << s;
  ASSERT_EQ(chart.notes.size(), 1U);
  EXPECT_TRUE(has(chart.notes[0], "weight 10.80 N")) << chart.notes[0];
}

TEST(WeighPlots, SayNothingOfAToolThatWasNotWeighed) {
  EXPECT_TRUE(forces_chart(weighing(7)).notes.empty());
  EXPECT_TRUE(forces_chart({}).notes.empty());
}

}  // namespace
}  // namespace mrroc::weigh
