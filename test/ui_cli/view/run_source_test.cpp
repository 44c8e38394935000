#include "ui_cli/view/run_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "base/effector_command.hpp"
#include "base/fault.hpp"
#include "base/link/event_log.hpp"
#include "base/link/log_reader.hpp"
#include "mrroc/manual_words_t.hpp"
#include "test/ui_cli/view/sample_run.hpp"
#include "ui_cli/view/listener.hpp"
#include "ui_cli/view/samples.hpp"

namespace mrroc::view {
namespace {

using nlohmann::json;
constexpr std::size_t kWidth = kArmColumns.size();

std::size_t column(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kArmColumns, name) - kArmColumns.begin());
}

TEST(ViewRun, ShowsEveryReadingOfARunFolder) {
  const test::ScratchFolder folder("mrroc-view-run");
  test::write_run(folder.path(), 100);
  Record record;
  EXPECT_EQ(load_run(folder.path(), record), (std::vector<std::string>{"sac_board.png", "plots/force.png"}));
  Record::Cursor page;
  const std::string news = record.news(page);
  const auto rows = test::rows_of(news, "arm1");
  ASSERT_EQ(rows.size(), 100 * kWidth);
  for (std::size_t i = 1; i <= 100; ++i) {
    const float* row = rows.data() + (i - 1) * kWidth;
    ASSERT_FLOAT_EQ(row[column("t")], 0.02F * static_cast<float>(i));
    ASSERT_EQ(row[column("m")], i <= 50 ? 1 : 2);
    ASSERT_FLOAT_EQ(row[column("q3")], 0.3F + 0.001F * static_cast<float>(i));
    ASSERT_FLOAT_EQ(row[column("Fz")], static_cast<float>(i));
    ASSERT_EQ(row[column("ink")], i == 25 ? -1 : i <= 50 ? 0 : 1) << "macrostep " << i;
  }
  const json values = json::parse(news).at("values");
  EXPECT_EQ(values.at("behaviours"),
            (json{{"", {{"1", "approach"}, {"2", "draw"}}},
                  {"arm1", {{"1", "arm1 does: approach"}, {"2", "arm1 does: draw"}}}}));
  EXPECT_EQ(values.at("summary").at("outcome"), "done");
  EXPECT_EQ(values.at("count").at("lost"), 0);
  EXPECT_EQ(json::parse(news).at("lines").at(0).at("text"), "operator: start");
}

TEST(ViewRun, ShowsAReadingThatCameLateInItsPlace) {
  const test::ScratchFolder folder("mrroc-view-late");
  test::write_run(folder.path(), 1);
  {
    link::EventLog log(folder.path() / link::kEventLog, 7);
    for (const std::int64_t i : {1, 2, 4, 5, 3})
      log.receive("s.arm1.reply", test::encoded(test::reply(i, 0.9, 0, 1), i, i));
  }
  Record record;
  load_run(folder.path(), record);
  Record::Cursor page;
  const std::string news = record.news(page);
  const auto rows = test::rows_of(news, "arm1");
  ASSERT_EQ(rows.size(), 5 * kWidth);
  for (std::size_t i = 1; i <= 5; ++i)
    EXPECT_FLOAT_EQ(rows[(i - 1) * kWidth + column("t")], 0.02F * static_cast<float>(i));
  EXPECT_EQ(json::parse(news).at("values").at("count").at("lost"), 0);
}

TEST(ViewRun, TellsTheFaultThatEndedARun) {
  const test::ScratchFolder folder("mrroc-view-fault");
  std::ofstream(folder.path() / "summary.json")
      << R"({"outcome": "fault", "sim_s": 3.5, "fault": {"code": "process_died", "process": "ecp-arm1", "text": "gone"}})";
  Record record;
  record.begin("{}");
  load_summary(folder.path(), record);
  Record::Cursor page;
  const json line = json::parse(record.news(page)).at("lines").at(0);
  EXPECT_EQ(line.at("code"), "process_died");
  EXPECT_EQ(line.at("process"), "ecp-arm1");
  EXPECT_EQ(line.at("t"), 3.5);
  EXPECT_NE(std::string(line.at("text")).find("gone"), std::string::npos);
}

TEST(ViewRun, ReadsASummaryWhosePartsAreDamaged) {
  const test::ScratchFolder folder("mrroc-view-damaged");
  std::ofstream(folder.path() / "summary.json")
      << R"({"outcome": "fault", "sim_s": "late", "fault": {"code": 12, "process": null, "text": "gone"}})";
  Record record;
  record.begin("{}");
  load_summary(folder.path(), record);
  Record::Cursor page;
  const json line = json::parse(record.news(page)).at("lines").at(0);
  EXPECT_EQ(line.at("code"), "");
  EXPECT_EQ(line.at("t"), 0);
  EXPECT_NE(std::string(line.at("text")).find("gone"), std::string::npos);
}

// The JSON library writes by recursion.
TEST(ViewRun, LeavesOutWhatASummaryNestsTooDeep) {
  const test::ScratchFolder folder("mrroc-view-deep");
  constexpr std::size_t kDeep = 1'000'000;
  std::ofstream(folder.path() / "summary.json")
      << R"({"outcome": "done", "x": )" << std::string(kDeep, '[') << std::string(kDeep, ']') << "}";
  Record record;
  record.begin("{}");
  load_summary(folder.path(), record);
  Record::Cursor page;
  const json summary = json::parse(record.news(page)).at("values").at("summary");
  EXPECT_EQ(summary.at("outcome"), "done");
  EXPECT_LT(summary.dump().size(), 200U);
}

TEST(ViewRun, SaysWhereAFolderIsNoRun) {
  const test::ScratchFolder folder("mrroc-view-none");
  Record record;
  try {
    load_run(folder.path() / "missing", record);
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_log);
    EXPECT_NE(std::string(e.what()).find("there is no folder"), std::string::npos) << e.what();
  }
  std::ofstream(folder.path() / "config.toml") << test::sample_config();
  try {
    load_run(folder.path(), record);
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_log);
  }
}

TEST(ViewRun, DescribesTheCell) {
  const Scene scene = read_scene(Config::parse(test::sample_config(), "sample"));
  const json j = json::parse(scene_json(scene, {.source = "run", .task = "sample"}));
  EXPECT_EQ(j.at("arms").at(0).at("model"), "irb6_postument");
  EXPECT_EQ(j.at("arms").at(0).at("place"), (json{0.0, 2.1, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(j.at("arms").at(1).at("gripper"), "two_jaw");
  EXPECT_EQ(j.at("arms").at(0).at("paper").at("place").at(0), 0.9);
  EXPECT_EQ(j.at("cube").at("held_by"), "arm2");
  EXPECT_EQ(j.at("cameras").at(0).at("width"), 320);
  EXPECT_DOUBLE_EQ(j.at("object").at("size").at(0), 0.24);
  EXPECT_EQ(j.at("columns").size(), kWidth);
}

TEST(ViewRun, KnowsWhenAPenLeavesInk) {
  const Scene scene = read_scene(Config::parse(test::sample_config(), "sample"));
  const ArmScene& arm = scene.arms.at(0);
  EXPECT_TRUE(on_paper(arm, {0.9, 0, 0.92 - 1e-4}));
  EXPECT_TRUE(on_paper(arm, {0.9, 0, 0.92}));
  EXPECT_FALSE(on_paper(arm, {0.9, 0, 0.92 + 5e-5})) << "lifted";
  EXPECT_FALSE(on_paper(arm, {0.9, 0.16, 0.92})) << "beside the sheet";
  EXPECT_FALSE(on_paper(arm, {0.74, 0, 0.92})) << "before the sheet";
  EXPECT_FALSE(on_paper(arm, {0.9, 0, 0})) << "a driver that does not know where it is";
}

TEST(ViewRun, SheetsLieOnTheBeltOfAConveyorAndGoWithIt) {
  const Scene scene = read_scene(Config::parse(
      "[robots]\norder = ['arm1', 'conveyor']\n[robots.conveyor]\nmodel = 'conveyor'\n", "belt"));
  const json j = json::parse(scene_json(scene, {.source = "run"}));
  EXPECT_EQ(j.at("arms").at(0).at("belt"), false);
  EXPECT_EQ(j.at("arms").at(1).at("belt"), true);
  const ArmScene& arm = scene.arms.at(0);
  EXPECT_FALSE(on_paper(arm, {0.9, 0.2, 0.92})) << "the belt has not moved";
  EXPECT_TRUE(on_paper(arm, {0.9, 0.2, 0.92}, 0.1));
  EXPECT_FALSE(on_paper(arm, {0.9, -0.1, 0.92}, 0.1)) << "the sheet has gone from there";
}

TEST(ViewListener, CountsWhatIsLostAndIgnoresWhatComesAgainOrFromOthers) {
  Record record;
  record.begin("{}");
  Listener listener(record, read_scene(Config::parse(test::sample_config(), "sample")), "s", 7);
  const auto hear = [&](std::int64_t number, std::int64_t session = 7) {
    listener.receive("s.arm1.reply", test::encoded(test::reply(number, 0.9, 0, 1), number, number, session));
  };
  hear(5);  // it came late: what was before is not lost
  hear(6);
  hear(6);
  hear(9);
  hear(10, 8);
  EXPECT_EQ(record.rows("arm1"), 3U);
  EXPECT_EQ(listener.lost(), 2);
  EXPECT_EQ(listener.messages(), 3);
}

TEST(ViewListener, CountsNumbersThatNoSenderWouldGive) {
  Record record;
  record.begin("{}");
  Listener listener(record, {}, "s", 7);
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  const auto hear = [&](const std::string& channel, std::int64_t number) {
    listener.receive(channel, test::encoded(test::reply(1, 0.9, 0, 1), number, 1, 7));
  };
  for (const std::int64_t number :
       {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min()})
    hear("s.arm1.reply", number);
  EXPECT_EQ(listener.messages(), 0) << "senders count from 1";
  for (const char* channel : {"s.arm1.reply", "s.arm2.reply"}) {
    hear(channel, 1);
    hear(channel, kMost);
  }
  EXPECT_EQ(listener.messages(), 4);
  EXPECT_EQ(listener.lost(), kMost) << "and no more";
}

TEST(ViewListener, LosesNothingWhereEveryTerminalNumbersItsOwnMessages) {
  Record record;
  record.begin("{}");
  Listener listener(record, {}, "s", 7);
  std::mt19937_64 random(1);
  for (const char* channel : {"s.manual.words", "s.operator"})
    for (int k = 0; k < 5; ++k) {
      const auto number = static_cast<std::int64_t>(random() >> 1);
      listener.receive(channel, test::encoded(manual_words_t{}, number, 0));
    }
  EXPECT_EQ(listener.lost(), 0);
  EXPECT_EQ(listener.messages(), 10);
}

TEST(ViewListener, TellsWhatTheRecordHadNoRoomFor) {
  Record record;
  record.begin("{}");
  Listener listener(record, {}, "s", 7);
  const auto more = static_cast<std::int64_t>(Record::kMostLines) + 3;
  for (std::int64_t k = 1; k <= more; ++k)
    listener.receive("s.mp.console", test::encoded(test::line("again"), k, k));
  listener.publish_count();
  Record::Cursor page;
  EXPECT_EQ(json::parse(record.news(page)).at("values").at("count"),
            (json{{"messages", more}, {"lost", 0}, {"refused", 3}}));
}

TEST(ViewListener, BearsAnyBytes) {
  std::mt19937 random(5);
  Record record;
  record.begin("{}");
  Listener listener(record, {}, "s", 0);
  for (const char* channel : {"s.arm1.reply", "s.task_status", "s.mp.console", "s.sac.frame",
                              "s.object.truth", "s.hand.order", "s.arm1.report", "nothing", ""})
    for (int k = 0; k < 200; ++k) {
      std::vector<std::uint8_t> bytes(random() % 3000);
      for (auto& b : bytes) b = static_cast<std::uint8_t>(random());
      listener.receive(channel, bytes);
    }
  EXPECT_EQ(record.rows("arm1"), 0U);
}

TEST(ViewListener, TellsANewSheetARefusalAndTheObject) {
  Record record;
  record.begin("{}");
  Listener listener(record, read_scene(Config::parse(test::sample_config(), "sample")), "s", 7);
  hand_order_t hands{};
  hands.new_sheet[0] = 1;
  listener.receive("s.hand.order", test::encoded(hands, 1, 1));
  effector_reply_t refused = test::reply(1, 0.9, 0, 0.92);
  refused.fault.code = static_cast<std::int32_t>(FaultCode::force_limit);
  listener.receive("s.arm1.reply", test::encoded(refused, 1, 1));
  listener.receive("s.arm1.reply", test::encoded(refused, 2, 2));
  object_truth_t truth{};
  truth.step = 500;
  truth.present = 1;
  truth.T_0G[3] = 0.9;
  listener.receive("s.object.truth", test::encoded(truth, 1, 1));
  Record::Cursor page;
  const std::string news = record.news(page);
  const auto arm = test::rows_of(news, "arm1");
  EXPECT_EQ(arm.at(column("ink")), -1);
  EXPECT_EQ(arm.at(kWidth + column("ink")), 1);
  const auto object = test::rows_of(news, "object");
  EXPECT_FLOAT_EQ(object.at(0), 1);
  EXPECT_FLOAT_EQ(object.at(6), 0.9F);
  const json lines = json::parse(news).at("lines");
  ASSERT_EQ(lines.size(), 1U) << "a refusal that stands is told once";
  EXPECT_EQ(lines.at(0).at("code"), "force_limit");
  EXPECT_EQ(lines.at(0).at("fault"), 1);
}

TEST(ViewListener, LeavesOutWhatADriverDoesNotKnow) {
  Record record;
  record.begin("{}");
  Listener listener(record, {}, "s", 7);
  effector_reply_t m = test::reply(1, 0, 0, 0);
  m.position_known = 0;
  listener.receive("s.arm1.reply", test::encoded(m, 1, 1));
  EXPECT_EQ(record.rows("arm1"), 0U);
  EXPECT_EQ(listener.lost(), 0);
}

}  // namespace
}  // namespace mrroc::view
