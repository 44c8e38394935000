#include "tasks/visual_servo/plots.hpp"

#include <gtest/gtest.h>

namespace mrroc::visual_servo {
namespace {

TEST(VisualServoPlots, HaveSecondsUnitsAndTheNamesOfBehaviours) {
  ServoTable table(100);
  for (std::size_t k = 0; k < table.size(); ++k) {
    table[k].t = 2.4 + 0.04 * static_cast<double>(k);
    table[k].behaviour = k < 10 ? 0 : k < 40 ? 1 : k < 50 ? 3 : 2;
  }
  const auto all = plots(table);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].first, "error");
  EXPECT_EQ(all[1].first, "true_error");
  for (const auto& [name, script] : all)
    for (const char* words : {"set xlabel 'simulated time t [s]'", "set xrange [2.4:6.36]", "'1 PB-SAC'",
                              "'2 PB-EIH'", "no camera sees", "error [mm]", "set output 'plots/"})
      EXPECT_NE(script.find(words), std::string::npos) << name << " lacks " << words;
  EXPECT_NE(all[1].second.find("error [deg]"), std::string::npos);
  EXPECT_EQ(all[0].second.find("control step"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::visual_servo
