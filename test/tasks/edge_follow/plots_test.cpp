#include "tasks/edge_follow/plots.hpp"

#include <gtest/gtest.h>

namespace mrroc::edge_follow {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Config two_plates() {
  return Config::parse(
      "[robots.arm1]\nplate = { shape = \"rectangle\", length = 0.08, width = 0.05 }\n"
      "[robots.arm2]\nplate = { shape = \"ellipse\", length = 0.09, width = 0.06 }\n[task]\nforce = 3\n"
      "[sim]\npen_radius = 0.008\npaper = { distance = 0.9 }\n",
      "test");
}

TEST(EdgeFollowPlots, ThePlatesAreDrawnWhereTheyLie) {
  const std::string s = path_script(two_plates());
  EXPECT_TRUE(has(s, "$plate1 << EOD\n-40.000,35.000\n40.000,35.000\n40.000,85.000\n-40.000,85.000\n")) << s;
  EXPECT_TRUE(has(s, "$plate2 << EOD\n45.000,60.000\n")) << s;
  EXPECT_TRUE(has(s, "title 'plate'"));
  EXPECT_TRUE(has(s, ":(away(1)):(8.000) with circles")) << "the finger in millimetres";
  EXPECT_TRUE(has(s, "(column(4)-0.900000)")) << "from the centre of the sheet";
  EXPECT_TRUE(has(s, "'to the right [mm]'"));
}

TEST(EdgeFollowPlots, TheForceOfEachArmHasAPanelInSeconds) {
  TimeChart chart = force_chart(two_plates());
  ASSERT_EQ(chart.panels.size(), 2U);
  chart.to = 10;
  const std::string s = time_chart_script(chart);
  for (const char* words : {"arm 1, around its rectangle", "arm 2, around its ellipse", "desired: 3 N", "[N]",
                            "simulated time t [s]"})
    EXPECT_TRUE(has(s, words)) << words;
}

}  // namespace
}  // namespace mrroc::edge_follow
