#include "ui_cli/view/session_source.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/link/memory_bus.hpp"
#include "test/ui_cli/view/sample_run.hpp"

namespace mrroc::view {
namespace {

using nlohmann::json;

/// A page that keeps what it has read.
struct Page {
  explicit Page(const Record& r) : record(r) {}
  void read() {
    for (std::string news = record.news(cursor); !news.empty(); news = record.news(cursor)) {
      const json j = json::parse(news);
      if (j.contains("scene")) {
        scene = j.at("scene");
        values = json::object();
      }
      if (j.contains("values")) values.update(j.at("values"));
    }
  }
  template <class Done>
  bool wait(Done done) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    for (read(); !done(); read()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }
  [[nodiscard]] std::string state() const {
    return values.contains("state") ? std::string(values.at("state").at("name")) : "";
  }

  const Record& record;
  Record::Cursor cursor;
  json scene;
  json values = json::object();
};

TEST(ViewSession, WaitsFollowsAndWaitsForTheNext) {
  const test::ScratchFolder folder("mrroc-view-session");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
  const auto sessions = folder.path() / "sessions";
  const auto run = folder.path() / "run";
  test::write_run(run, 1);
  link::MemoryHub hub;
  Record record;
  CameraWindow cameras;
  SessionSource source(
      {.selector = {}, .sessions = sessions, .open = [&](const auto&) { return hub.open(); }}, record,
      cameras);
  Page page(record);
  ASSERT_TRUE(page.wait([&] { return page.state() == "waiting"; }));
  EXPECT_EQ(page.scene.at("source"), "none");
  EXPECT_TRUE(page.wait([&] {
    return std::string(page.values.at("state").at("text")).find("no task runs") != std::string::npos;
  })) << page.values;

  for (const std::int64_t id : {7, 8, 8}) {  // at last a replay: number, name and numbers of the one before
    auto file = std::make_unique<link::SessionFile>(link::SessionInfo{.name = "s",
                                                                      .id = id,
                                                                      .address = link::address_for("s"),
                                                                      .task = "sample",
                                                                      .run_folder = run,
                                                                      .pid = 0},
                                                    sessions);
    ASSERT_TRUE(page.wait([&] { return page.state() == "live"; })) << id;
    EXPECT_EQ(page.scene.at("session"), "s");
    EXPECT_EQ(page.scene.at("arms").size(), 2U);
    EXPECT_EQ(source.folder(), run);
    EXPECT_TRUE(source.following());
    const auto bus = hub.open();
    const auto publish = [&](const std::string& name, const std::vector<std::uint8_t>& bytes) {
      bus->publish({link::Group::agents, "s." + name}, bytes);
    };
    // The source listens from some instant on; from then on it misses nothing.
    std::int64_t number = 0;
    const auto next_reply = [&] {
      ++number;
      publish("arm1.reply", test::encoded(test::reply(number, 0.9, 0, 1), number, number, id));
    };
    ASSERT_TRUE(page.wait([&] {
      next_reply();
      return record.rows("arm1") > 0;
    }));
    const std::int64_t before = number - static_cast<std::int64_t>(record.rows("arm1"));
    for (int k = 0; k < 500; ++k) next_reply();
    publish("task_status", test::encoded(test::status(3, "hold"), 1, 0, id));
    EXPECT_TRUE(page.wait([&] { return page.values.contains("status"); }));
    EXPECT_GE(static_cast<std::int64_t>(record.rows("arm1")), number - before - 2);
    EXPECT_EQ(page.values.at("status").at("behaviour"), "hold");
    file.reset();
    ASSERT_TRUE(page.wait([&] { return page.state() == "ended"; }));
    EXPECT_EQ(page.values.at("count").at("lost"), 0);
    EXPECT_EQ(page.values.at("pictures").size(), 2U);
    EXPECT_TRUE(page.wait([&] { return !source.following(); }));
  }
}

TEST(ViewSession, KeepsARunOfAnotherHostOnThePageUntilTheNextOneTalks) {
  const test::ScratchFolder folder("mrroc-view-far");
  link::MemoryHub hub;
  Record record;
  CameraWindow cameras;
  SessionSource source({.selector = {"far", "udpm://239.255.76.67:7800?ttl=0"},
                        .sessions = folder.path() / "sessions",
                        .open = [&](const auto&) { return hub.open(); }},
                       record, cameras);
  Page page(record);
  const auto bus = hub.open();
  std::int64_t number = 0;
  const auto talk = [&] {
    ++number;
    bus->publish({link::Group::agents, "far.arm1.reply"},
                 test::encoded(test::reply(number, 0.9, 0, 1), number, number));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  const auto shown = [&] {
    talk();
    return page.state() == "live" && record.rows("arm1") > 0;
  };
  ASSERT_TRUE(page.wait(shown));
  ASSERT_TRUE(page.wait([&] { return page.state() == "ended"; }));
  const std::size_t rows = record.rows("arm1");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  page.read();
  EXPECT_EQ(page.state(), "ended");
  EXPECT_EQ(record.rows("arm1"), rows);
  EXPECT_FALSE(source.following());
  number = 0;
  EXPECT_TRUE(page.wait(shown));
}

TEST(ViewSession, NamesTheCandidatesWhenSeveralRun) {
  const test::ScratchFolder folder("mrroc-view-several");
  const auto sessions = folder.path() / "sessions";
  const auto enter = [&](const std::string& name, std::int64_t id) {
    return std::make_unique<link::SessionFile>(link::SessionInfo{.name = name,
                                                                 .id = id,
                                                                 .address = link::address_for(name),
                                                                 .task = "sample",
                                                                 .run_folder = {},
                                                                 .pid = 0},
                                               sessions);
  };
  const auto a = enter("a", 1);
  const auto b = enter("b", 2);
  link::MemoryHub hub;
  Record record;
  CameraWindow cameras;
  SessionSource source(
      {.selector = {}, .sessions = sessions, .open = [&](const auto&) { return hub.open(); }}, record,
      cameras);
  Page page(record);
  EXPECT_TRUE(page.wait([&] {
    return page.state() == "waiting" &&
           std::string(page.values.at("state").at("text")).find("2 tasks run: a, b") != std::string::npos;
  })) << page.values;
}

}  // namespace
}  // namespace mrroc::view
