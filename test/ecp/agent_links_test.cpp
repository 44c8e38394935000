// The links of an agent without an effector: the coordinator's orders are its clock.
#include "ecp/agent_links.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/agent_images.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/agent_shell.hpp"
#include "test/base/link/answered_bus.hpp"
#include "test/base/link/led.hpp"
#include "test/base/link/one_by_one_bus.hpp"

namespace mrroc::ecp {
namespace {

using link::Phase;

class AgentLinksTest : public testing::Test {
 protected:
  void make(ClockKind clock, link::OtherLinks wanted = {},
            std::chrono::milliseconds timeout = std::chrono::seconds(20)) {
    link::NodeContext m;
    m.session = "links";
    m.name = "ecp-map";
    m.roster = {"mp", m.name};
    m.clock = clock;
    m.timeout = timeout;
    process.emplace(*own, m);
    estimate.emplace(*process, link::link_channel("rex", "map", "estimate"));
    pose.emplace(*process, link::link_channel("map", "rex", "pose"));
    wanted.incoming = {&*estimate};
    wanted.outgoing = {&*pose};
    links.emplace(*process, AgentLinkNames{.agent = "map", .n_s = 10, .others = std::move(wanted)});
    orders.emplace(*others, process->route("map.order"), 1);
    estimates.emplace(*others, process->route("rex.map.estimate"), 1);
    reports.emplace(*others, process->route("map.report"), 1);
    poses.emplace(*others, process->route("map.rex.pose"), 1);
    supervisor.emplace(*others, process->route("supervisor"), 1);
    say(Phase::running);
  }
  void say(Phase phase, std::int64_t as_of = 0) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    m.as_of = as_of;
    supervisor->publish(m, 0);
  }
  void order(std::int64_t i) { orders->publish(to_message(Order{.m = static_cast<int>(i)}), i); }
  void tell(std::int64_t i) {
    PlatformEstimate e;
    e.step = 10 * i;
    estimates->publish(to_message(e), i);
  }
  void all(std::int64_t i) {
    order(i);
    tell(i);
  }
  template <class M>
  std::vector<M> heard(link::Queue<M>& queue) {
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    std::vector<M> messages;
    while (const auto m = queue.take()) messages.push_back(*m);
    return messages;
  }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> own = std::make_unique<link::test::OneByOneBus>(hub.open()), others = hub.open();
  std::optional<link::Process> process;
  std::optional<link::IncomingLink<PlatformEstimate>> estimate;
  std::optional<link::OutgoingLink<MapReport>> pose;
  std::optional<AgentLinks> links;
  std::optional<link::Outbox<agent_order_t>> orders;
  std::optional<link::Outbox<platform_estimate_t>> estimates;
  std::optional<link::Outbox<supervisor_t>> supervisor;
  std::optional<link::Queue<agent_report_t>> reports;
  std::optional<link::Queue<map_report_t>> poses;
};

TEST_F(AgentLinksTest, EveryMacrostepHasItsOwnOrderAndEstimate) {
  make(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  for (std::int64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(links->i(), i);
    EXPECT_EQ(links->order().m, i);
    EXPECT_EQ(estimate->image().value.step, 10 * i);
    EXPECT_FALSE(estimate->image().late);
    MapReport report;
    report.rejected = static_cast<std::int32_t>(i);
    pose->set(report);
    links->send({.m = static_cast<int>(i)});
    all(i + 1);
    ASSERT_EQ(links->wait(), Outcome::terminated);
  }
  const auto told = heard(*reports);
  const auto said = heard(*poses);
  ASSERT_EQ(told.size(), 6U);
  ASSERT_EQ(said.size(), 6U);
  for (std::size_t k = 0; k < told.size(); ++k) {
    EXPECT_EQ(told[k].header.stamp, static_cast<std::int64_t>(k) + 1);
    EXPECT_EQ(told[k].m, static_cast<int>(k));
    EXPECT_EQ(said[k].header.stamp, static_cast<std::int64_t>(k) + 1);
    EXPECT_EQ(said[k].rejected, static_cast<int>(k));
  }
}

TEST_F(AgentLinksTest, WhereTheSystemEndsBeforeItHasBegunNothingIsSent) {
  make(ClockKind::step);
  all(1);
  say(Phase::finished);
  while (own->wait(std::chrono::milliseconds(0))) {
  }
  EXPECT_EQ(links->begin(), Outcome::aborted);
  EXPECT_TRUE(heard(*reports).empty());
  EXPECT_TRUE(heard(*poses).empty());
}

TEST_F(AgentLinksTest, InLockStepNothingGoesOnWithoutOneOfTheImages) {
  for (int missing = 0; missing < 3; ++missing) {
    link::OtherLinks others_wanted;
    others_wanted.here = [&](std::int64_t i, std::int64_t step) {
      return missing != 2 && step == 10 * (i - 1);
    };
    links.reset();
    pose.reset();
    estimate.reset();
    process.reset();
    own = std::make_unique<link::test::OneByOneBus>(hub.open());  // a bus knows its inboxes to its end
    make(ClockKind::step, others_wanted, std::chrono::milliseconds(50));
    if (missing != 0) order(1);
    if (missing != 1) tell(1);
    try {
      std::ignore = links->begin();
      ADD_FAILURE() << missing;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::peer_silent) << missing;
    }
  }
}

TEST_F(AgentLinksTest, TheFaultNamesTheChannelThatIsSilentOrBringsSomethingElse) {
  for (const std::string missing : {"map.order", "rex.map.estimate"})
    for (const bool other : {false, true}) {
      links.reset();
      pose.reset();
      estimate.reset();
      process.reset();
      own = std::make_unique<link::test::OneByOneBus>(hub.open());
      make(ClockKind::step, {}, std::chrono::milliseconds(100));
      if (missing == "map.order")
        tell(1);
      else
        order(1);
      link::Outbox<supervisor_t> stranger(*others, process->route(missing), 1);
      if (other) stranger.publish({}, 1);
      try {
        std::ignore = links->begin();
        ADD_FAILURE() << missing;
      } catch (const FaultError& e) {
        EXPECT_EQ(e.fault().code, other ? FaultCode::malformed_message : FaultCode::peer_silent) << missing;
        EXPECT_NE(e.fault().text.view().find(missing), std::string_view::npos) << e.fault().text.view();
      }
    }
}

TEST_F(AgentLinksTest, SensorsAreJudgedAtTheFirstStepOfTheMacrostepInWhichTheyWereRead) {
  std::vector<std::pair<std::int64_t, std::int64_t>> judged;
  link::OtherLinks wanted;
  wanted.here = [&](std::int64_t i, std::int64_t step) {
    judged.emplace_back(i, step);
    return true;
  };
  make(ClockKind::step, wanted);
  for (std::int64_t i = 1; i <= 3; ++i) all(i);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  ASSERT_FALSE(judged.empty());
  for (const auto& [i, step] : judged) EXPECT_EQ(step, 10 * (i - 1));
  EXPECT_EQ(judged.back().first, 3);
}

TEST_F(AgentLinksTest, WithTheWallClockTheNewestOrderSetsThePace) {
  make(ClockKind::wall);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  for (std::int64_t i = 2; i <= 7; ++i) order(i);
  tell(3);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 7);
  EXPECT_EQ(links->order().m, 7);
  EXPECT_EQ(estimate->image().value.step, 30);
  EXPECT_TRUE(estimate->image().late);
}

TEST_F(AgentLinksTest, AStopEndsItInTheAgreedMacrostep) {
  make(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  say(Phase::stopping, 3);
  all(2);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->wait(), Outcome::aborted) << "nobody gives orders any more";
}

TEST_F(AgentLinksTest, AnEndIsSaidToThoseWhoListen) {
  make(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  links->end();
  EXPECT_EQ(heard(*reports).back().ready, 1);
  EXPECT_EQ(heard(*poses).back().header.stamp, link::kEndOfLink);
}

struct Agent {
  struct X {
    None c;
    None e;
    MotionCapture V;
    Order T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  struct Y {
    None c;
    None e;
    None V;
    Report T;
  };
};

None nothing(const Agent::X&) { return {}; }
Report say_macrostep(const Agent::X& x) { return {.m = 1, .event = static_cast<int>(x.i)}; }
bool over(const Agent::X& x) { return x.T.finished; }

class AgentShell : public testing::Test, protected link::test::Led {
 protected:
  AgentShell() : Led("ecp-map") {}
  ~AgentShell() override { end(); }
};

TEST_F(AgentShell, RunsTheProgramUntilTheTaskIsFinished) {
  const auto orders = mp.outbox<agent_order_t>("map.order");
  const auto reports = mp.inbox<agent_report_t>("map.report");
  begin([](link::Process& process) {
    run_agent<Agent>(process, {.agent = "map"}, [](Agent::X& x, AgentPort<Agent>& port) {
      return move(Motion<Agent>{1, "locate", nothing, nothing, nothing, nothing, say_macrostep, over}, x,
                  port);
    });
  });
  ASSERT_TRUE(run());
  for (std::int64_t i = 1; i <= 8; ++i) {
    orders->publish(to_message(Order{.finished = i == 8}), i);
    ASSERT_TRUE(await([&] { return reports->at(i + 1) != nullptr; })) << i;
    if (i < 8) {
      EXPECT_EQ(reports->at(i + 1)->event, i);
    }
  }
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

TEST(AgentShellStays, UntilTheSystemHasEndedWhateverItHasDone) {
  link::MemoryHub hub;
  const std::unique_ptr<link::Bus> others = hub.open();
  std::function<void()> answer;
  link::test::AnsweredBus own(hub.open(), [&] { answer(); });
  link::NodeContext m;
  m.session = "stays";
  m.name = "ecp-map";
  m.roster = {"mp", m.name};
  link::Process process(own, m);
  link::Outbox<agent_order_t> orders(*others, process.route("map.order"), 1);
  link::Outbox<supervisor_t> supervisor(*others, process.route("supervisor"), 1);
  link::Queue<agent_report_t> reports(*others, process.route("map.report"), 1);
  link::Queue<process_status_t> status(*others, process.route("ecp-map.status"), 1);
  const auto say = [&](Phase phase) {
    supervisor_t word{};
    word.phase = static_cast<int>(phase);
    supervisor.publish(word, 0);
  };
  bool done = false;
  int waits = 0;  // after it was done
  answer = [&] {
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    while (const auto r = reports.take())
      orders.publish(to_message(Order{.finished = r->header.stamp > 3}), r->header.stamp);
    while (const auto s = status.take())
      done = done || s->state == static_cast<int>(link::ProcessState::done);
    if (done && ++waits == 3) say(Phase::finished);
  };
  say(Phase::running);
  run_agent<Agent>(process, {.agent = "map"}, [](Agent::X& x, AgentPort<Agent>& port) {
    return move(Motion<Agent>{1, "locate", nothing, nothing, nothing, nothing, say_macrostep, over}, x, port);
  });
  EXPECT_EQ(waits, 3) << "a peer may still need a message repeated";
}

}  // namespace
}  // namespace mrroc::ecp
