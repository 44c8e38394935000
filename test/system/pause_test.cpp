// A pause of every task whose arms work on their own, as rule R8 has it: arms stand, forces stay, readings go on, and the
// path is the one of a run without a pause.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <tuple>

#include "base/link/log_reader.hpp"
#include "base/operator.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/task_status_t.hpp"
#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

constexpr int kLasts = 60;        // macrosteps of a pause
constexpr int kComesToRest = 25;  // macrosteps from the order to rest, and until the report of it

struct Recorded {
  nlohmann::json summary;
  std::vector<std::vector<Row>> arms;
};

class Paused : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }

  /// @param pauses  macrosteps of the order; each lasts kLasts
  Recorded ran(const std::string& task, const std::vector<int>& pauses,
               const std::vector<std::string>& more = {}, int arms = 1) {
    std::string script = "3 start\n";
    for (const int i : pauses)
      script += std::to_string(i) + " pause\n" + std::to_string(i + kLasts) + " resume\n";
    const std::string name = task + std::to_string(++runs_);
    const Ended ended = run(folder_, task,
                            words({{"--processes", "one", "--script", folder_.write(name + ".script", script),
                                    "--run-dir", (folder_ / name).string()},
                                   more}));
    EXPECT_EQ(ended.status, 0) << ended.all();
    Recorded r{summary(folder_ / name), {}};
    for (int arm = 1; arm <= arms; ++arm)
      r.arms.push_back(read_table(folder_ / name / ("arm" + std::to_string(arm) + ".csv"), kArmHeading));
    return r;
  }

  Folder folder_;  // every run is recomputed from its log, pauses and all
  int runs_{};
};

/// @return the rows in which the arm must stand
std::vector<Row> standing(const std::vector<Row>& arm, int pause) {
  std::vector<Row> rows;
  for (const Row& row : arm)
    if (row[kI] >= pause + kComesToRest && row[kI] < pause + kLasts) rows.push_back(row);
  return rows;
}

double distance(const Row& a, const Row& b) {
  return std::hypot(a[kX] - b[kX], a[kY] - b[kY], a[kZ] - b[kZ]);
}

/// The arm stands and its readings go on.
/// @param most  that the tool's tip may move [m]
void expect_rest(const std::vector<Row>& rows, double most) {
  ASSERT_GT(rows.size(), 20U);
  std::set<std::vector<double>> readings;
  for (const Row& row : rows) {
    EXPECT_LT(distance(row, rows.front()), most) << "macrostep " << row[kI];
    readings.emplace(row.begin() + kX, row.begin() + 15);
  }
  EXPECT_GT(readings.size(), rows.size() / 2) << "readings have frozen";
}

/// @return largest distance of the points of one way from the other way [m]
double deviation(const std::vector<Row>& way, const std::vector<Row>& from) {
  double largest = 0;
  for (const Row& p : way) {
    double nearest = 1e9;
    for (std::size_t k = 1; k < from.size(); ++k) {
      const double a[3]{from[k - 1][kX], from[k - 1][kY], from[k - 1][kZ]};
      const double d[3]{from[k][kX] - a[0], from[k][kY] - a[1], from[k][kZ] - a[2]};
      const double v[3]{p[kX] - a[0], p[kY] - a[1], p[kZ] - a[2]};
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      const double share =
          square > 0 ? std::clamp((v[0] * d[0] + v[1] * d[1] + v[2] * d[2]) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, std::hypot(v[0] - share * d[0], v[1] - share * d[1], v[2] - share * d[2]));
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

/// @return number of the row's macrostep somewhere in the stretch of that behaviour
int within(const std::vector<Row>& arm, int m, double share) {
  const auto all = stretches(arm, m);
  EXPECT_FALSE(all.empty()) << m;
  if (all.empty()) return 1;
  const auto [first, last] = all.front();
  return static_cast<int>(
      arm[first + static_cast<std::size_t>(share * static_cast<double>(last - first))][kI]);
}

/// @return the rows of the behaviours from 1 to m
std::vector<Row> up_to(const std::vector<Row>& arm, int m) {
  std::vector<Row> rows;
  std::ranges::copy_if(arm, std::back_inserter(rows), [m](const Row& r) { return r[kM] >= 1 && r[kM] <= m; });
  return rows;
}

double mean_Fz(const std::vector<Row>& rows) {
  double sum = 0;
  for (const Row& row : rows) sum += row[kFz];
  return sum / static_cast<double>(rows.size());
}

TEST_F(Paused, PressKeepsItsForceInEveryBehaviourAndGoesOnAsBefore) {
  const Recorded plain = ran("press", {});
  std::mt19937 random(3);
  for (const int m : {1, 2, 3, 4}) {
    const double share = 0.2 + 0.5 * static_cast<double>(random() % 1000) / 1000;
    const int pause = within(plain.arms[0], m, share);
    SCOPED_TRACE(testing::Message() << "m = " << m << ", pause in macrostep " << pause);
    const Recorded paused = ran("press", {pause});
    const auto rows = standing(paused.arms[0], pause);
    expect_rest(rows, 2e-4);
    if (m == 2 || m == 3) {
      EXPECT_NEAR(mean_Fz(rows), 4, 0.1);
      for (const Row& row : rows) EXPECT_NEAR(row[kFz], 4, 0.5) << "macrostep " << row[kI];
    } else {
      for (const Row& row : rows) EXPECT_LT(std::abs(row[kFz]), 0.5) << "macrostep " << row[kI];
    }
    for (const char* const key : {"approach_settled_N", "hold_N"})
      EXPECT_NEAR(figure(paused.summary, key), 4, 0.1) << key;
    EXPECT_NEAR(figure(paused.summary, "approach_peak_N"), figure(plain.summary, "approach_peak_N"), 0.6);
    EXPECT_NEAR(paused.summary.at("sim_s").get<double>() - plain.summary.at("sim_s").get<double>(),
                kLasts * 0.02, 0.1);
  }
}

TEST_F(Paused, TerminalsSeeTheForceOfNow) {
  const int pause = within(ran("press", {}).arms[0], 3, 0.3);
  std::ignore = ran("press", {pause});
  std::set<double> shown;
  int paused = 0;
  const auto told = link::LogReader(folder_ / "press2").messages<task_status_t>("task_status");
  for (const auto& [stamp, status] : told) {
    if (status.state != static_cast<int>(TaskState::paused)) continue;
    ++paused;
    shown.insert(status.F_a[0][2]);
    EXPECT_NEAR(status.F_a[0][2], 4, 0.5);
    EXPECT_EQ(status.agent_m[0], 3) << "what was paused";
  }
  EXPECT_GT(paused, 3);
  EXPECT_GT(static_cast<int>(shown.size()), paused / 2) << "readings have frozen";
}

TEST_F(Paused, PressIsPausedAgainBeforeItHasComeToRestOrToSpeed) {
  const Recorded plain = ran("press", {});
  const int first = within(plain.arms[0], 1, 0.3);
  std::string script = "3 start\n";
  int i = first;
  for (const int gap : {3, 4, 15, 2, 30, 1, 7}) {  // from pause to resume to pause ...
    script += std::to_string(i) + (script.ends_with("pause\n") ? " resume\n" : " pause\n");
    i += gap;
  }
  script += std::to_string(i) + " resume\n";
  const Ended ended = run(folder_, "press",
                          {"--processes", "one", "--script", folder_.write("often", script), "--run-dir",
                           (folder_ / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_NEAR(figure(summary(folder_ / "run"), "hold_N"), 4, 0.1);
  EXPECT_LT(deviation(read_table(folder_ / "run" / "arm1.csv", kArmHeading), plain.arms[0]), 2e-4);
}

TEST_F(Paused, WeighStandsOnItsWayAndFindsTheSameTool) {
  const Recorded plain = ran("weigh", {});
  for (const int m : {1, 4, 6, 7}) {
    const int pause = within(plain.arms[0], m, 0.45);
    SCOPED_TRACE(testing::Message() << "m = " << m << ", pause in macrostep " << pause);
    const Recorded paused = ran("weigh", {pause});
    expect_rest(standing(paused.arms[0], pause), 2e-4);
    EXPECT_LT(deviation(paused.arms[0], plain.arms[0]), 1e-3);
    EXPECT_NEAR(figure(paused.summary, "tool_weight_N"), figure(plain.summary, "tool_weight_N"), 0.05);
  }
}

TEST_F(Paused, EdgeFollowKeepsItsForceStandsOnTheEdgeAndGoesOnAlongIt) {
  const Recorded plain = ran("edge_follow", {}, {}, 2);
  const std::vector<int> pauses{within(plain.arms[0], 2, 0.15), within(plain.arms[0], 2, 0.6) + kLasts};
  const Recorded paused = ran("edge_follow", pauses, {}, 2);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    SCOPED_TRACE(arm);
    for (const int pause : pauses) {
      const auto rows = standing(paused.arms[arm], pause);
      expect_rest(rows, 3e-4);
      double sum = 0;
      for (const Row& row : rows) {
        const double F = std::hypot(row[kFx], row[kFy]);
        EXPECT_NEAR(F, 4, 1) << "macrostep " << row[kI];
        sum += F;
      }
      EXPECT_NEAR(sum / static_cast<double>(rows.size()), 4, 0.25);
    }
    EXPECT_LT(deviation(up_to(paused.arms[arm], 2), plain.arms[arm]), 3e-4)
        << "the way back begins where the round ended, which may be 2 mm elsewhere";
    EXPECT_LE(paused.summary.at("figures").at("edge_follow_rms_N").at(arm).get<double>(), 0.5);
  }
}

TEST_F(Paused, VisualServoStandsWhileItGoesOnSeeingAndComesToTheObject) {
  // With both cameras: the one above the scene loses sight of the object when the arm comes near.
  const std::vector<std::string> short_one{"--object", "apriltag",       "--set", "cameras.profile=fast",
                                           "--set",    "task.duration=4"};
  const Recorded plain = ran("visual_servo", {}, short_one);
  const int pause = static_cast<int>(plain.arms[0].front()[kI]) + 15;
  const Recorded paused = ran("visual_servo", {pause}, short_one);
  const auto rows = standing(paused.arms[0], pause);
  expect_rest(rows, 5e-4);
  EXPECT_GT(distance(rows.front(), plain.arms[0].back()), 0.02) << "it was on its way";
  EXPECT_LT(distance(paused.arms[0].back(), plain.arms[0].back()), 2e-3);
}

TEST_F(Paused, ManualStandsInAMotionAndGoesOnToItsGoal) {
  constexpr std::int64_t kHomed = 90, kPause = 140;
  const std::string script = folder_.write(
      "words",
      "3 home arm1\n100 move arm1 joints 0.3 -1.5 0 1.5 1.57 -1.57 speed 0.3 acceleration 0.2\n700 end\n");
  const std::string orders = folder_.write(
      "orders", std::to_string(kPause) + " pause\n" + std::to_string(kPause + kLasts) + " resume\n");
  const auto manual = [&](const std::string& name, const std::vector<std::string>& more) {
    const Ended ended =
        run(folder_, "manual",
            words({{"--processes", "one", "--words", script, "--run-dir", (folder_ / name).string(), "--set",
                    "robots.arm1.synchro=known_pose", "--set", "robots.arm2.synchro=known_pose"},
                   more}));
    EXPECT_EQ(ended.status, 0) << ended.all();
    return link::LogReader(folder_ / name).messages<effector_reply_t>("arm1.reply");
  };
  const auto plain = manual("plain", {}), paused = manual("paused", {"--script", orders});
  const double before = plain.at(kHomed).joints[0];
  const double goal = plain.rbegin()->second.joints[0];
  ASSERT_NEAR(goal, 0.3, 1e-3);
  EXPECT_NEAR(paused.rbegin()->second.joints[0], goal, 1e-4);
  const double stands = paused.at(kPause + kComesToRest).joints[0];
  EXPECT_GT(std::abs(stands - before), 0.02) << "it was on its way";
  EXPECT_GT(std::abs(stands - goal), 0.02);
  double last = before;
  for (const auto& [i, reply] : paused) {
    if (i < kHomed) continue;
    EXPECT_GT((reply.joints[0] - last) * (goal > before ? 1 : -1), -2e-4) << "it went back in " << i;
    last = reply.joints[0];
    if (i < kPause + kComesToRest || i > kPause + kLasts) continue;
    EXPECT_NEAR(reply.joints[0], stands, 2e-4) << i;
  }
}

}  // namespace
}  // namespace mrroc::test
