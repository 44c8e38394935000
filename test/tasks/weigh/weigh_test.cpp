#include "tasks/weigh/weigh.hpp"

#include <gtest/gtest.h>

#include "robots/irb6/arm.hpp"

namespace mrroc::weigh {
namespace {

Memory memory_of_defaults() {
  return read_memory(
      Config::parse(std::string(config()) + "[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 10\n"
                                            "mass_centre = [0, 0, 0]\n",
                    "weigh.toml"),
      "arm1");
}

TEST(Weigh, TurnsTheToolDownUpAndSideways) {
  const ecp::WeighingPlan plan = memory_of_defaults().weighing.plan;
  const irb6::Arm arm(irb6::kPostument);
  const auto R = [&](const ecp::Coordinates& q) { return arm.forward(AxisVector(q)).R; };
  EXPECT_NEAR(R(plan.down)(2, 2), -1, 1e-4);
  EXPECT_NEAR(R(plan.up)(2, 2), 1, 1e-4);
  EXPECT_NEAR(R(plan.side)(2, 0), 1, 1e-4) << "x points up";
  for (const ecp::Coordinates& q : {plan.down, plan.up, plan.side})
    for (int k = 0; k < arm.axes(); ++k) {
      EXPECT_TRUE(arm.axis(k).joint.contains(q[k])) << k;
      EXPECT_TRUE(arm.axis(k).motor.contains(arm.motors_from_joints(AxisVector(q))[k])) << k;
    }
  EXPECT_NEAR(plan.T_WE.p.z(), 0.25, 1e-12) << "the tool that is set in the end";
}

// MG (40)-(42), with what a tool of 8 N with its centre at (1, -2, 15) cm does to F_a after a bias with z down.
TEST(Weigh, FindsTheToolInTheRowsThatReadTheForce) {
  constexpr double w = 8;
  const Vector3 P(0.01, -0.02, 0.15);
  mp::ArmTrace trace;
  for (int m = 1; m <= 10; ++m)
    for (int k = 0; k < 5; ++k) {
      mp::ArmRow& row = trace.emplace_back();
      row.m = m;
      row.F = {{100, 100, 100, 100, 100, 100}};  // what is not read
      const double noise = k - 2;
      if (m == 6) row.F = {{0, 0, 2 * w + noise, 2 * w * P.y(), -2 * w * P.x(), 0}};
      if (m == 9) row.F = {{0, 0, noise, 0, w * (P.z() - P.x()), 0}};
    }
  const ecp::ForceTool tool = found_tool(trace);
  EXPECT_NEAR(tool.w, w, 1e-12);
  EXPECT_LT((tool.P - P).norm(), 1e-12);
  EXPECT_EQ(result({trace}), "[robots.arm1.tool]\nweight = 8.000\nmass_centre = [0.0100, -0.0200, 0.1500]\n");
  EXPECT_EQ(std::get<double>(mp::figure(figures({trace}, Config()), "tool_weight_N")), tool.w);
}

TEST(Weigh, TheMeanIsOfAllRowsOfABehaviourAndOfEachAxis) {
  mp::ArmTrace trace;
  for (int k = 0; k < 4; ++k) {
    mp::ArmRow& row = trace.emplace_back();
    row.t = 100. * k;
    row.m = k < 3 ? 5 : 6;
    for (std::size_t a = 0; a < 6; ++a) row.F.v[a] = k + 10. * static_cast<double>(a);
  }
  const Wrench mean = mean_reading(trace, 5);
  for (std::size_t a = 0; a < 6; ++a) EXPECT_NEAR(mean.v[a], 1 + 10. * static_cast<double>(a), 1e-12);
}

TEST(Weigh, ReadsAsOftenAsItIsToldWithinBounds) {
  const auto readings = [](const std::string& n) -> int {
    Config config = Config::parse(std::string(weigh::config()) +
                                      "[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 10\n"
                                      "mass_centre = [0, 0, 0]\n",
                                  "weigh.toml");
    config.set("task.readings=" + n);
    try {
      return read_memory(config, "arm1").weighing.plan.readings;
    } catch (const ConfigError&) {
      return -1;
    }
  };
  EXPECT_EQ(readings("10"), 10);
  EXPECT_EQ(readings("1000"), 1000);
  EXPECT_EQ(readings("9"), -1);
  EXPECT_EQ(readings("1001"), -1);
}

TEST(Weigh, TheMassCentreIsToldByItsThreeCoordinates) {
  mp::ArmTrace trace;
  for (const int m : {kWithToolUp, kWithToolSideways}) {
    mp::ArmRow& row = trace.emplace_back();
    row.m = m;
    row.F = m == kWithToolUp ? Wrench{{0, 0, 16, -0.32, -0.16, 0}} : Wrench{{0, 0, 0, 0, 1.12, 0}};
  }
  const ecp::ForceTool tool = found_tool(trace);
  const auto f = figures({trace}, Config());
  EXPECT_EQ(std::get<std::vector<double>>(mp::figure(f, "tool_mass_centre_m")),
            (std::vector{tool.P.x(), tool.P.y(), tool.P.z()}));
}

}  // namespace
}  // namespace mrroc::weigh
