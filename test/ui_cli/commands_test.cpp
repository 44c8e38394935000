#include "ui_cli/commands.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/link/memory_bus.hpp"
#include "base/link/session.hpp"
#include "base/link/text.hpp"
#include "test/docs/json_table.hpp"
#include "test/ui_cli/fake_task.hpp"
#include "ui_cli/attach.hpp"
#include "ui_cli/fixed_number.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// The program, with tasks that live in this process.
class Commands : public ::testing::Test {
 protected:
  Commands() {
    std::string pattern = (fs::temp_directory_path() / "commands_test.XXXXXX").string();
    home_ = ::mkdtemp(pattern.data());
  }
  ~Commands() override { fs::remove_all(home_); }

  /// A task that answers and tells its status as long as it lives.
  struct RunningTask {
    RunningTask(Commands& test, const std::string& name)
        : file({name, 7, link::address_for(name), "drawing", "/runs/" + name, 0}, test.home_ / "mrroc"),
          bus(test.hub_.open()),
          task(*bus, name, 7) {}
    void start() {
      thread = std::jthread([this](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          task.publish(status);
          task.poll(2ms);
        }
      });
    }
    /// @return what it was told to do; ends it
    std::vector<OperatorOrder> end() {
      thread.request_stop();
      thread.join();
      return task.obeyed;
    }
    link::SessionFile file;
    std::unique_ptr<link::Bus> bus;
    FakeTask task;
    task_status_t status = drawing_status();
    std::jthread thread;
  };

  int run(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "ui_cli");
    out_.str("");
    err_.str("");
    return ui::run(static_cast<int>(arguments.size()), arguments.data(),
                   {out_,
                    err_,
                    home_ / "mrroc",
                    [this](const link::SessionInfo& session) {
                      if (!multicast_)
                        throw link::NoMulticast("no multicast route for " + session.address->url());
                      opened_ = session.address->port;
                      key_ = session.key;
                      return hub_.open();
                    },
                    {.repeat = 5ms, .give_up = give_up_},
                    {{"weigh",
                      "Weigh something",
                      [this](const auto& given, std::ostream& out, std::ostream&) {
                        weighed_ = given;
                        out << "3 kg\n";
                        return 1;
                      },
                      {"--session"}}}});
  }
  /// @return the last line on standard error
  std::string error() {
    std::string line, last;
    for (std::istringstream in(err_.str()); std::getline(in, line);) last = line;
    return last;
  }

  fs::path home_;
  link::MemoryHub hub_;
  std::ostringstream out_, err_;
  std::vector<std::string> weighed_;
  bool multicast_{true};
  int opened_{};
  std::optional<link::Key> key_;
  std::chrono::milliseconds give_up_{10s};
};

TEST_F(Commands, OrdersReachTheOnlyTaskThatRuns) {
  RunningTask task(*this, "one");
  task.start();
  EXPECT_EQ(run({"pause"}), 0) << error();
  EXPECT_EQ(out_.str(), "pause accepted\n");
  EXPECT_EQ(opened_, link::address_for("one").port);
  for (const char* order : {"start", "resume", "trigger", "stop"}) EXPECT_EQ(run({order}), 0) << error();
  EXPECT_EQ(task.end(), (std::vector{OperatorOrder::pause, OperatorOrder::start, OperatorOrder::resume,
                                     OperatorOrder::trigger, OperatorOrder::stop}));
}

TEST_F(Commands, HintsNameTheSessionThatTheOperatorHasNamed) {
  RunningTask task(*this, "one");
  task.task.refusal_reason = [](OperatorOrder) { return "not now"; };
  task.start();
  EXPECT_EQ(run({"resume", "--session", "one"}), 1);
  EXPECT_TRUE(error().ends_with("look at the state with `ui_cli status --session one`")) << error();
}

TEST_F(Commands, ARefusedOrderEndsWithOneAndTheReason) {
  RunningTask task(*this, "one");
  task.task.refusal_reason = [](OperatorOrder) {
    return "the task is running, only a paused one can be resumed";
  };
  task.start();
  EXPECT_EQ(run({"resume"}), 1);
  EXPECT_EQ(error(),
            "error: illegal_in_state: resume refused: the task is running, only a paused one can be resumed; "
            "look at the state with `ui_cli status`");
  EXPECT_EQ(out_.str(), "");
  EXPECT_EQ(run({"resume", "--json"}), 1);
  const auto told = nlohmann::json::parse(out_.str());
  EXPECT_EQ(told.at("accepted"), false);
  EXPECT_TRUE(documented("resume", told));
}

TEST_F(Commands, ATriggerThatComesEarlyIsGivenOnlyWithAYes) {
  RunningTask task(*this, "one");
  task.status.waits_for_trigger = 1;
  link::put_text(task.status.early, "the hand is still drawing: 33 %");
  task.start();
  EXPECT_EQ(run({"trigger"}), 1);
  EXPECT_EQ(
      error(),
      "error: illegal_in_state: trigger refused: the hand is still drawing: 33 %; wait until that is done, "
      "or give `ui_cli trigger --yes`");
  EXPECT_EQ(run({"status"}), 0) << error();
  EXPECT_NE(out_.str().find("early: the hand is still drawing: 33 %"), std::string::npos) << out_.str();
  EXPECT_EQ(run({"trigger", "--yes"}), 0) << error();
  EXPECT_EQ(task.end(), std::vector{OperatorOrder::trigger});
}

TEST_F(Commands, StatusShowsTheTask) {
  RunningTask task(*this, "one");
  task.start();
  EXPECT_EQ(run({"status"}), 0) << error();
  for (const char* part :
       {"drawing: running", "m = 5, draw on the paper", "63 %, stroke 3 of 6", "12.34 s simulated", "arm1",
        "F_x, F_y, F_z 0.00 0.00 1.02 N; paper_surface", "copy the coordinator's orders",
        "after      lowering: both pens settled on the paper", "edp arm1", "/runs/drawing-1"})
    EXPECT_NE(out_.str().find(part), std::string::npos) << part << " is not in\n" << out_.str();
}

TEST_F(Commands, StatusInJsonHasTheDocumentedKeys) {
  RunningTask task(*this, "one");
  task.start();
  EXPECT_EQ(run({"status", "--json"}), 0) << error();
  const auto j = nlohmann::json::parse(out_.str());
  EXPECT_TRUE(documented("status", j));
  EXPECT_EQ(j.at("session"), "one");
  EXPECT_EQ(j.at("task"), "drawing");
  EXPECT_EQ(j.at("state"), "running");
  EXPECT_EQ(j.at("m"), 5);
  EXPECT_EQ(j.at("behaviour"), "draw on the paper");
  EXPECT_EQ(j.at("waits_for_trigger"), false);
  EXPECT_EQ(j.at("macrostep"), 617);
  EXPECT_EQ(j.at("sim_s"), 12.34);
  EXPECT_EQ(j.at("progress"), 0.63);
  EXPECT_EQ(j.at("agents").at(0).at("T_0E").size(), 6U);
  EXPECT_EQ(j.at("agents").at(1).at("F_a").at(2), 0.92);
  EXPECT_EQ(j.at("agents").at(1).at("m"), 0);
  EXPECT_EQ(j.at("agents").at(1).at("behaviour"), "copy the coordinator's orders");
  EXPECT_EQ(j.at("agents").at(1).at("ended_because"), "");
  EXPECT_EQ(j.at("processes").at(7).at("state"), "running");
  EXPECT_EQ(j.at("last_message").at("code"), "none");
}

TEST_F(Commands, StatusOfAPlatformHasNoForcesAndAPauseFitsWhatThereIs) {
  RunningTask task(*this, "one");
  task.status.effector[0] = static_cast<std::int8_t>(EffectorKind::platform);
  task.status.state = static_cast<int>(TaskState::paused);
  task.status.T_0E[0][5] = 0.785;
  task.status.velocity[0][0] = 0.6;
  task.status.velocity[0][2] = -0.25;
  task.status.effector[1] = static_cast<std::int8_t>(EffectorKind::none);
  task.start();
  EXPECT_EQ(run({"status"}), 0) << error();
  const std::string text = out_.str();
  EXPECT_NE(text.find("      platforms stand;"), std::string::npos) << text;
  EXPECT_NE(text.find(" mm; heading 0.785 rad; v 0.60 m/s, w -0.25 rad/s"), std::string::npos) << text;
  EXPECT_EQ(text.find("F_x"), std::string::npos) << text;
  EXPECT_NE(text.find("arm2       copy the coordinator's orders"), std::string::npos) << text;
  EXPECT_EQ(run({"status", "--json"}), 0) << error();
  const auto agents = nlohmann::json::parse(out_.str()).at("agents");
  EXPECT_EQ(agents.at(0).at("effector"), "platform");
  EXPECT_EQ(agents.at(0).at("velocity"), (nlohmann::json{0.6, 0.0, -0.25}));
  EXPECT_EQ(agents.at(1).at("effector"), "none");
  EXPECT_TRUE(agents.at(1).at("velocity").is_null());
}

TEST(Resting, FitsTheEffectorsOfTheTask) {
  task_status_t m = drawing_status();
  EXPECT_EQ(ui::resting(ui::snapshot(m, "s")), "arms rest and keep their forces");
  m.effector[1] = static_cast<std::int8_t>(EffectorKind::platform);
  EXPECT_EQ(ui::resting(ui::snapshot(m, "s")), "arms keep forces, platforms stand");
  m.effector[0] = static_cast<std::int8_t>(EffectorKind::none);
  EXPECT_EQ(ui::resting(ui::snapshot(m, "s")), "platforms stand");
}

TEST_F(Commands, StatusTellsNoPoseBeforeHoming) {
  RunningTask task(*this, "one");
  task.status.position_known[0] = 0;
  task.start();
  EXPECT_EQ(run({"status"}), 0) << error();
  EXPECT_NE(out_.str().find("x, y, z - mm; rotation - rad; F_x, F_y, F_z 0.00 0.00 1.02 N"),
            std::string::npos)
      << out_.str();
  EXPECT_NE(out_.str().find("x, y, z 900.0"), std::string::npos) << "the other arm is homed";
  EXPECT_EQ(run({"status", "--json"}), 0) << error();
  EXPECT_TRUE(nlohmann::json::parse(out_.str()).at("agents").at(0).at("T_0E").is_null());
}

TEST_F(Commands, OptionsMayStandBeforeAndAfterTheCommand) {
  RunningTask a(*this, "a"), b(*this, "b");
  b.start();
  EXPECT_EQ(run({"--session", "b", "pause"}), 0) << error();
  EXPECT_EQ(run({"resume", "--session", "b"}), 0) << error();
  EXPECT_EQ(b.end().size(), 2U);
}

TEST_F(Commands, NameTheCandidatesWhenSeveralTasksRun) {
  RunningTask a(*this, "a"), b(*this, "b");
  EXPECT_EQ(run({"pause"}), 2);
  EXPECT_EQ(error(), "error: no_such_session: 2 tasks run: a, b; name one with --session NAME");
  EXPECT_EQ(run({"pause", "--session", "c"}), 2);
  EXPECT_NE(error().find("no task runs under the name c; these run: a, b; "), std::string::npos) << error();
}

TEST_F(Commands, SayHowToStartATaskWhenNoneRuns) {
  for (const char* command : {"pause", "status", "watch"}) {
    EXPECT_EQ(run({command}), 2);
    EXPECT_EQ(error().find("error: no_such_session: no task runs; start one, for example with `./run "), 0U)
        << error();
  }
  EXPECT_EQ(run({}), 2) << "without a command it is the full-screen view";
}

TEST_F(Commands, ReachATaskOfAnotherHostByItsUrl) {
  RunningTask task(*this, "here");
  const auto bus = hub_.open();
  FakeTask far(*bus, "far", 99);
  std::jthread thread([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      far.publish(drawing_status());
      far.poll(2ms);
    }
  });
  EXPECT_EQ(run({"pause", "--session", "far", "--url", "udpm://239.255.76.67:7800?ttl=1"}), 0) << error();
  EXPECT_EQ(opened_, 7800);
  link::write_key_file(home_ / "far.key", link::Key::random());
  const std::string key = home_ / "far.key";
  EXPECT_EQ(run({"pause", "--session", "far", "--url", "udpm://239.255.76.67:7800?ttl=1", "--key-file",
                 key.c_str()}),
            0)
      << error();
  EXPECT_EQ(key_, link::read_key_file(key));
  fs::permissions(key, fs::perms::group_read, fs::perm_options::add);
  EXPECT_EQ(run({"pause", "--session", "far", "--url", "udpm://239.255.76.67:7800?ttl=1", "--key-file",
                 key.c_str()}),
            2);
  EXPECT_NE(error().find("open to other users"), std::string::npos) << error();
  EXPECT_EQ(run({"pause", "--session", "far", "--url", "http://nowhere"}), 2);
  EXPECT_EQ(run({"pause", "--session", "far", "--url", "udpm://1.2.3.4:99999999999"}), 2);
  EXPECT_EQ(run({"pause", "--url", "udpm://239.255.76.67:7800"}), 2) << "a url alone names no task";
}

TEST_F(Commands, AreThreeWhenTheTaskIsSilent) {
  RunningTask task(*this, "hung");
  give_up_ = 30ms;
  EXPECT_EQ(run({"pause"}), 3);
  EXPECT_EQ(error().find("error: peer_silent: the task of session hung has not answered pause"), 0U)
      << error();
  EXPECT_EQ(run({"status"}), 3);
}

TEST_F(Commands, AreThreeWithoutMulticast) {
  RunningTask task(*this, "one");
  multicast_ = false;
  EXPECT_EQ(run({"pause"}), 3);
  EXPECT_EQ(error().find("error: no_multicast: "), 0U) << error();
}

TEST_F(Commands, ListWhatRuns) {
  EXPECT_EQ(run({"list"}), 0);
  EXPECT_EQ(out_.str(), "no task runs\n");
  EXPECT_EQ(run({"list", "--json"}), 0);
  EXPECT_EQ(nlohmann::json::parse(out_.str()), nlohmann::json::array());
  RunningTask a(*this, "a"), b(*this, "b");
  EXPECT_EQ(run({"list"}), 0);
  EXPECT_NE(out_.str().find("/runs/b"), std::string::npos);
  EXPECT_EQ(run({"list", "--json"}), 0);
  const auto j = nlohmann::json::parse(out_.str());
  ASSERT_EQ(j.size(), 2U);
  EXPECT_TRUE(documented("list", j));
  EXPECT_EQ(j.at(0).at("session"), "a");
  EXPECT_EQ(j.at(0).at("pid"), ::getpid());
  EXPECT_EQ(link::LcmAddress::parse(j.at(0).at("url")).port, link::address_for("a").port);
}

TEST_F(Commands, RefuseABadCommandLineWithTwo) {
  for (const std::vector<const char*>& line :
       std::vector<std::vector<const char*>>{{"paws"},
                                             {"pause", "resume"},
                                             {"--speed", "3"},
                                             {"pause", "--session"},
                                             {"pause", "--session", "a b"}}) {
    EXPECT_EQ(run(line), 2);
    EXPECT_EQ(error().find("error: bad_usage: "), 0U) << error();
  }
}

TEST_F(Commands, ThatLackAWordAreToldWhatToType) {
  EXPECT_EQ(run({"completion"}), 2);
  EXPECT_NE(error().find("SHELL (bash or zsh) is missing; type for example `ui_cli completion bash`"),
            std::string::npos)
      << error();
  EXPECT_EQ(run({"pause", "--session"}), 2);
  EXPECT_NE(error().find("a value is missing behind --session ("), std::string::npos) << error();
  EXPECT_NE(error().find("type for example `ui_cli status --session press`"), std::string::npos) << error();
}

TEST_F(Commands, ThatDoNotExistGetTheNearestThatDoes) {
  EXPECT_EQ(run({"pasue"}), 2);
  EXPECT_NE(error().find("did you mean 'pause'?"), std::string::npos) << error();
  EXPECT_EQ(run({"somersault"}), 2);
  EXPECT_NE(error().find("there is no command 'somersault'"), std::string::npos) << error();
}

TEST_F(Commands, WhoAsksIsNotToldToGiveAnOrder) {
  for (const char* word : {"stat", "state", "sta"}) {
    EXPECT_EQ(run({word}), 2);
    EXPECT_NE(error().find("did you mean 'status'?"), std::string::npos) << error();
  }
  EXPECT_EQ(run({"show"}), 2);
  EXPECT_EQ(error().find("did you mean"), std::string::npos) << error();
}

TEST_F(Commands, HelpNamesEveryCommandAndExitStatus) {
  EXPECT_EQ(run({"--help"}), 0);
  for (const char* part : {"status", "start", "pause", "resume", "trigger", "stop", "list", "watch",
                           "--session", "--url", "--json", "Examples", "Exit status"})
    EXPECT_NE(out_.str().find(part), std::string::npos) << part;
  EXPECT_EQ(run({"pause", "--help"}), 0);
}

TEST_F(Commands, RefuseTheFullScreenWithoutATerminal) {
  if (::isatty(STDIN_FILENO) != 0 && ::isatty(STDOUT_FILENO) != 0) GTEST_SKIP() << "this is a terminal";
  RunningTask task(*this, "one");
  EXPECT_EQ(run({"watch"}), 2);
  EXPECT_EQ(error().find("error: bad_usage: the full-screen view needs a terminal"), 0U) << error();
}

TEST(ChooseSession, RefusesATaskThatNobodyOutsideCanReach) {
  const std::vector<link::SessionInfo> running{{"quiet", 1, std::nullopt, "drawing", "/runs/1", 4711}};
  try {
    ui::choose_session({}, running);
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::no_such_session);
  }
}

TEST_F(Commands, ToolHasItsOptionsForItselfAndNeedsNoTask) {
  EXPECT_EQ(run({"weigh", "--json", "--help", "--mass", "-3", "stop"}), 1) << "its own status";
  EXPECT_EQ(weighed_, (std::vector<std::string>{"--json", "--help", "--mass", "-3", "stop"}));
  EXPECT_EQ(out_.str(), "3 kg\n");
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_NE(out_.str().find("Weigh something"), std::string::npos);
}

TEST_F(Commands, OptionsBeforeTheNameOfAToolAreAsGoodAsBehindIt) {
  EXPECT_EQ(run({"--session", "a", "--json", "weigh", "stone"}), 1);
  EXPECT_EQ(weighed_, (std::vector<std::string>{"stone", "--session", "a", "--json"}));
  EXPECT_EQ(run({"--session", "a", "weigh", "--session=b"}), 1);
  EXPECT_EQ(weighed_, (std::vector<std::string>{"--session=b"})) << "the later one holds";
  EXPECT_EQ(run({"--session", "a", "--url", "udpm://1.2.3.4:5", "weigh"}), 2);
  EXPECT_NE(error().find("weigh takes no --url"), std::string::npos) << error();
}

TEST_F(Commands, HelpIsGivenWhereverItIsAskedForWhateverElseIsWrong) {
  EXPECT_EQ(run({"status", "--nonsense", "--help"}), 0);
  EXPECT_NE(out_.str().find("Usage: ui_cli status"), std::string::npos) << out_.str();
  EXPECT_EQ(run({"--help", "somersault"}), 0);
  EXPECT_NE(out_.str().find("Exit status"), std::string::npos);
  EXPECT_EQ(run({"--session", "a", "manual", "move", "arm1", "-h"}), 0);
  EXPECT_NE(out_.str().find("gripper ARM METRES"), std::string::npos);
  EXPECT_EQ(run({"--help", "weigh", "stone"}), 1) << "a tool has its own help";
  EXPECT_EQ(weighed_, (std::vector<std::string>{"stone", "--help"}));
}

using ui::fixed;

TEST(FixedNumber, ThatRoundsToZeroHasNoSign) {
  EXPECT_EQ(fixed(-0.04, 1), "0.0");
  EXPECT_EQ(fixed(-0.0, 3), "0.000");
  EXPECT_EQ(fixed(-0.06, 1), "-0.1");
  EXPECT_EQ(fixed(-10, 0), "-10");
  EXPECT_EQ(fixed(-std::numeric_limits<double>::infinity(), 1), "-inf");
  EXPECT_EQ(fixed(12.345, 2), "12.35");
}

}  // namespace
}  // namespace mrroc::test
