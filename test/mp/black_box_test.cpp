// The last seconds of every process, out of the log of a run.
#include "mp/black_box.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "base/link/channel.hpp"
#include "base/link/event_log.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

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

TEST_F(BlackBox, OneOfAFaultThatWasSurvivedHasAFolderOfItsOwn) {
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

TEST_F(BlackBox, KnowsWhoSendsWhat) {
  for (const auto& [channel, process] : {std::pair{"arm1.command", "ecp-arm1"},
                                         {"arm2.report", "ecp-arm2"},
                                         {"arm1.order", "mp"},
                                         {"arm1.manual", "mp"},
                                         {"hand.order", "mp"},
                                         {"hand.report", "world"},
                                         {"cube.truth", "world"},
                                         {"sac.frame", "world"},
                                         {"arm1.samples", "edp-arm1"},
                                         {"arm1.pen_state", "vsp-arm1"},
                                         {"vsp-cube.console", "vsp-cube"},
                                         {"supervisor", "mp"},
                                         {"operator", ""},
                                         {"manual.words", ""}})
    EXPECT_EQ(sender_of(channel), process) << channel;
}

}  // namespace
}  // namespace mrroc::mp
