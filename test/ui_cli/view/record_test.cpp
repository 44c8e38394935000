#include "ui_cli/view/record.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "test/ui_cli/view/sample_run.hpp"

namespace mrroc::view {
namespace {

using nlohmann::json;

TEST(ViewRecord, SaysNothingTwice) {
  Record record;
  record.begin(R"({"source":"run"})");
  record.add("arm1", std::array{0.0F, 1.0F});
  record.log(R"({"text":"a"})");
  record.set("state", R"("live")");
  Record::Cursor page;
  const json first = json::parse(record.news(page));
  EXPECT_EQ(first.at("scene").at("source"), "run");
  EXPECT_EQ(first.at("lines").size(), 1U);
  EXPECT_EQ(first.at("values").at("state"), "live");
  EXPECT_EQ(record.news(page), "");
  record.set("state", R"("live")");
  EXPECT_EQ(record.news(page), "") << "the value is the same";
  record.set("state", R"("ended")");
  const json second = json::parse(record.news(page));
  EXPECT_FALSE(second.contains("scene"));
  EXPECT_FALSE(second.contains("lines"));
  EXPECT_EQ(second.at("values"), (json{{"state", "ended"}}));
}

TEST(ViewRecord, GivesEveryRowOnceHoweverSeldomAPageReads) {
  std::mt19937 random(3);
  Record record;
  record.begin("{}");
  Record::Cursor page;
  std::vector<float> got;
  float next = 0;
  for (int round = 0; round < 60; ++round) {
    for (auto k = random() % 300; k > 0; --k, ++next) record.add("arm1", std::array{next, -next});
    if (random() % 3 != 0) continue;
    for (std::string news = record.news(page); !news.empty(); news = record.news(page)) {
      if (!json::parse(news).contains("tracks")) continue;
      const auto rows = test::rows_of(news, "arm1");
      EXPECT_LE(rows.size() / 2, Record::kMostRows);
      got.insert(got.end(), rows.begin(), rows.end());
    }
  }
  for (std::string news = record.news(page); !news.empty(); news = record.news(page)) {
    const auto rows = test::rows_of(news, "arm1");
    got.insert(got.end(), rows.begin(), rows.end());
  }
  ASSERT_EQ(got.size(), 2 * record.rows("arm1"));
  for (std::size_t k = 0; k < got.size() / 2; ++k) {
    ASSERT_EQ(got[2 * k], static_cast<float>(k));
    ASSERT_EQ(got[2 * k + 1], -static_cast<float>(k));
  }
}

TEST(ViewRecord, BeginsAnewForPagesThatWereInTheMiddle) {
  Record record;
  record.begin(R"({"task":"a"})");
  record.add("arm1", std::array{1.0F});
  Record::Cursor page;
  std::ignore = record.news(page);
  record.begin(R"({"task":"b"})");
  record.add("arm1", std::array{2.0F});
  const std::string news = record.news(page);
  EXPECT_EQ(json::parse(news).at("scene").at("task"), "b");
  EXPECT_EQ(test::rows_of(news, "arm1"), std::vector{2.0F});
}

TEST(ViewRecord, CountsRowsAndLinesThatItHasNoRoomFor) {
  Record record;
  record.begin("{}");
  for (std::size_t k = 0; k < Record::kMostLines + 2; ++k) record.log("{}");
  EXPECT_EQ(record.refused(), 2U);
  for (std::size_t k = 0; k < Record::kMostKept + 3; ++k) record.add("arm1", std::array{0.0F});
  EXPECT_EQ(record.refused(), 5U);
  EXPECT_EQ(record.rows("arm1"), Record::kMostKept);
  record.begin("{}");
  EXPECT_EQ(record.refused(), 0U);
}

// A log may hold an arm that is named as another track.
TEST(ViewRecord, LeavesOutRowsThatDoNotFitTheirTrack) {
  Record record;
  record.add("cube", std::array{1.0F, 2.0F, 3.0F});
  Record::Cursor page;
  (void)record.news(page);
  record.add("cube", std::array{1.0F, 2.0F});
  record.add("cube", std::array{1.0F, 2.0F, 3.0F, 4.0F});
  record.add("cube", {});
  record.add("nothing", {});
  record.add("a\"b", std::array{1.0F});
  EXPECT_EQ(record.refused(), 5U);
  EXPECT_EQ(record.rows("cube"), 1U);
  record.add("cube", std::array{4.0F, 5.0F, 6.0F});
  EXPECT_EQ(test::rows_of(record.news(page), "cube"), (std::vector<float>{4, 5, 6}));
}

TEST(ViewRecord, HasRoomForSoManyTracksAndValues) {
  Record record;
  for (int k = 0; k < 1000; ++k) {
    record.add("track" + std::to_string(k), std::array{1.0F});
    record.set("value" + std::to_string(k), "1");
  }
  EXPECT_EQ(record.refused(), 2000U - Record::kMostTracks - Record::kMostValues);
  record.add("track0", std::array{2.0F});
  record.set("value0", "2");
  EXPECT_EQ(record.rows("track0"), 2U);
  Record::Cursor page;
  EXPECT_EQ(json::parse(record.news(page)).at("values").at("value0"), 2);
}

TEST(ViewRecord, IsReadByManyWhileOneWrites) {
  Record record;
  record.begin("{}");
  constexpr int kRows = 5000;
  std::atomic<bool> done{false};
  const auto read = [&] {
    Record::Cursor page;
    std::size_t rows = 0;
    while (true) {
      const bool last = done;
      const std::string news = record.news(page);
      if (!news.empty() && json::parse(news).contains("tracks")) rows += test::rows_of(news, "arm1").size();
      if (last && news.empty()) break;
    }
    EXPECT_EQ(rows, kRows);
  };
  std::thread one(read);
  std::thread other(read);
  for (int k = 0; k < kRows; ++k) record.add("arm1", std::array{static_cast<float>(k)});
  done = true;
  one.join();
  other.join();
}

TEST(ViewRecord, WritesBase64AsTheStandardDoes) {
  const auto of = [](std::string_view text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace mrroc::view
