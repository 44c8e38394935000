// Three agents: the coordinator and two arms. The arms talk to each other without the coordinator (MS (9), (10), (14)).
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <thread>

#include "base/link/lossy_bus.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "ecp/effector_links.hpp"
#include "mp/coordinator_links.hpp"

namespace mrroc::mp {
namespace {

using link::Process;
using Value = SensorSetting;

constexpr std::int64_t kMacrosteps = 200;

struct Nobody final : OperatorAgent {
  void inform(std::int64_t, int) override {}
  [[nodiscard]] bool here(std::int64_t) const override { return true; }
  OperatorImage image(std::int64_t) override { return {}; }
};

/// What one agent has seen of another, by macrostep.
struct Seen {
  std::map<std::int64_t, Value> value;
  std::map<std::int64_t, bool> late;
};

/// A system of three agents and two drivers that only answer, each in a thread of its own.
class Peers {
 public:
  Peers(double lost, const link::Injection& injection) : lost_(lost), injection_(injection) {}

  /// Runs it to its end. @return whether all came to it
  bool run() {
    const auto bus = hub_.open();
    Process supervisor(*bus, context_of("mp"));
    link::Outbox<supervisor_t> word(*bus, supervisor.route("supervisor"), 1);
    std::vector<std::unique_ptr<link::Queue<process_status_t>>> status;
    std::map<std::string, link::ProcessState> state;
    for (const std::string& name : roster())
      status.push_back(
          std::make_unique<link::Queue<process_status_t>>(*bus, supervisor.route(name + ".status"), 1));
    link::Phase phase{};
    Process::Clock::time_point said{};
    // The word of a supervisor is repeated: packets are lost.
    const auto say = [&] {
      supervisor_t m{};
      m.phase = static_cast<int>(phase);
      word.publish(m, 0);
      said = Process::Clock::now();
    };
    supervisor.on_service = [&] {
      if (Process::Clock::now() >= said + std::chrono::milliseconds(20)) say();
      for (std::size_t k = 0; k < status.size(); ++k)
        while (const auto s = status[k]->take())
          state[roster()[k]] = static_cast<link::ProcessState>(s->state);
    };
    const auto all = [&](link::ProcessState wanted) {
      return supervisor.await(
          [&] {
            return std::ranges::all_of(roster(), [&](const auto& name) { return state[name] >= wanted; });
          },
          Process::Clock::now() + std::chrono::seconds(60));
    };
    std::vector<std::jthread> threads;
    const auto start = [&](const std::string& name, auto body) {
      threads.emplace_back([this, name, body] {
        const auto own = hub_.open();
        link::LossyBus lossy(*own, link::loses(lost_, std::hash<std::string>{}(name)));
        Process process(lossy, context_of(name));
        body(process);
      });
    };
    start("coordinator", [this](Process& p) { coordinate(p); });
    start("edp-arm1", [this](Process& p) { drive(p, "arm1"); });
    start("edp-arm2", [this](Process& p) { drive(p, "arm2"); });
    start("ecp-arm1", [this](Process& p) { control(p, "arm1", "arm2", 1, arm1); });
    start("ecp-arm2", [this](Process& p) { control(p, "arm2", "arm1", -1, arm2); });
    const bool ready = all(link::ProcessState::ready);
    phase = link::Phase::running;
    const bool done = ready && all(link::ProcessState::done);
    phase = link::Phase::finished;
    std::atomic<bool> ended{};
    std::jthread wait([&] {
      threads.clear();
      ended = true;
    });
    return supervisor.await([&] { return ended.load(); }, Process::Clock::now() + std::chrono::seconds(60)) &&
           done;
  }

  Seen arm1, arm2, coordinator;
  std::atomic<int> faults{};

  /// @return what an arm says in macrostep i: a function of what it has heard last
  static Value answer(std::int64_t i, double sign, const Value& heard) {
    return {.mode = static_cast<int>(i),
            .value = {sign * static_cast<double>(i), 0.5 * heard.value[1] + sign}};
  }

 private:
  static const std::vector<std::string>& roster() {
    static const std::vector<std::string> names{"coordinator", "edp-arm1", "edp-arm2", "ecp-arm1",
                                                "ecp-arm2"};
    return names;
  }
  static link::NodeContext context_of(const std::string& name) {
    link::NodeContext m;
    m.session = "peers";
    m.name = name;
    m.roster = {"mp"};
    m.roster.insert(m.roster.end(), roster().begin(), roster().end());
    return m;
  }

  /// While the links are still there.
  static void end(Process& p) {
    p.report_done();
    p.stay();
  }

  /// A driver that answers each command and does nothing.
  void drive(Process& p, const std::string& arm) {
    const auto commands = p.inbox<effector_command_t>(arm + ".command");
    const auto replies = p.outbox<effector_reply_t>(arm + ".reply");
    if (!p.assemble()) return;
    replies->publish(to_message(EffectorReply{}), 1);
    for (std::int64_t i = 1; i < kMacrosteps; ++i) {
      p.await([&] { return commands->at(i) || p.over(); });
      replies->publish(to_message(EffectorReply{}), i + 1);
    }
    end(p);
  }

  /// An arm: what it hears of its peer decides on what it says to it.
  void control(Process& p, const std::string& arm, const std::string& peer, double sign, Seen& seen) {
    link::OutgoingLink<Value> to_peer(p, link::link_channel(arm, peer, "word"));
    link::IncomingLink<Value> of_peer(p, link::link_channel(peer, arm, "word"), injection_);
    link::OutgoingLink<Value> to_mp(p, link::link_channel(arm, "mp", "word"));
    ecp::ArmLinks links(
        p, {.robot = arm, .sensor = "", .others = {.incoming = {&of_peer}, .outgoing = {&to_peer, &to_mp}}});
    Outcome o = links.begin();
    while (o == Outcome::terminated && links.i() < kMacrosteps) {
      const auto& [value, late] = of_peer.image();
      seen.value[links.i()] = value;
      seen.late[links.i()] = late;
      to_peer.set(answer(links.i(), sign, value));
      to_mp.set(value);
      links.send({}, {.m = static_cast<int>(links.i())});
      o = links.wait();
    }
    if (o != Outcome::terminated) ++faults;
    links.end();
    end(p);
  }

  void coordinate(Process& p) {
    Nobody nobody;
    link::IncomingLink<Value> of_arm1(p, link::link_channel("arm1", "mp", "word"));
    CoordinatorLinks links(p, {"arm1", "arm2"}, nobody, TaskClock::ramped(), {.incoming = {&of_arm1}});
    if (!p.assemble()) return;
    const std::array<Order, 2> orders{};
    Outcome o = links.begin({});
    while (o == Outcome::terminated && links.i() < kMacrosteps) {
      coordinator.value[links.i()] = of_arm1.image().value;
      links.send(orders);
      o = links.wait();
    }
    if (o != Outcome::terminated) ++faults;
    links.send(std::array{Order{.finished = true}, Order{.finished = true}});
    end(p);
  }

  double lost_;
  link::Injection injection_;
  link::MemoryHub hub_;
};

/// @return what both arms see when nothing runs but their functions, in this thread
std::array<Seen, 2> model(const link::Injection& injection) {
  std::array<Seen, 2> seen;
  std::array<std::map<std::int64_t, Value>, 2> said;
  said[0][1] = said[1][1] = Value{};
  std::array<std::int64_t, 2> newest{};
  for (std::int64_t i = 1; i < kMacrosteps; ++i)
    for (std::size_t arm = 0; arm < 2; ++arm) {
      for (std::int64_t sent = std::max<std::int64_t>(1, i - link::Injection::kMaxDelay); sent <= i; ++sent) {
        const auto fate = injection.fate(sent);
        if (fate.copies > 0 && sent + fate.delay <= i) newest[arm] = std::max(newest[arm], sent);
      }
      const Value heard = newest[arm] > 0 ? said[1 - arm][newest[arm]] : Value{};
      seen[arm].value[i] = heard;
      seen[arm].late[i] = newest[arm] < i;
      said[arm][i + 1] = Peers::answer(i, arm == 0 ? 1 : -1, heard);
    }
  return seen;
}

void expect_as_modelled(Peers& peers, const link::Injection& injection) {
  ASSERT_TRUE(peers.run());
  EXPECT_EQ(peers.faults, 0);
  const auto expected = model(injection);
  EXPECT_EQ(peers.arm1.value, expected[0].value);
  EXPECT_EQ(peers.arm2.value, expected[1].value);
  EXPECT_EQ(peers.arm1.late, expected[0].late);
  EXPECT_EQ(peers.arm2.late, expected[1].late);
}

TEST(PeerLinks, TwoArmsTalkToEachOtherInLockStepOneMacrostepLater) {
  Peers peers(0, {});
  expect_as_modelled(peers, {});
  for (std::int64_t i = 2; i < kMacrosteps; ++i) {
    ASSERT_EQ(peers.arm2.value.at(i).mode, i - 1) << "decided in the macrostep before";
    ASSERT_EQ(peers.arm2.value.at(i).value[0], static_cast<double>(i - 1));
  }
}

TEST(PeerLinks, TheCoordinatorMayHaveATypedLinkToo) {
  Peers peers(0, {});
  ASSERT_TRUE(peers.run());
  for (std::int64_t i = 2; i < kMacrosteps; ++i)
    ASSERT_EQ(peers.coordinator.value.at(i), peers.arm1.value.at(i - 1)) << i;
}

TEST(PeerLinks, LostPacketsAreRepeatedAndChangeNothing) {
  Peers peers(0.004, {});
  expect_as_modelled(peers, {});
}

TEST(PeerLinks, InjectedLossAndDelayOfOneLinkAreTheSameInEveryRun) {
  const link::Injection injection{.loss = 0.2, .duplication = 0.1, .delay = 0.2, .max_delay = 3, .seed = 5};
  for (const double lost : {0.0, 0.004}) {
    Peers peers(lost, injection);
    expect_as_modelled(peers, injection);
    EXPECT_GT(std::ranges::count_if(peers.arm1.late, [](const auto& l) { return l.second; }),
              kMacrosteps / 10);
  }
}

}  // namespace
}  // namespace mrroc::mp
