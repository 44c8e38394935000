// The whole chain MP - ECP - EDP - world with the real shells and links and an ideal arm: delay accounting of
// MG (11)-(15), the end of a run, and injected faults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/msg/convert.hpp"
#include "ecp/shell.hpp"
#include "edp/shell.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/supervisor.hpp"
#include "mrroc/world_state_t.hpp"
#include "tasks/drawing/tables.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::mp {
namespace {

using drawing::Arm;
using link::Group;
using link::Process;

constexpr int kSteps = 10;  // n_s

/// An operator who says nothing.
struct Nobody final : OperatorAgent {
  void inform(std::int64_t, int, bool) override {}
  [[nodiscard]] bool here(std::int64_t) const override { return true; }
  OperatorImage image(std::int64_t) override { return {}; }
};

/// One arm and everything that belongs to it, MP in this thread.
class Chain {
 public:
  explicit Chain(const link::Injection& injection = {})
      : injection_(injection),
        messages_(
            (std::filesystem::temp_directory_path() / ("delay_test." + std::to_string(::getpid()))).string()),
        bus_(hub_.open()),
        mp(*bus_, member()),
        links(mp, {"arm1"}, nobody_),
        commands(*bus_, mp.route("arm1.command"), 1),
        replies(*bus_, mp.route("arm1.reply"), 1),
        supervisor(mp, parts(), messages_) {
    supervisor.start_threads(hub_);
  }
  ~Chain() { std::filesystem::remove(messages_); }

  /// Runs so many macrosteps of MP; velocity(i) is what MP orders along x in its macrostep i [m/s].
  /// @return outcome of the last one
  Outcome run(int macrosteps, const std::function<double(std::int64_t)>& velocity,
              const std::function<void(std::int64_t, const Report&)>& see) {
    EXPECT_TRUE(mp.assemble());
    Order order;
    Outcome o = links.begin(order);
    while (o == Outcome::terminated && links.i() < macrosteps) {
      see(links.i(), links.report(0));
      order.arm.frame.x = u(velocity(links.i()));
      links.send(std::span(&order, 1));
      o = links.wait();
    }
    if (o == Outcome::terminated) {
      order.finished = true;
      // As the simulated world does: the driver ends in the second macrostep after the release.
      end_ = (links.i() + 1 + 3) * kSteps;
      links.send(std::span(&order, 1));
    } else {
      supervisor.stop(o == Outcome::faulted ? links.fault() : Fault{.code = FaultCode::internal_error}, 0);
    }
    mp.report_done();
    supervisor.end();
    return o;
  }

 private:
  static link::Membership member() {
    link::Membership m;
    m.session = "chain";
    m.name = "mp";
    m.roster = {"mp", "world", "edp-arm1", "ecp-arm1"};
    return m;
  }
  std::vector<Part> parts() {
    return {{"world", {}, {}, [this](Process& p) { run_world(p); }},
            {"edp-arm1",
             {},
             {},
             [this](Process& p) {
               edp::ShellParameters k{.robot = "arm1", .ecp = "ecp-arm1"};
               k.injection = injection_;
               k.start_guard = std::chrono::milliseconds(0);
               edp::run_edp(p, rig_.driver, k);
             }},
            {"ecp-arm1", {}, {}, [](Process& p) {
               ecp::run_ecp<Arm>(p, {.robot = "arm1", .sensor = ""}, {.model = {}, .settling_macrosteps = 2},
                                 [](Arm::X& x, auto& port) { return move(drawing::kTransparent, x, port); });
             }}};
  }
  void run_world(Process& p) {
    const auto out = p.outbox<world_state_t>("world.state", Group::servo_state);
    const auto in = p.inbox<drive_command_t>("arm1.drive", Group::servo_command);
    if (!p.assemble()) return;
    const double x_0 = rig_.world.T_0E().p.x();
    int over = 0;
    for (std::int64_t step = 0; step < end_; ++step) {
      world_state_t state{};
      state.robot[0] = to_message(rig_.world.reading());
      out->publish(state, step);
      p.await([&] { return in->at(step) || p.phase() == link::Phase::finished; });
      if (!in->at(step)) break;
      rig_.world.apply(from_message(*in->at(step)));
      if (first_motion < 0 && std::abs(rig_.world.T_0E().p.x() - x_0) > 1e-6) first_motion = step;
      if (p.over() && ++over == 100) p.report_rest(true, {100, -1, -1, -1});
    }
    p.report_done();
    p.stay();
  }

  link::Injection injection_;
  std::filesystem::path messages_;
  edp::test::Rig rig_;
  std::atomic<std::int64_t> end_{1'000'000'000};  // step in which the world ends
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  Nobody nobody_;

 public:
  Process mp;
  CoordinatorLinks links;
  link::Queue<effector_command_t> commands;
  link::Queue<effector_reply_t> replies;
  std::atomic<std::int64_t> first_motion{-1};  ///< step of the world
  Supervisor supervisor;
};

TEST(DelayAccounting, OrderCommandExecutionAndStateAreOneTwoTwoAndFourMacrostepsApart) {
  constexpr std::int64_t kOrdered = 20;  // macrostep in which MP decides to move
  std::int64_t ordered_by_state = 0;     // first macrostep in which MP could answer to the motion
  Chain chain;
  std::optional<double> x_0;
  const Outcome o = chain.run(
      40, [](std::int64_t i) { return i == kOrdered ? 0.05 : 0.0; },
      [&](std::int64_t i, const Report& r) {
        if (i < kOrdered) x_0 = r.T_0E[0];
        if (ordered_by_state == 0 && i >= kOrdered && std::abs(r.T_0E[0] - *x_0) > 1e-6) ordered_by_state = i;
      });
  ASSERT_EQ(o, Outcome::terminated);
  std::int64_t executed_in = 0;  // stamp of the command = macrostep of its execution
  while (const auto c = chain.commands.take())
    if (c->arm.axis[0].velocity != 0) {
      EXPECT_EQ(executed_in, 0) << "the order was copied twice";
      executed_in = c->header.stamp;
    }
  const std::int64_t commanded_in = executed_in - 1;
  EXPECT_EQ(commanded_in - kOrdered, 1);                // MG (11): MP's output -> ECP's command
  EXPECT_EQ(executed_in - kOrdered, 2);                 // (12): -> motion
  EXPECT_EQ(chain.first_motion / kSteps, executed_in);  // and that is what the arm does
  EXPECT_EQ(ordered_by_state - executed_in, 2);         // effector's state -> MP's output
  EXPECT_EQ(ordered_by_state - kOrdered, 4);            // (15): the whole loop
}

TEST(Chain, RunsAreBitIdentical) {
  std::optional<std::uint64_t> first;
  for (int k = 0; k < 5; ++k) {
    Chain chain;
    ASSERT_EQ(
        chain.run(
            30, [](std::int64_t i) { return 0.001 * static_cast<double>(i % 7); }, [](auto, const auto&) {}),
        Outcome::terminated);
    EXPECT_FALSE(chain.supervisor.fault());
    EXPECT_NE(chain.supervisor.log_hash(), 0U);
    if (!first) first = chain.supervisor.log_hash();
    EXPECT_EQ(chain.supervisor.log_hash(), *first);
  }
}

TEST(Chain, InjectedFaultsNeverChangeTheOrderOfCommandsNorHinderTheEnd) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Chain chain({.loss = 0.01, .duplication = 0.02, .delay = 0.01, .max_delay = 3, .seed = seed});
    const Outcome o = chain.run(
        300, [](std::int64_t i) { return i % 2 ? 0.002 : -0.002; }, [](auto, const auto&) {});
    ASSERT_EQ(o, Outcome::terminated) << "seed " << seed;
    EXPECT_FALSE(chain.supervisor.fault());
    std::int64_t last = 0, executed = 0, not_executed = 0;
    while (const auto r = chain.replies.take()) {
      if (static_cast<Verdict>(r->verdict) != Verdict::executed) {
        ++not_executed;
        continue;
      }
      EXPECT_TRUE(r->number == last || r->number == last + 1) << r->number << " after " << last;
      last = r->number;
      ++executed;
    }
    EXPECT_GT(executed, 250);
    EXPECT_GT(not_executed, 0);
  }
}

TEST(Chain, ALinkThatLosesEverythingEndsInASystemError) {
  Chain chain({.loss = 1});
  EXPECT_NE(chain.run(
                100, [](auto) { return 0; }, [](auto, const auto&) {}),
            Outcome::terminated);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->code, FaultCode::command_repeated_refused);
}

TEST(Chain, AnArmThatCannotDoWhatItIsToldEndsTheTaskWithItsReason) {
  Chain chain;
  EXPECT_EQ(chain.run(
                100, [](std::int64_t i) { return i > 20 ? std::nan("") : 0.0; }, [](auto, const auto&) {}),
            Outcome::faulted);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->code, FaultCode::not_finite);
}

}  // namespace
}  // namespace mrroc::mp
