#include "edp/stability_command.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "test/docs/json_table.hpp"

namespace mrroc::edp {
namespace {

struct Result {
  int status;
  std::string out, err;
};

Result run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = run_stability(arguments, out, err);
  return {status, out.str(), err.str()};
}

TEST(StabilityCommand, TellsTheLimitAndJudgesAStiffness) {
  const Result r = run({"--I", "20", "--B", "0.005", "--bandwidth", "20", "--K", "1e5"});
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.out.find("stable below 5.9"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("UNSTABLE"), std::string::npos);
  EXPECT_NE(r.out.find("lower B to"), std::string::npos);
  EXPECT_TRUE(r.err.empty());
}

TEST(StabilityCommand, GearsThatGiveWayTakeDamping) {
  const auto damping = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "--K", "1e4"});
    return nlohmann::json::parse(run(arguments).out).at("damping_ratio").get<double>();
  };
  EXPECT_LT(damping({"--elasticity", "10", "--link-mass", "12"}), damping({}) / 2);
  EXPECT_NE(run({"--elasticity", "10"}).out.find("gears      10 Hz"), std::string::npos);
}

TEST(StabilityCommand, AdviceHelps) {
  const auto bad = nlohmann::json::parse(run({"--K", "1e5", "--json"}).out);
  EXPECT_FALSE(bad.at("stable"));
  EXPECT_TRUE(test::documented("stability", bad));
  const double B = bad.at("B_for_damping_0.5");
  const auto good = nlohmann::json::parse(run({"--K", "1e5", "--json", "--B", std::to_string(B)}).out);
  EXPECT_TRUE(good.at("stable"));
  EXPECT_NEAR(good.at("damping_ratio"), 0.5, 0.02);
  EXPECT_GT(good.at("limit_N_per_m"), 1e5);
}

TEST(StabilityCommand, AdviceThatHelpsByNextToNothingIsNotGiven) {
  // The gears alone set this limit.
  const std::vector<std::string> soft{"--I", "5", "--B", "0.0025", "--K", "1e4", "--elasticity", "8"};
  EXPECT_EQ(run(soft).out.find("a servo 1.5 times as fast"), std::string::npos) << run(soft).out;
  EXPECT_NE(run({"--K", "1e5"}).out.find("a servo 1.5 times as fast"), std::string::npos);
  std::vector<std::string> as_json = soft;
  as_json.emplace_back("--json");
  const auto told = nlohmann::json::parse(run(as_json).out);
  EXPECT_TRUE(told.at("B_for_damping_0.5").is_null()) << told;
}

TEST(StabilityCommand, WellDampedContactNeedsNoAdvice) {
  const Result r = run({"--I", "5", "--B", "0.0025", "--K", "5e3"});
  EXPECT_EQ(r.status, 0);
  EXPECT_EQ(r.out.find("What to change"), std::string::npos);
}

TEST(StabilityCommand, MapHasTheLimitOfEveryIAndB) {
  const Result r = run({"--map"});
  std::istringstream lines(r.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    double I = 0, B = 0, limit = 0;
    std::istringstream(line) >> I >> B >> limit;
    EXPECT_GT(limit, 0) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 21 * 21);
}

TEST(StabilityCommand, WhatCannotBeMeantIsBadUsage) {
  using Arguments = std::vector<std::string>;
  for (const Arguments& wrong :
       {Arguments{"--B", "0"}, Arguments{"--B", "nan"}, Arguments{"--I", "x"}, Arguments{"--K", "-1"},
        Arguments{"--lag", "0.01", "--bandwidth", "20"}, Arguments{"--what"}, Arguments{"--dt", "0"},
        Arguments{"--delay", "21"}, Arguments{"--bandwidth", "0"}, Arguments{"--lag", "-1"}}) {
    const Result r = run(wrong);
    EXPECT_EQ(r.status, 2) << wrong[0];
    EXPECT_EQ(r.err.rfind("error: bad_usage: ", 0), 0u) << r.err;
    EXPECT_TRUE(r.out.empty());
  }
}

}  // namespace
}  // namespace mrroc::edp
