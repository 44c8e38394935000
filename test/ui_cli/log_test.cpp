// The commands for run folders, on a small folder made here.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/fault.hpp"
#include "base/link/event_log.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/operator.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_image_t.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/supervisor_t.hpp"
#include "ui_cli/log/log_check.hpp"
#include "ui_cli/log/log_command.hpp"
#include "ui_cli/log/log_compare.hpp"
#include "ui_cli/log/log_csv.hpp"
#include "ui_cli/log/log_show.hpp"
#include "ui_cli/log/replay.hpp"
#include "ui_cli/log/replay_check.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class RunFolder : public ::testing::Test {
 protected:
  static constexpr std::int64_t kMacrosteps = 50;

  RunFolder() {
    std::string pattern = (fs::temp_directory_path() / "log_test.XXXXXX").string();
    home_ = ::mkdtemp(pattern.data());
    a_ = make("a", 1, 0);
  }
  ~RunFolder() override { fs::remove_all(home_); }

  template <link::FixedMessage M>
  static void log(link::EventLog& to, const std::string& channel, M m, std::int64_t session,
                  std::int64_t number, std::int64_t stamp) {
    m.header = {session, number, stamp};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<M>()));
    m.encode(bytes.data(), 0, link::encoded_size<M>());
    to.receive("s." + channel, bytes);
  }

  /// An arm that approaches until macrostep 20, refuses a command in 30, and a process that says something.
  fs::path make(const std::string& name, std::int64_t session, double more_force) const {
    const fs::path folder = home_ / name;
    fs::create_directories(folder);
    std::ofstream(folder / "config.toml") << "[time]\nn_s = 10\n";
    std::ofstream(folder / "summary.json")
        << R"({"outcome": "done", "figures": {"hold_N": )" << 4 + more_force << "}}";
    std::ofstream(folder / "processes.json")
        << R"({"task": "press", "clock": "step", "processes": [{"name": "mp", "program": "press", "arguments": []},
               {"name": "ecp-arm1", "program": "ecp_press", "arguments": ["--name", "ecp-arm1"]}]})";
    link::EventLog to(folder / link::kEventLog);
    supervisor_t s{};
    log(to, "supervisor", s, session, 1, 0);
    for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
      Report r{.m = i < 20 ? 1 : 2};
      r.driver_state = DriverState::executing;
      r.F_a[Axis::z] = 0.1 * static_cast<double>(i) + (i > 40 ? more_force : 0);
      if (i == 30) {
        r.verdict = Verdict::refused;
        r.fault.code = FaultCode::too_fast;
      }
      log(to, "arm1.report", to_message(r), session, i, i);
      operator_image_t h{};
      h.started = i > 3;
      log(to, "operator.image", h, session, i, i);
    }
    console_t line{};
    link::put_text(line.process, "ecp-arm1");
    link::put_text(line.text, "late: 3 skipped");
    log(to, "ecp-arm1.console", line, session, 1, 25);
    return folder;
  }

  /// Adds a process to a run of session 1, which has come to its end and has sent on that channel.
  static void tell_channels(const fs::path& folder, const std::string& process, const std::string& channel) {
    Json run = Json::parse(std::ifstream(folder / "processes.json"));
    run["processes"].push_back({{"name", process}, {"program", "vsp"}, {"arguments", Json::array()}});
    std::ofstream(folder / "processes.json") << run;
    const link::LogReader before(folder);
    link::EventLog to(folder / link::kEventLog);
    for (const link::LoggedMessage& m : before.messages()) to.receive("s." + m.channel, m.bytes);
    process_status_t done{};
    done.n_hashes = 1;
    link::put_text(done.hash[0].channel, "." + channel);
    log(to, process + ".status", done, 1, 1, kMacrosteps);
  }

  int run(const std::vector<std::string>& arguments) {
    out_.str("");
    err_.str("");
    try {
      return ui::run_log(arguments, out_, err_);
    } catch (const FaultError& e) {
      err_ << e.error_line();
      return exit_status(e.fault().code);
    }
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::istringstream in(out_.str());
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  static std::string bad_run(const fs::path& folder) {
    try {
      static_cast<void>(ui::RunRecord(folder));
    } catch (const FaultError& e) {
      return std::string(to_string(e.fault().code));
    }
    return "";
  }

  fs::path home_, a_;
  std::ostringstream out_, err_;
};

TEST_F(RunFolder, ShowTellsEveryMacrostepAndEveryChange) {
  ASSERT_EQ(run({"show", a_.string()}), 0) << err_.str();
  EXPECT_GT(lines().size(), static_cast<std::size_t>(kMacrosteps));
  ASSERT_EQ(run({"show", a_.string(), "--m"}), 0);
  std::string story = out_.str();
  for (const char* what : {"0.400 s     20  * arm1       behaviour m = 2", "operator   start", "too_fast",
                           "ecp-arm1   late: 3 skipped"})
    EXPECT_NE(story.find(what), std::string::npos) << what << "\n" << story;
  EXPECT_LT(lines().size(), 8U);
  ASSERT_EQ(run({"show", a_.string(), "--m", "--from", "0.39", "--to", "0.41", "--json"}), 0);
  ASSERT_EQ(lines().size(), 1U);
  EXPECT_EQ(Json::parse(lines()[0])["i"], 20);
}

TEST_F(RunFolder, ShowTellsTheMessagesOfAChannel) {
  ASSERT_EQ(run({"show", a_.string(), "--channel", "arm1.report", "--to", "0.1"}), 0);
  EXPECT_EQ(lines().size(), 5U);
  EXPECT_NE(lines()[1].find("F_a[2]=0.2"), std::string::npos) << out_.str();
  EXPECT_EQ(run({"show", a_.string(), "--channel", "arm1.raport"}), 2);
  EXPECT_NE(err_.str().find("did you mean 'arm1.report'"), std::string::npos);
}

TEST_F(RunFolder, CsvHasARowPerMessageThatCanBeReadBack) {
  ASSERT_EQ(run({"csv", a_.string(), "arm1.report", "--fields", "m,F_a"}), 0) << err_.str();
  EXPECT_EQ(lines().at(0), "t,m,F_a[0],F_a[1],F_a[2],F_a[3],F_a[4],F_a[5]");
  ASSERT_EQ(lines().size(), kMacrosteps + 1U);
  EXPECT_EQ(lines().at(3), "0.06,1,0,0,0.30000000000000004,0,0,0");
  ASSERT_EQ(run({"csv", a_.string(), "ecp-arm1.console", "--fields", "text"}), 0);
  EXPECT_EQ(lines().at(1), "0.5,\"late: 3 skipped\"");
  ASSERT_EQ(run({"csv", a_.string(), "arm1.report", "--json"}), 0);
  EXPECT_EQ(Json::parse(out_.str())[29]["verdict"], static_cast<int>(Verdict::refused));
  ASSERT_EQ(run({"csv", a_.string()}), 0);
  EXPECT_NE(out_.str().find("agent_report_t"), std::string::npos);
  EXPECT_EQ(run({"csv", a_.string(), "arm1.report", "--fields", "F_b"}), 2);
}

TEST_F(RunFolder, CompareNamesTheFirstMessageThatDiffersAndTheFigures) {
  EXPECT_EQ(run({"compare", a_.string(), make("same", 77, 0).string()}), 0) << out_.str();
  EXPECT_EQ(run({"compare", a_.string(), make("other", 2, 0.5).string(), "--json"}), 1);
  const Json j = Json::parse(out_.str());
  EXPECT_EQ(j["differences"], 10);
  EXPECT_EQ(j["first"]["channel"], "arm1.report");
  EXPECT_EQ(j["first"]["number"], 41);
  EXPECT_EQ(j["first"]["field"], "F_a[2]");
  EXPECT_EQ(j["figures"]["hold_N"], (Json{"4", "4.5"}));
}

TEST_F(RunFolder, PlotTakesAnyNameOfAPictureButItsScripts) {
  EXPECT_EQ(run({"plot", a_.string(), "force", "--output", (home_ / "x.gp").string()}), 2);
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  const fs::path odd = home_ / "it's \"so\".png";
  EXPECT_EQ(run({"plot", a_.string(), "force", "--output", odd.string(), "--json"}), 0) << err_.str();
  EXPECT_TRUE(fs::exists(odd));
  EXPECT_EQ(Json::parse(out_.str())["picture"], odd.string());
}

TEST_F(RunFolder, CheckAsksEveryProgramAndJoinsTheVerdicts) {
  std::vector<std::string> asked;
  const ui::RunRecord record(a_);
  const auto verdicts = ui::check_run(record, [&](const std::string& program, const auto& arguments) {
    asked.push_back(program + " " + arguments.at(0) + " " + arguments.at(arguments.size() - 1));
    link::LogVerdict v{.process = program, .compared = 10};
    if (program == "ecp_press") {
      v.differences = 2;
      v.first = link::LogDifference{.channel = "arm1.command",
                                    .number = 4,
                                    .stamp = 5,
                                    .behaviour = "2, settle",
                                    .function = "f_ce",
                                    .field = "arm.n_s",
                                    .logged = "10",
                                    .recomputed = "9"};
    }
    return link::to_json(v);
  });
  EXPECT_EQ(asked, (std::vector<std::string>{"press --check step", "ecp_press --check ecp-arm1"}));
  EXPECT_EQ(ui::report_check(a_, verdicts, "", false, out_), 1);
  for (const char* what : {"2 DIFFER", "behaviour 2, settle", "f_ce", "field arm.n_s",
                           "logged 10, recomputed 9", "20 messages recomputed, 2 differ"})
    EXPECT_NE(out_.str().find(what), std::string::npos) << out_.str();
}

TEST_F(RunFolder, AFolderThatIsNoneIsToldWhatItLacksAndWhereRunsAre) {
  const auto error = [&](const fs::path& folder) {
    EXPECT_EQ(run({"show", folder.string()}), 2);
    return err_.str();
  };
  const fs::path before = fs::current_path(), bare = home_ / "bare";
  fs::current_path(home_);
  EXPECT_NE(error("nowhere").find("there is no folder nowhere"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("there are none here"), std::string::npos) << err_.str();
  fs::create_directories("runs");
  fs::rename(make("older", 1, 0), "runs/older");
  fs::rename(make("newer", 1, 0), "runs/newer");
  fs::last_write_time(fs::path("runs/older") / link::kEventLog,
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::create_directories(bare);
  EXPECT_NE(error(bare).find("it has no events.lcmlog"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("the newest here is runs/newer"), std::string::npos) << err_.str();
  std::ofstream(bare / link::kEventLog) << "x";
  EXPECT_NE(error(bare).find("it has no config.toml"), std::string::npos) << err_.str();
  fs::current_path(before);
}

TEST_F(RunFolder, ProgramsOfARunAreThoseBesideThisOneAndNoOthers) {
  const auto write = [&](const std::string& task, const std::string& program) {
    std::ofstream(a_ / "processes.json")
        << Json{{"task", task},
                {"clock", "step"},
                {"processes", {{{"name", "mp"}, {"program", program}, {"arguments", Json::array()}}}}};
  };
  write("press", "press");
  EXPECT_EQ(bad_run(a_), "");
  for (const char* elsewhere : {"/bin/true", "../press", "bin/press", "./press", "..", ".", "press/", ""}) {
    write("press", elsewhere);
    EXPECT_EQ(bad_run(a_), "bad_log") << elsewhere;
    write(elsewhere, "press");
    EXPECT_EQ(bad_run(a_), "bad_log") << elsewhere;
  }
}

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

TEST_F(RunFolder, ReplayNamesTheProcessesThatThereAreAndWantsTheWholeRunOfThem) {
  const ui::ReplaySurroundings around{home_, [](const link::LcmAddress&) -> std::unique_ptr<link::Bus> {
                                        throw FaultError(FaultCode::internal_error,
                                                         "nothing is to be opened");
                                      }};
  const auto error = [&](const std::vector<std::string>& arguments) {
    try {
      ui::run_replay(arguments, around, out_, err_);
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
      const ui::ReplaySurroundings around{sessions, [&](const link::LcmAddress&) { return hub.open(); }};
      std::ostringstream out, err;
      const int status = ui::run_replay({a_.string(), "--speed", "0.001"}, around, out, err);
      ::_exit(out.str().find("messages, until") == std::string::npos ? 9 : status);
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

TEST_F(RunFolder, WhatIsNoRunFolderIsRefused) {
  EXPECT_EQ(bad_run(home_), "bad_log");
  EXPECT_EQ(run({"show", (home_ / "nothing").string()}), 2);
  EXPECT_EQ(run({"dance"}), 2);
  EXPECT_EQ(run({}), 2);
  fs::remove(a_ / "processes.json");
  EXPECT_EQ(run({"check", a_.string()}), 2);
  EXPECT_NE(err_.str().find("processes.json"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::test
