// Replays: their pace, whom they obey, and what they compare.
#include "ui_cli/log/replay.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <deque>
#include <thread>

#include "base/link/memory_bus.hpp"
#include "base/operator.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/docs/json_table.hpp"
#include "test/ui_cli/run_folder.hpp"
#include "ui_cli/log/replay_check.hpp"

namespace mrroc::test {
namespace {

TEST_F(RunFolder, ReplayPublishesEverythingAtItsPaceAndTakesNoOrderButStop) {
  const ui::RunRecord record(a_);
  link::MemoryHub hub;
  const auto bus = hub.open(), terminal = hub.open();
  struct Count final : link::Sink {
    void receive(std::string_view channel, std::span<const std::uint8_t>) noexcept override {
      reports += channel == "r.arm1.report";
    }
    int reports{};
  } count;
  terminal->subscribe_all("r.", count);
  link::Outbox<operator_order_t> orders(*terminal, {link::Group::agents, "r.operator"}, 1);
  link::Queue<operator_answer_t> answers(*terminal, {link::Group::agents, "r.answer"}, 1);
  ui::Replay replay(*bus, record, "r", {.without = {"operator.image"}});
  EXPECT_TRUE(replay.go_on_to(0.5));
  while (terminal->wait(std::chrono::milliseconds(0))) {
  }
  EXPECT_EQ(count.reports, 25);
  orders.publish({.header = {}, .id = 5, .order = static_cast<int>(OperatorOrder::pause)}, 0);
  EXPECT_TRUE(replay.go_on_to(0.6));
  EXPECT_FALSE(replay.stopped());
  orders.publish({.header = {}, .id = 6, .order = static_cast<int>(OperatorOrder::stop)}, 0);
  EXPECT_FALSE(replay.go_on_to(100));
  EXPECT_TRUE(replay.stopped());
  while (terminal->wait(std::chrono::milliseconds(0))) {
  }
  EXPECT_EQ(count.reports, kMacrosteps);
  EXPECT_EQ(answers.take()->accepted, 0);
  EXPECT_EQ(answers.take()->accepted, 1);
  EXPECT_EQ(replay.published(), kMacrosteps + 2) << "without the channel of somebody else";
}

TEST_F(RunFolder, ReplayTellsScriptsWhatItHasPublished) {
  link::MemoryHub hub;
  const ui::ReplayEnvironment environment{home_, [&](const link::SessionInfo&) { return hub.open(); }};
  EXPECT_EQ(ui::run_replay({a_.string(), "--speed", "0", "--json"}, environment, out_, err_), 0);
  const Json told = Json::parse(out_.str());
  EXPECT_TRUE(documented("replay RUN", told));
  EXPECT_DOUBLE_EQ(told.at("sim_s"), 1.0);
}

/// A virtual sensor of the run: says for every report what the log has it say, but for one number.
struct Echo final : link::Sink {
  Echo(link::Bus& to, std::int64_t wrong_one, std::int64_t last_one)
      : bus(to), wrong(wrong_one), last(last_one) {
    bus.subscribe({link::Group::agents, "r.arm1.report"}, *this);
  }
  void receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept override {
    const std::int64_t i = link::header_of(bytes).stamp;
    if (i <= last) next.push_back(i);
  }
  /// What a bus delivers must not publish.
  void answer() {
    while (bus.wait(std::chrono::milliseconds(0))) {
    }
    for (; !next.empty(); next.pop_front()) {
      operator_image_t h{};
      h.header = {1, next.front(), next.front()};
      h.started = next.front() > 3 || next.front() == wrong;
      std::vector<std::uint8_t> message(static_cast<std::size_t>(link::encoded_size<operator_image_t>()));
      h.encode(message.data(), 0, link::encoded_size<operator_image_t>());
      bus.publish({link::Group::agents, "r.operator.image"}, message);
    }
  }
  link::Bus& bus;
  std::int64_t wrong, last;
  std::deque<std::int64_t> next;
};

TEST_F(RunFolder, ReplayComparesWhatAProcessBesideItSaysWithTheLog) {
  tell_channels(a_, "vsp-arm1", "operator.image");
  const ui::RunRecord record(a_);
  const auto verdict = [&](std::int64_t wrong, std::int64_t last) {
    link::MemoryHub hub;
    const auto bus = hub.open(), sensor = hub.open();
    Echo echo(*sensor, wrong, last);
    ui::ReplayCheck check(*bus, record, "r", {"vsp-arm1"});
    ui::Replay replay(*bus, record, "r", {.without = {}, .check = &check});
    for (int waited = 0; replay.go_on_to(100); ++waited) {
      EXPECT_TRUE(replay.waits());
      echo.answer();
      if (waited == 200) replay.give_up();
      if (waited > 1000) break;
    }
    return check.verdicts().at(0);
  };
  const link::LogVerdict same = verdict(0, kMacrosteps);
  EXPECT_EQ(same.process, "vsp-arm1");
  EXPECT_EQ(same.compared, kMacrosteps);
  EXPECT_EQ(same.differences, 0);
  EXPECT_TRUE(same.incomplete.empty()) << same.incomplete;
  const link::LogVerdict other = verdict(2, kMacrosteps);
  EXPECT_EQ(other.differences, 1);
  ASSERT_TRUE(other.first);
  EXPECT_EQ(other.first->channel, "operator.image");
  EXPECT_EQ(other.first->number, 2);
  EXPECT_EQ(other.first->field, "started");
  EXPECT_EQ(other.first->logged, "0");
  EXPECT_EQ(other.first->recomputed, "1");
  const link::LogVerdict silent = verdict(0, 30);
  EXPECT_EQ(silent.compared, 30);
  ASSERT_TRUE(silent.first);
  EXPECT_EQ(silent.first->number, 31);
  EXPECT_EQ(silent.first->recomputed, "nothing");
  EXPECT_FALSE(silent.incomplete.empty());
}

TEST_F(RunFolder, ReplayHearsTheListenersSessionOnlyAndMessagesOfTheRightSize) {
  tell_channels(a_, "vsp-arm1", "operator.image");
  const ui::RunRecord record(a_);
  link::MemoryHub hub;
  const auto bus = hub.open(), other = hub.open();
  ui::ReplayCheck check(*bus, record, "r", {"vsp-arm1"});
  const auto& all = record.log().messages();
  const auto& first = *std::ranges::find(all, "operator.image", &link::LoggedMessage::channel);
  const auto say = [&](std::vector<std::uint8_t> bytes) {
    other->publish({link::Group::agents, "r.operator.image"}, bytes);
    while (bus->wait(std::chrono::milliseconds(0))) {
    }
  };
  operator_image_t strange{};
  strange.header = {2, 1, 1};
  std::vector<std::uint8_t> bytes(first.bytes.size());
  strange.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  say(bytes);
  EXPECT_FALSE(check.passed(first)) << "of another session";
  bytes.assign(first.bytes.begin(), first.bytes.end());
  bytes.push_back(0);
  say(bytes);
  EXPECT_FALSE(check.passed(first)) << "too long";
  bytes.pop_back();
  say(bytes);
  EXPECT_TRUE(check.passed(first));
  EXPECT_EQ(check.verdicts().at(0).differences, 0);
}

TEST_F(RunFolder, ReplayDoesNotWaitForAProcessThatHasEndedAndTellsHow) {
  tell_channels(a_, "vsp-arm1", "operator.image");
  const ui::RunRecord record(a_);
  link::MemoryHub hub;
  const auto bus = hub.open(), sensor = hub.open();
  Echo echo(*sensor, 0, 30);
  ui::ReplayCheck check(*bus, record, "r", {"vsp-arm1"});
  ui::Replay replay(*bus, record, "r", {.without = {}, .check = &check});
  EXPECT_TRUE(replay.go_on_to(100));
  replay.repeat();
  for (int waited = 0; waited < 200 && replay.go_on_to(100); ++waited) echo.answer();
  ASSERT_TRUE(replay.waits());
  check.ended("vsp-arm1", "signal 9 (Killed)");
  EXPECT_FALSE(replay.go_on_to(100));
  const link::LogVerdict v = check.verdicts().at(0);
  EXPECT_EQ(v.compared, 30);
  EXPECT_EQ(v.differences, 1);
  EXPECT_NE(v.incomplete.find("it ended with signal 9 (Killed)"), std::string::npos) << v.incomplete;
  EXPECT_LE(replay.published(), static_cast<std::int64_t>(record.log().messages().size()))
      << "repeated messages are counted once";
}

TEST_F(RunFolder, ReplayRefusesProcessesThatNeedMoreThanMessagesWithTheReasonOfLogCheck) {
  tell_channels(a_, "simulator", "operator.image");
  link::MemoryHub hub;
  std::vector<std::string> asked;
  const ui::ReplayEnvironment environment{
      home_, [&](const link::SessionInfo&) { return hub.open(); },
      [&](const std::string& program, const std::vector<std::string>&) {
        asked.push_back(program);
        return link::to_json({.process = "simulator", .not_checked = "the servo links are not in the log"});
      }};
  const auto error = [&](const std::string& with) {
    try {
      ui::run_replay({a_.string(), "--with", with}, environment, out_, err_);
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error("simulator,simulator")
                .find("simulator cannot listen to a replay: the servo links are not in the log"),
            std::string::npos)
      << error("simulator,simulator");
  EXPECT_EQ(asked.front(), "vsp");
  tell_channels(a_, "mp", "operator.image");
  EXPECT_NE(error("mp").find("mp cannot listen to a replay"), std::string::npos) << error("mp");
}

TEST_F(RunFolder, ReplayNamesTheProcessesThatThereAreAndWantsTheWholeRunOfThem) {
  const ui::ReplayEnvironment environment{home_, [](const link::SessionInfo&) -> std::unique_ptr<link::Bus> {
                                            throw FaultError(FaultCode::internal_error,
                                                             "nothing is to be opened");
                                          }};
  const auto error = [&](const std::vector<std::string>& arguments) {
    try {
      ui::run_replay(arguments, environment, out_, err_);
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error({a_.string(), "--with", "vsp-arm1", "--from", "1"}).find("begins with the run"),
            std::string::npos);
  link::MemoryHub hub;
  const auto bus = hub.open();
  const ui::RunRecord record(a_);
  const auto wrong = [&](const char* process) {
    try {
      const ui::ReplayCheck check(*bus, record, "r", {process});
    } catch (const FaultError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(wrong("vsp-arm3").find("it has mp, ecp-arm1"), std::string::npos) << wrong("vsp-arm3");
  EXPECT_NE(wrong("ecp-arm1").find("did not come to its end"), std::string::npos) << wrong("ecp-arm1");
}

TEST_F(RunFolder, ReplayEndsWellWhenItIsInterruptedOrTerminated) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const fs::path sessions = home_ / std::to_string(signal);
    fs::create_directories(sessions);
    const pid_t child = ::fork();
    if (child == 0) {
      link::MemoryHub hub;
      const ui::ReplayEnvironment environment{sessions, [&](const link::SessionInfo&) { return hub.open(); }};
      std::ostringstream out, err;
      const int status = ui::run_replay({a_.string(), "--speed", "0.001"}, environment, out, err);
      ::_exit(out.str().find(", until ") == std::string::npos ? 9 : status);
    }
    const auto runs = [&] {
      return std::ranges::any_of(fs::directory_iterator(sessions),
                                 [](const auto& e) { return e.path().extension() == ".json"; });
    };
    for (int k = 0; k < 1000 && !runs(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << signal;
    EXPECT_EQ(WEXITSTATUS(status), 0) << signal;
    EXPECT_FALSE(runs()) << "the session is over";
  }
}

}  // namespace
}  // namespace mrroc::test
