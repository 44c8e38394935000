#include "ui_cli/view/platform_track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/effector_command.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert_platform.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "test/ui_cli/view/sample_run.hpp"
#include "ui_cli/view/listener.hpp"
#include "ui_cli/view/samples.hpp"
#include "ui_cli/view/scene.hpp"

namespace mrroc::view {
namespace {

using nlohmann::json;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::size_t column(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kPlatformColumns, name) - kPlatformColumns.begin());
}

PlatformReply reply_of(std::int64_t macrostep) {
  PlatformReply r;
  r.step = 10 * macrostep + 9;
  r.position_known = true;
  r.estimate.step = 10 * macrostep;
  r.estimate.p = {0.5, -1, 0.25};
  r.estimate.v = {0.75, 0, -0.5};
  r.estimate.theta = {1, 2, 3, 4};
  r.estimate.covariance = {4, 1, 0, 1, 9, 0, 0, 0, 1};
  r.slip = {0.5, 0.25, -0.125};
  r.slip_sd = {0.0625, 0.03125, 0.5};
  r.torque = {5, 6, 7, 8};
  r.executing = 2;
  r.iteration = 11;
  r.remaining = 150;
  return r;
}

/// A session in which one platform is heard.
class ViewPlatform : public testing::Test {
 protected:
  ViewPlatform() { record.begin("{}"); }

  template <class M>
  void hear(const std::string& channel, const M& m, std::int64_t stamp = 0) {
    listener.receive("s." + channel, test::encoded(m, ++numbers[channel], stamp));
  }
  std::vector<float> rows(const std::string& track) {
    Record::Cursor page;
    return test::rows_of(record.news(page), track);
  }

  Record record;
  Listener listener{record, {}, "s", 7};
  std::map<std::string, std::int64_t> numbers;
};

TEST_F(ViewPlatform, TellsWhatItsDriverReplies) {
  hear("rex.report", test::report(3));
  hear("rex.reply", to_message(reply_of(50)));
  const std::vector<float> row = rows("platform:rex");
  ASSERT_EQ(row.size(), kPlatformColumns.size());
  EXPECT_FLOAT_EQ(row[column("t")], 1.0F) << "of the estimate, not of the reply";
  EXPECT_FLOAT_EQ(row[column("sent")], 1.018F);
  EXPECT_EQ(row[column("m")], 3);
  const auto from = [&](std::string_view name, std::size_t count) {
    const auto first = row.begin() + static_cast<std::ptrdiff_t>(column(name));
    return std::vector<float>(first, first + static_cast<std::ptrdiff_t>(count));
  };
  EXPECT_EQ(from("x", 6), (std::vector<float>{0.5, -1, 0.25, 0.75, 0, -0.5}));
  EXPECT_EQ(from("th0", 4), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(from("xx", 3), (std::vector<float>{4, 1, 9}));
  EXPECT_EQ(from("mu_x", 6), (std::vector<float>{0.5, 0.25, -0.125, 0.0625, 0.03125, 0.5}));
  EXPECT_EQ(from("tau0", 4), (std::vector<float>{5, 6, 7, 8}));
  EXPECT_EQ(from("fragment", 3), (std::vector<float>{2, 11, 150}));
}

// The time-line shows the behaviours of all agents.
TEST_F(ViewPlatform, TellsBehavioursOfAgentsWithoutAnEffectorAndOfTheCoordinator) {
  Scene scene;
  scene.platforms = {{"rex", "rex"}};
  Listener heard(record, scene, "s", 7);
  std::map<std::string, std::int64_t> sent;
  const auto hear_of = [&](const std::string& channel, const auto& m) {
    heard.receive("s." + channel, test::encoded(m, ++sent[channel], 0));
  };
  hear_of("map.report", test::report(1));  // nobody knows what time it is
  hear_of("rex.reply", to_message(reply_of(50)));
  agent_order_t order{};
  order.m = 2;
  hear_of("rex.order", order);
  hear_of("map.order", order);
  hear_of("rex.report", test::report(3));
  hear_of("map.report", test::report(1));
  process_status_t status{};
  status.m = 1;
  link::put_text(status.behaviour, "locate");
  hear_of("ecp-map.status", status);
  const float t = 509 * 0.002F;
  EXPECT_EQ(rows("agent:map"), (std::vector<float>{t, 1}));
  EXPECT_EQ(rows("agent:mp"), (std::vector<float>{t, 2})) << "once, not per agent";
  EXPECT_EQ(record.rows("agent:rex"), 0U) << "its row is that of the platform";
  Record::Cursor page;
  EXPECT_EQ(json::parse(record.news(page)).at("values").at("behaviours").at("map").at("1"), "locate");
}

TEST_F(ViewPlatform, DrawsNothingBeforeThePositionIsKnown) {
  PlatformReply r = reply_of(1);
  r.position_known = false;
  hear("rex.reply", to_message(r));
  EXPECT_EQ(record.rows("platform:rex"), 0U);
}

TEST_F(ViewPlatform, TellsOnceWhatADriverRefuses) {
  PlatformReply r = reply_of(1);
  r.fault.code = FaultCode::bad_fragment;
  for (int k = 0; k < 3; ++k) hear("rex.reply", to_message(r));
  Record::Cursor page;
  const json lines = json::parse(record.news(page)).at("lines");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.at(0).at("process"), "edp-rex");
}

TEST_F(ViewPlatform, TellsReferenceAndHorizonOfTheSameReading) {
  PlatformTelemetry t;
  t.step = 509;
  for (std::size_t k = 0; k < kHorizonPoints; ++k) {
    t.reference[k] = {static_cast<double>(k), 1, 2};
    t.horizon[k] = {static_cast<double>(k), 3, 4};
  }
  hear("rex.telemetry", to_message(t));
  hear("rex.reply", to_message(reply_of(50)));
  const std::vector<float> row = rows("telemetry:rex");
  ASSERT_EQ(row.size(), kTelemetryColumns);
  EXPECT_EQ(row[0], rows("platform:rex")[column("sent")]) << "a page finds it by that";
  for (std::size_t k = 0; k < kHorizonPoints; ++k) {
    const auto number = static_cast<float>(k);
    EXPECT_EQ((std::vector<float>{row[1 + 3 * k], row[2 + 3 * k], row[3 + 3 * k]}),
              (std::vector<float>{number, 1, 2}));
    EXPECT_EQ((std::vector<float>{row[64 + 3 * k], row[65 + 3 * k], row[66 + 3 * k]}),
              (std::vector<float>{number, 3, 4}));
  }
}

TEST_F(ViewPlatform, TellsTheTruthAndTheGroundBelowAllWheels) {
  PlatformTruth t;
  t.p = {1, 2, 3};
  t.friction = {{{0.6, 0.5}, {0.2, 0.1}, {0.6, 0.5}, {0.2, 0.1}}};
  hear("rex.truth", to_message(t), 50);
  const std::vector<float> row = rows("truth:rex");
  ASSERT_EQ(row.size(), kTruthColumns);
  const std::vector<float> wanted{1, 1, 2, 3, 0.4F, 0.3F, 0.5F};
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_FLOAT_EQ(row[k], wanted[k]) << k;
}

TEST_F(ViewPlatform, TellsWhereABoxIs) {
  box_truth_t box{};
  box.p[0] = 1;
  box.p[1] = -2;
  box.p[2] = 0.5;
  hear("crate.truth", box, 50);
  box.p[1] = kNaN;
  hear("crate.truth", box, 51);
  EXPECT_EQ(rows("box:crate"), (std::vector<float>{1, 1, -2, 0.5}));
  EXPECT_EQ(record.rows("truth:crate"), 0U);
}

TEST_F(ViewPlatform, TellsThePointsOfAPlanWhenItComes) {
  Plan plan;
  hear("mp.rex.plan", to_message(plan));
  plan = {.number = 1, .n = 2, .point = {{{1, 2}, {3, 4}, {9, 9}}}, .speed = 0.5, .ahead = 1};
  for (int k = 0; k < 3; ++k) hear("mp.rex.plan", to_message(plan));
  plan.number = 2;
  plan.n = 1;
  hear("rex.reply", to_message(reply_of(50)));
  hear("mp.rex.plan", to_message(plan));
  const std::vector<float> row = rows("plan:rex");
  ASSERT_EQ(row.size(), 3 * kPlanColumns);
  EXPECT_EQ((std::vector<float>{row.begin(), row.begin() + 8}), (std::vector<float>{0, 1, 1, 2, 0, 1, 3, 4}));
  EXPECT_FLOAT_EQ(row[8], 1.018F);
  EXPECT_EQ(row[9], 2);
}

PlatformCommand handing_over(std::int64_t number) {
  PlatformCommand c;
  c.instruction = Instruction::set;
  c.fragment.number = number;
  c.fragment.steps = 80;
  c.fragment.notify = -4;
  for (std::size_t k = 0; k < kFragmentKnots; ++k)
    c.fragment.knot[k] = {.p = {static_cast<double>(k), 0.5, -0.25}, .v = 9, .w = 9};
  return c;
}

TEST_F(ViewPlatform, TellsAFragmentWhenItIsHandedOver) {
  hear("rex.command", to_message(handing_over(1)), 50);
  hear("rex.command", to_message(handing_over(1)), 51);  // it was lost, and comes again
  PlatformCommand keep = handing_over(2);
  keep.instruction = Instruction::keep;
  hear("rex.command", to_message(keep), 52);
  hear("rex.command", to_message(handing_over(2)), 100);
  const std::vector<float> row = rows("fragment:rex");
  ASSERT_EQ(row.size(), 2 * kFragmentColumns);
  EXPECT_EQ((std::vector<float>{row.begin(), row.begin() + 10}),
            (std::vector<float>{1, 1, 80, -4, 0, 0.5, -0.25, 1, 0.5, -0.25}));
  EXPECT_EQ((std::vector<float>{row.begin() + 100, row.begin() + 105}),
            (std::vector<float>{32, 0.5, -0.25, 2, 2}));
}

TEST_F(ViewPlatform, LeavesOutWhatNobodyCanUse) {
  PlatformCommand command = handing_over(1);
  command.fragment.knot[32].p.y = kNaN;
  hear("rex.command", to_message(command));
  command.fragment.knot[32].p.y = std::numeric_limits<double>::infinity();
  hear("rex.command", to_message(command));
  PlatformReply r = reply_of(1);
  r.estimate.p.x = kNaN;
  hear("rex.reply", to_message(r));
  PlatformTelemetry t;
  t.horizon[20].phi = kNaN;
  hear("rex.telemetry", to_message(t));
  PlatformTruth truth;
  truth.friction[3][1] = kNaN;
  hear("rex.truth", to_message(truth));
  Plan plan{.number = 1, .n = 1, .point = {}, .speed = 0.5, .ahead = 0};
  plan_t longer = to_message(plan);
  longer.n = 1'000'000;
  hear("mp.rex.plan", longer);
  for (const char* track : {"platform:rex", "telemetry:rex", "truth:rex", "plan:rex", "fragment:rex"})
    EXPECT_EQ(record.rows(track), 0U) << track;
}

// Whatever bits come from the network: rows hold numbers that a page can compute with.
TEST_F(ViewPlatform, GivesFiniteRowsOfAnyBytes) {
  std::mt19937_64 random(21);
  const auto scrambled = [&](auto m) {
    std::vector<std::uint8_t> bytes = test::encoded(m, ++numbers["any"], 1);
    constexpr std::size_t kHeader = 32;
    for (int k = 0; k < 4; ++k)
      bytes[kHeader + random() % (bytes.size() - kHeader)] = static_cast<std::uint8_t>(random() % 256);
    return bytes;
  };
  for (int round = 0; round < 2000; ++round) {
    listener.receive("s.rex.reply", scrambled(to_message(reply_of(round))));
    listener.receive("s.rex.telemetry", scrambled(to_message(PlatformTelemetry{})));
    listener.receive("s.rex.truth", scrambled(to_message(PlatformTruth{})));
    listener.receive("s.rex.command", scrambled(to_message(handing_over(round + 1))));
  }
  for (const char* track : {"platform:rex", "telemetry:rex", "truth:rex", "fragment:rex"}) {
    EXPECT_GT(record.rows(track), 500U) << track;
    const std::vector<float> all = rows(track);
    EXPECT_TRUE(std::ranges::all_of(all, [](float x) { return std::isfinite(x); })) << track;
  }
}

TEST(ViewPlatformScene, DescribesTheRoomOfPlatforms) {
  const Scene scene = read_scene(Config::parse(R"(
[platforms]
order = ["rex"]
[room]
walls = [-4, -3, 5, 2]
furniture = false
[room.obstacles.crate]
polygon = [1, 1, 2, 1, 1, 2]
[sim.boxes.carton]
size = [0.8, 0.6]
[sim.ground.patches.ice]
area = [0, -1, 2, 1]
scale = 0.5
from = 15
)",
                                               "sample"));
  const json j = json::parse(scene_json(scene, {.source = "run"}));
  EXPECT_EQ(j.at("platforms"), (json::array({{{"name", "rex"}, {"model", "rex"}}})));
  EXPECT_EQ(j.at("platform_columns").size(), kPlatformColumns.size());
  EXPECT_EQ(j.at("room").at("lower"), (json{-4.0, -3.0}));
  EXPECT_EQ(j.at("room").at("upper"), (json{5.0, 2.0}));
  EXPECT_EQ(j.at("room").at("obstacles").at(0).size(), 3U);
  EXPECT_EQ(j.at("room").at("boxes"), (json::array({{{"name", "carton"}, {"size", {0.8, 0.6}}}})));
  EXPECT_EQ(j.at("room").at("ground"),
            (json::array({{{"lower", {0.0, -1.0}}, {"upper", {2.0, 1.0}}, {"scale", 0.5}, {"from", 15.0}}})));
}

TEST(ViewPlatformScene, HasNoRoomWithoutAPlatform) {
  const Scene scene = read_scene(Config::parse(test::sample_config(), "sample"));
  EXPECT_FALSE(json::parse(scene_json(scene, {})).contains("room"));
}

}  // namespace
}  // namespace mrroc::view
