// The last seconds of every process, out of the log of a run.
#include "mp/black_box.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include <fstream>
#include <map>
#include <sstream>

#include "base/link/channel.hpp"
#include "base/link/event_log.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/platform_reply_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

#ifdef MRROC_SANITIZED
constexpr int kSanitizedFactor = 6;
#else
constexpr int kSanitizedFactor = 1;
#endif

class BlackBox : public ::testing::Test {
 protected:
  BlackBox() {
    std::string pattern = (fs::temp_directory_path() / "black_box.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~BlackBox() override { fs::remove_all(folder_); }
  std::string text(const std::string& file) const {
    std::stringstream all;
    all << std::ifstream(folder_ / file).rdbuf();
    return all.str();
  }
  fs::path folder_;
};

TEST_F(BlackBox, HasTheLastFiveSecondsOfEveryProcess) {
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1);
    bus.subscribe_all("s.", log);
    link::Outbox<effector_reply_t> reply(bus, {link::Group::agents, "s.arm1.reply"}, 1);
    link::Outbox<agent_report_t> report(bus, {link::Group::agents, "s.arm1.report"}, 1);
    for (int i = 1; i <= 500; ++i) {  // 10 s
      effector_reply_t r{};
      r.step = 10 * i;
      reply.publish(r, i);
      agent_report_t a{};
      a.m = i > 300 ? 7 : 3;
      report.publish(a, i);
    }
    ASSERT_TRUE(log.flush());
  }
  std::ofstream(folder_ / "arm1-fault-5000.csv") << "step\n";
  const auto files = write_black_box(folder_, {"mp", "edp-arm1", "ecp-arm1"});
  EXPECT_EQ(files, (std::vector<std::string>{"arm1-fault-5000.csv", "black_box/ecp-arm1.txt",
                                             "black_box/edp-arm1.txt", "black_box/mp.txt"}));
  const std::string ecp = text("black_box/ecp-arm1.txt");
  EXPECT_EQ(ecp.find("i=249 "), std::string::npos) << "older than five seconds";
  EXPECT_NE(ecp.find("i=251 m=3"), std::string::npos);
  EXPECT_NE(ecp.find("arm1.report  i=500 m=7"), std::string::npos) << ecp.substr(ecp.size() - 200);
  EXPECT_EQ(ecp.find("arm1.reply"), std::string::npos) << "that is the driver's";
  EXPECT_NE(text("black_box/edp-arm1.txt").find("arm1.reply  i=500"), std::string::npos);
}

TEST_F(BlackBox, OfALongLogItReadsTheEndAlone) {
  constexpr int kMacrosteps = 100'000;  // 33 minutes, 130 MB
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1);
    bus.subscribe_all("s.", log);
    link::Outbox<effector_reply_t> reply(bus, {link::Group::agents, "s.arm1.reply"}, 1);
    for (int i = 1; i <= kMacrosteps; ++i) {
      effector_reply_t r{};
      r.step = 10 * i;
      reply.publish(r, i);
    }
    ASSERT_TRUE(log.flush());
  }
  ASSERT_GT(fs::file_size(folder_ / "events.lcmlog"), 100'000'000U);
  const pid_t child = ::fork();
  if (child == 0) {
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    write_black_box(folder_, {"edp-arm1"});
    ::getrusage(RUSAGE_SELF, &after);
    ::_exit(static_cast<int>(std::min(255L, (after.ru_maxrss - before.ru_maxrss) / 1024)));
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_LT(WEXITSTATUS(status), kSanitizedFactor * 40) << "MB";
  const std::string lines = text("black_box/edp-arm1.txt");
  EXPECT_NE(lines.find("i=100000 "), std::string::npos);
  EXPECT_NE(lines.find("i=99751 "), std::string::npos) << "five seconds";
  EXPECT_EQ(lines.find("i=99700 "), std::string::npos);
}

TEST_F(BlackBox, OfALogThatEndedAtItsBoundItHasTheLastSecondsAllTheSame) {
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1, 100'000);
    bus.subscribe_all("s.", log);
    link::Outbox<effector_reply_t> reply(bus, {link::Group::agents, "s.arm1.reply"}, 1);
    for (int i = 1; i <= 200; ++i) {  // the bound is reached after some 75
      effector_reply_t r{};
      r.step = 10 * i;
      reply.publish(r, i);
    }
    ASSERT_TRUE(log.flush());
    log.write_tail(folder_ / link::kEventTail);
  }
  write_black_box(folder_, {"edp-arm1"});
  const std::string lines = text("black_box/edp-arm1.txt");
  for (const char* stamp : {"i=1 ", "i=70 ", "i=90 ", "i=200 "})
    EXPECT_NE(lines.find(stamp), std::string::npos) << stamp;
}

TEST_F(BlackBox, OfAMomentItHasWhatTheLogHeldThenBeforeAndBehindTheBound) {
  link::test::DirectBus bus;
  link::EventLog log(folder_ / "events.lcmlog", 1, 100'000);
  bus.subscribe_all("s.", log);
  link::Outbox<effector_reply_t> reply(bus, {link::Group::agents, "s.arm1.reply"}, 1);
  std::map<int, link::LogEnd> ends;
  for (int i = 1; i <= 9000; ++i) {  // the bound is reached after some 75, the tail's after some 3000
    effector_reply_t r{};
    r.step = 10 * i;
    reply.publish(r, i);
    if (i == 50 || i == 120 || i == 9000) ends[i] = log.end();
  }
  ASSERT_TRUE(log.flush());
  ASSERT_GT(log.left_out(), 0);
  for (const auto& [i, end] : ends) {
    write_black_box(folder_, {"edp-arm1"}, std::to_string(i), end);
    const std::string lines = text(fmt::format("black_box/{}/edp-arm1.txt", i));
    EXPECT_NE(lines.find(fmt::format("i={} ", i)), std::string::npos) << i;
    EXPECT_NE(lines.find(fmt::format("i={} ", std::max(1, i - 249))), std::string::npos) << i;
    EXPECT_EQ(lines.find(fmt::format("i={} ", i + 1)), std::string::npos) << "written later than " << i;
  }
}

TEST_F(BlackBox, OneOfARecoverableFaultHasAFolderOfItsOwn) {
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1);
    bus.subscribe_all("s.", log);
    link::Outbox<effector_reply_t>(bus, {link::Group::agents, "s.arm1.reply"}, 1).publish({}, 1);
    ASSERT_TRUE(log.flush());
  }
  write_black_box(folder_, {"edp-arm1"}, "edp-arm1-200");
  EXPECT_EQ(write_black_box(folder_, {"edp-arm1"}),
            (std::vector<std::string>{"black_box/edp-arm1-200/edp-arm1.txt", "black_box/edp-arm1.txt"}));
}

TEST_F(BlackBox, WithoutALogHasTheStepsThatDriversWrote) {
  std::ofstream(folder_ / "arm1-fault-7.csv") << "step\n";
  EXPECT_EQ(write_black_box(folder_, {"mp"}), std::vector<std::string>{"arm1-fault-7.csv"});
}

struct Sent {
  const char* channel;
  const char* message;
  const char* process;
};

TEST_F(BlackBox, KnowsWhoSendsWhat) {
  for (const auto& [channel, message, process] : {Sent{"arm1.command", "effector_command_t", "ecp-arm1"},
                                                  {"arm2.report", "agent_report_t", "ecp-arm2"},
                                                  {"arm1.order", "agent_order_t", "mp"},
                                                  {"arm1.arm2.word", "agent_order_t", ""},
                                                  {"arm1.pen_state.setting", "sensor_setting_t", ""},
                                                  {"hand.order", "hand_order_t", "mp"},
                                                  {"simulation.control", "simulation_control_t", "mp"},
                                                  {"hand.report", "hand_report_t", "simulator"},
                                                  {"cube.truth", "cube_truth_t", "simulator"},
                                                  {"sac.frame", "camera_frame_t", "simulator"},
                                                  {"arm1.samples", "step_samples_t", "edp-arm1"},
                                                  {"arm1.pen_state", "sensor_reading_t", "vsp-arm1"},
                                                  {"sac.cube_face", "cube_face_reading_t", "vsp-sac"},
                                                  {"vsp-cube.console", "console_t", "vsp-cube"},
                                                  {"supervisor", "supervisor_t", "mp"},
                                                  {"operator", "operator_order_t", ""},
                                                  {"manual.words", "manual_words_t", ""}})
    EXPECT_EQ(sender_of(channel, message), process) << channel;
}

TEST_F(BlackBox, ChannelsOfATaskThatItDoesNotKnowHaveASenderByTheKindOfTheirMessage) {
  for (const auto& [channel, message, process] : {Sent{"arm1.dance", "dance_order_t", "mp"},
                                                  {"dance.steps", "dance_answer_t", "mp"},
                                                  {"arm1.rhythm", "dance_report_t", "ecp-arm1"},
                                                  {"floor.step", "dance_reading_t", "vsp-floor"},
                                                  {"arm1.mood", "dance_t", ""},
                                                  {"arm1.mood", "", ""},
                                                  {"arm1.order", "", "mp"}})
    EXPECT_EQ(sender_of(channel, message), process) << channel;
}

TEST_F(BlackBox, ALineHasTimeChannelMacrostepAndWhatIsNotZero) {
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1);
    bus.subscribe_all("s.", log);
    link::Outbox<effector_reply_t> reply(bus, {link::Group::agents, "s.arm1.reply"}, 1);
    link::Outbox<agent_report_t> report(bus, {link::Group::agents, "s.arm1.report"}, 1);
    report.publish({}, 3);  // before the first reading of a driver
    effector_reply_t r{};
    r.step = 2500;
    reply.publish(r, 250);
    agent_report_t a{};
    a.m = 7;
    a.gripper = -0.0;
    report.publish(a, 251);
    const std::vector<std::uint8_t> strange(40, 7);
    bus.publish({link::Group::agents, "s.arm1.report"}, strange);
    r.step = 2400;  // a driver that is behind takes nothing back
    reply.publish(r, 251);
    ASSERT_TRUE(log.flush());
  }
  write_black_box(folder_, {"edp-arm1", "ecp-arm1"});
  EXPECT_EQ(text("black_box/edp-arm1.txt"),
            "# simulated time [s], channel, macrostep, fields that are not 0\n"
            "    5.000  arm1.reply  i=250 step=2500\n"
            "    5.000  arm1.reply  i=251 step=2400\n");
  const std::string ecp = text("black_box/ecp-arm1.txt");
  EXPECT_TRUE(
      ecp.starts_with("# simulated time [s], channel, macrostep, fields that are not 0\n"
                      "    0.000  arm1.report  i=3\n"
                      "    5.000  arm1.report  i=251 m=7\n"))
      << ecp;
}

TEST_F(BlackBox, APlatformsReplyTellsTheTimeToo) {
  {
    link::test::DirectBus bus;
    link::EventLog log(folder_ / "events.lcmlog", 1);
    bus.subscribe_all("s.", log);
    link::Outbox<platform_reply_t> reply(bus, {link::Group::agents, "s.rex.reply"}, 1);
    platform_reply_t r{};
    r.step = 1500;
    reply.publish(r, 150);
    ASSERT_TRUE(log.flush());
  }
  write_black_box(folder_, {"edp-rex"});
  EXPECT_TRUE(text("black_box/edp-rex.txt").ends_with("    3.000  rex.reply  i=150 step=1500\n"));
}

TEST_F(BlackBox, KnowsTheRestOfTheSendersToo) {
  for (const auto& [channel, message, process] : {Sent{"task_status", "task_status_t", "mp"},
                                                  {"answer", "operator_answer_t", "mp"},
                                                  {"operator.image", "operator_image_t", "mp"},
                                                  {"ecp-arm1.status", "process_status_t", "ecp-arm1"},
                                                  {"arm2.reply", "effector_reply_t", "edp-arm2"},
                                                  {"hand.command", "effector_command_t", "ecp-hand"},
                                                  {"rex.command", "platform_command_t", "ecp-rex"},
                                                  {"rex.reply", "platform_reply_t", "edp-rex"},
                                                  {"rex.telemetry", "platform_telemetry_t", "edp-rex"},
                                                  {"rex.motion_capture", "motion_capture_t", "simulator"},
                                                  {"rex.truth", "platform_truth_t", "simulator"},
                                                  {"rex.odometry", "odometry_reading_t", "vsp-rex"},
                                                  {"map.report", "agent_report_t", "ecp-map"},
                                                  {"map.rex.pose", "map_report_t", ""},
                                                  {"a.b.report", "agent_report_t", ""},
                                                  {"strange", "", ""}})
    EXPECT_EQ(sender_of(channel, message), process) << channel;
}

}  // namespace
}  // namespace mrroc::mp
