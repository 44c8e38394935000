// What terminals are told of the agents: each says its behaviour itself, at any moment, and the board passes it on.
#include "mp/status_board.hpp"

#include <gtest/gtest.h>

#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"

namespace mrroc::mp {
namespace {

/// MP and the ECP of arm1, in one thread.
struct System {
  static link::Membership member(const std::string& name) {
    return {.session = "test", .session_id = 1, .name = name, .roster = {"mp", "ecp-arm1"}};
  }
  task_status_t told() {
    while (mp_bus->wait(std::chrono::milliseconds(0))) {
    }
    supervisor.poll();
    board.poll();
    while (terminal->wait(std::chrono::milliseconds(0))) {
    }
    return *statuses.newest();
  }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> mp_bus{hub.open()}, ecp_bus{hub.open()}, terminal{hub.open()};
  link::Process mp{*mp_bus, member("mp")}, ecp{*ecp_bus, member("ecp-arm1")};
  Supervisor supervisor{mp, {Part{"ecp-arm1", {}, {}, {}, {}}}, "/dev/null"};
  StatusBoard board{mp, supervisor, "press", {"arm1", "arm2"}, "/runs/press"};
  link::Inbox<task_status_t> statuses{*terminal, {link::Group::agents, "test.task_status"}, 1};
};

TEST(StatusBoard, TellsTheBehaviourOfEveryAgentAndWhyTheOneBeforeEnded) {
  System s;
  s.ecp.in_behaviour(1, "approach", "F_z above 3.6 N");
  task_status_t m = s.told();
  EXPECT_EQ(m.agent_m[0], 1);
  EXPECT_EQ(link::get_text(m.agent_behaviour[0]), "approach");
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "");
  EXPECT_EQ(link::get_text(m.agent_behaviour[1]), "") << "arm2 has told none";
  s.ecp.report_progress(62, 0);
  s.ecp.in_behaviour(2, "settle");
  m = s.told();  // at once, not with the next period
  EXPECT_EQ(m.agent_m[0], 2);
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "approach: F_z above 3.6 N");
  s.ecp.report_progress(100, 0);
  s.ecp.in_behaviour(0, "done");
  m = s.told();
  EXPECT_EQ(link::get_text(m.agent_behaviour[0]), "done");
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "settle, ended after 38 macrosteps");
}

TEST(StatusBoard, SaysWhyTheCoordinatorsBehaviourEndedOrHowLongItLasted) {
  System s;
  s.board.set_time(10, 0.2);
  s.board.set_behaviour(0, "wait for start", "start given");
  EXPECT_EQ(link::get_text(s.told().ended_because), "");
  s.board.set_behaviour(1, "approach", "");
  EXPECT_EQ(link::get_text(s.told().ended_because), "wait for start: start given");
  s.board.set_time(85, 1.7);
  s.board.set_behaviour(1, "approach", "");
  s.board.set_behaviour(2, "settle", "");
  EXPECT_EQ(link::get_text(s.told().ended_because), "approach, ended after 1.50 s");
}

}  // namespace
}  // namespace mrroc::mp
