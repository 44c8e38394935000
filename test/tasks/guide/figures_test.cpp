#include "tasks/guide/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tasks/guide/plots.hpp"

namespace mrroc::guide {
namespace {

Config line() {
  return Config::parse(
      "[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 10\nmass_centre = [0, 0, 0.1]\n"
      "[task]\ncentre = [0.9, 0, 1]\nturned = [0, 0, 0]\nlength = 0.1\n",
      "test");
}

/// A row of a tool whose frame is that of the base.
mp::ArmRow row(double t, int m, const Vector3& p, const Vector3& F) {
  mp::ArmRow r{.t = t, .m = m};
  r.pose.head<3>() = p;
  r.F = Wrench::from(F, Vector3::Zero());
  return r;
}

double value(const mp::ArmTrace& trace, const char* key) {
  return std::get<double>(mp::figure(figures({trace}, line()), key));
}

TEST(GuideFigures, OfARunThatNeverHeldAreNoNumbers) {
  for (const mp::TaskFigure& f : figures({{}}, line()))
    EXPECT_TRUE(std::isnan(std::get<double>(f.value))) << f.info.key;
}

TEST(GuideFigures, AreThoseOfAToolThatIsLedAlong) {
  mp::ArmTrace trace;
  for (int k = 0; k <= 10; ++k)  // at 0.1 m/s, 3 N along, 8 N across, 0.4 mm off
    trace.push_back(row(0.01 * k, kGuided, {0.9 + 0.001 * k, 0.0004, 1}, {-3, -8, 0}));
  EXPECT_NEAR(value(trace, "fixture_dev_mm"), 0.4, 1e-6);
  EXPECT_NEAR(value(trace, "across_force_N"), 8, 1e-9);
  EXPECT_NEAR(value(trace, "compliance_mm_per_10N"), 0.5, 1e-6);
  EXPECT_NEAR(value(trace, "fixture_drag_N"), 3, 1e-6);
  EXPECT_EQ(value(trace, "wall_force_N"), 0);
  EXPECT_NEAR(value(trace, "least_energy_mJ"), 0, 1e-9) << "it gives all the time";
}

TEST(GuideFigures, AForceThatComesBackIsNoDrag) {
  mp::ArmTrace trace;
  for (int k = 0; k <= 100; ++k)
    trace.push_back(row(0.01 * k, kGuided, {0.9 + 0.0004 * k, 0, 1}, {k % 2 == 0 ? -5. : 3., 0, 0}));
  EXPECT_NEAR(value(trace, "fixture_drag_N"), 1, 0.05) << "the mean, so a tremor does not count";
}

TEST(GuideFigures, WallsDoNotCountAsDrag) {
  mp::ArmTrace trace;
  for (int k = 0; k <= 10; ++k)
    trace.push_back(row(0.01 * k, kGuided, {0.951 + 0.001 * k, 0, 1}, {-20. - k, 0, 0}));
  EXPECT_TRUE(std::isnan(value(trace, "fixture_drag_N")));
  EXPECT_NEAR(value(trace, "wall_force_N"), 30, 1e-9);
  EXPECT_NEAR(value(trace, "wall_depth_mm"), 11, 1e-6);
}

TEST(GuideFigures, AFixtureThatPushesTheHandHasGivenEnergy) {
  mp::ArmTrace trace;
  for (int k = 0; k <= 10; ++k) trace.push_back(row(0.01 * k, kGuided, {0.9 + 0.001 * k, 0, 1}, {2, 0, 0}));
  EXPECT_NEAR(value(trace, "least_energy_mJ"), -20, 1e-6);
}

TEST(GuideFigures, TheEntryIsJudgedByItsLargestStep) {
  mp::ArmTrace trace;
  for (int k = 0; k <= 10; ++k)
    trace.push_back(row(0.008 * k, kEnter, {0.9, 0.005 - (k > 4 ? 0.002 : 0), 1}, Vector3::Zero()));
  trace.push_back(row(0.088, kGuided, {0.9, 0, 1}, Vector3::Zero()));  // does not count
  EXPECT_NEAR(value(trace, "entry_step_mm"), 0.5, 1e-6) << "2 mm in a macrostep of 4 steps";
}

TEST(GuidePlots, ShowTheFixtureInItsPlane) {
  const auto k = read_setup(line(), "arm1");
  const std::string s = fixture_script(*k);
  EXPECT_NE(s.find("-50.000,0.000"), std::string::npos) << s;
  EXPECT_NE(s.find("50.000,0.000"), std::string::npos);
  const TimeChart chart = force_chart({row(0, kGuided, {0.9, 0.0004, 1}, {-3, -8, 0})}, *k);
  EXPECT_EQ(chart.panels.size(), 2U);
  EXPECT_NE(chart.data.find("0.0000,3.0000,8.0000,0.40000,0.00000"), std::string::npos) << chart.data;
}

}  // namespace
}  // namespace mrroc::guide
