#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/fault.hpp"
#include "edp/pair_stability_command.hpp"
#include "edp/stability_command.hpp"

namespace mrroc::edp {
namespace {

TEST(PairStability, IsStableBelowItsLimitAndNotAboveIt) {
  for (const double delay : {0.0, 0.02, 0.1}) {
    PairLoop pair;
    pair.delay = delay;
    const double limit = pair_stiffness_limit(pair);
    EXPECT_LT(pair_radius(pair, 0.95 * limit), 1) << delay;
    EXPECT_GE(pair_radius(pair, 1.05 * limit), 1) << delay;
  }
}

TEST(PairStability, HasTheLimitOfTheSlaveAloneWhenTheMasterFeelsNothing) {
  PairLoop pair;
  pair.force_scale = 1e-9;
  EXPECT_NEAR(pair_stiffness_limit(pair) / stiffness_limit(pair.slave), 1, 0.05)
      << "the rest is the rate with which it returns to its place";
}

TEST(PairStability, BearsLessWithMoreDelayAndWithMoreForce) {
  PairLoop pair, late, strong;
  late.delay = 0.05;
  strong.force_scale = 3;
  EXPECT_LT(pair_stiffness_limit(late), pair_stiffness_limit(pair));
  EXPECT_LT(pair_stiffness_limit(strong), pair_stiffness_limit(pair));
}

TEST(PairStability, SettlesOnlyWithAMarginAndWithoutMuchDelay) {
  PairLoop pair;
  const double limit = pair_stiffness_limit(pair);
  EXPECT_TRUE(pair_settles(pair, limit / 3, 0));
  EXPECT_FALSE(pair_settles(pair, 0.9 * limit, 0));
  EXPECT_FALSE(pair_settles(pair, limit / 3, 0.05));
}

TEST(PairStability, HasColgatesBoundForTheMastersDamping) {
  PairLoop pair;
  pair.master.mobility = 0.002;
  EXPECT_NEAR(colgate_bound(pair), 2 * 500 / 0.004, 1e-6) << "2 b / T";
  pair.motion_scale = 2;
  pair.force_scale = 1.5;
  EXPECT_NEAR(colgate_bound(pair), 2 * 500 / 0.004 / 3, 1e-6)
      << "the hand feels a wall of three times the stiffness";
}

TEST(PairStability, RefusesWhatMakesNoSense) {
  const auto refused = [](auto change) {
    PairLoop pair;
    change(pair);
    EXPECT_THROW(static_cast<void>(pair_stiffness_limit(pair)), FaultError);
  };
  refused([](PairLoop& p) { p.delay = 0.3; });
  refused([](PairLoop& p) { p.hand_stiffness = 0; });
  refused([](PairLoop& p) { p.return_rate = NAN; });
  refused([](PairLoop& p) { p.n_s = 1; });
  refused([](PairLoop& p) { p.master.mobility = 0; });
  refused([](PairLoop& p) { p.slave.dt = 0.001; });
}

TEST(PairStabilityCommand, TellsTheLimitAndJudgesAWall) {
  std::ostringstream out, err;
  ASSERT_EQ(run_stability({"--pair", "--delay", "20", "--K", "1e4", "--json"}, out, err), 0) << err.str();
  const auto json = nlohmann::json::parse(out.str());
  PairLoop pair;
  pair.delay = 0.02;
  EXPECT_NEAR(json.at("limit_N_per_m").get<double>() / pair_stiffness_limit(pair), 1, 1e-4);
  EXPECT_EQ(json.at("stable").get<bool>(), pair_radius(pair, 1e4) < 1);
  std::ostringstream text;
  ASSERT_EQ(run_stability({"--pair", "--delay", "200", "--K", "5e4"}, text, err), 0);
  EXPECT_NE(text.str().find("UNSTABLE"), std::string::npos) << text.str();
}

TEST(PairStabilityCommand, RefusesWhatMakesNoSense) {
  std::ostringstream out, err;
  EXPECT_EQ(run_stability({"--pair", "--delay", "500"}, out, err), 2);
  EXPECT_NE(err.str().find("delay"), std::string::npos) << err.str();
}

}  // namespace
}  // namespace mrroc::edp
