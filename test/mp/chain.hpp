// The whole chain MP - ECP - EDP - simulator with the real shells and links and an ideal arm, in one process.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

#include "base/clock.hpp"
#include "base/msg/convert.hpp"
#include "ecp/shell.hpp"
#include "edp/shell.hpp"
#include "edp/simulated_hardware.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/supervisor.hpp"
#include "tasks/drawing/tables.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::mp::test {

using drawing::Arm;
using link::Group;
using link::Process;

inline constexpr int kSteps = 10;  // n_s

/// An operator who says nothing.
struct Nobody final : OperatorAgent {
  void inform(std::int64_t, int) override {}
  [[nodiscard]] bool here(std::int64_t) const override { return true; }
  OperatorImage image(std::int64_t) override { return {}; }
};

/// One arm and everything that belongs to it, MP in this thread.
class Chain {
 public:
  explicit Chain(const link::Injection& injection = {}, ClockKind clock = ClockKind::step)
      : injection_(injection),
        clock_(clock),
        messages_(
            (std::filesystem::temp_directory_path() / ("delay_test." + std::to_string(::getpid()))).string()),
        bus_(hub_.open()),
        mp(*bus_, context_of(clock)),
        links(mp, {"arm1"}, nobody_),
        commands(*bus_, mp.route("arm1.command"), 1),
        replies(*bus_, mp.route("arm1.reply"), 1),
        supervisor(mp, node_specs(), messages_) {}
  ~Chain() { std::filesystem::remove(messages_); }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  /// A member that is interrupted, and for how long; set them before run().
  std::string rests;
  std::chrono::milliseconds rest_for{};
  bool fails{};            ///< it ends with a fault instead
  int state_timeout{250};  ///< of the driver [steps]

  /// The interruption begins; there is only one.
  void interrupt() {
    if (!interrupted_.exchange(true)) resting_ = true;
  }
  /// @return what the driver's protocol has seen; after run()
  [[nodiscard]] const edp::Protocol& protocol() const { return rig_.driver.protocol(); }
  /// @return all lines of all processes so far
  [[nodiscard]] std::string lines() const {
    std::ifstream in(messages_);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// Runs so many macrosteps of MP; velocity(i) is what MP orders along x in its macrostep i [m/s].
  /// @return outcome of the last one
  Outcome run(int macrosteps, const std::function<double(std::int64_t)>& velocity,
              const std::function<void(std::int64_t, const Report&)>& see) {
    supervisor.start_threads(hub_);
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
      // As the simulator does: the driver ends in the second macrostep after the release.
      end_ = (links.i() + 1 + 3) * kSteps;
      links.send(std::span(&order, 1));
    } else {
      supervisor.stop(o == Outcome::faulted ? links.fault() : Fault{.code = FaultCode::internal_error}, 0);
    }
    if (fails)
      mp.await([&] { return mp.dead(rests) && steps_over_ >= kOver; },
               Process::Clock::now() + std::chrono::seconds(10));
    mp.report_done();
    supervisor.end();
    return o;
  }

 private:
  static link::NodeContext context_of(ClockKind clock) {
    link::NodeContext m;
    m.session = "chain";
    m.name = "mp";
    m.roster = {"mp", "simulator", "edp-arm1", "ecp-arm1"};
    m.clock = clock;
    return m;
  }
  std::vector<NodeSpec> node_specs() {
    return {{"simulator", {}, {}, [this](Process& p) { run_simulator(p); }},
            {"edp-arm1",
             {},
             {},
             [this](Process& p) {
               p.on_service = [this] { rest("edp-arm1"); };
               edp::ShellParameters k{.robot = "arm1", .ecp = "ecp-arm1"};
               k.injection = injection_;
               k.start_guard = std::chrono::milliseconds(0);
               k.state_timeout = state_timeout;
               edp::run_edp(p, rig_.driver, edp::SimulatedHardware(p, "arm1", "simulator", 0.002), k);
             }},
            {"ecp-arm1", {}, {}, [this](Process& p) {
               p.on_service = [this] { rest("ecp-arm1"); };
               ecp::run_ecp<Arm>(p, {.robot = "arm1", .sensor = ""}, {.model = {}, .settling_macrosteps = 2},
                                 [](Arm::X& x, auto& port) { return move(drawing::kTransparent, x, port); });
             }}};
  }
  void run_simulator(Process& p) {
    p.on_service = [this] { rest("simulator"); };
    const auto out = p.outbox<hardware_state_t>("arm1.hardware_state", Group::servo_state);
    const auto in = p.inbox<hardware_command_t>("arm1.hardware_command", Group::servo_command);
    if (!p.assemble()) return;
    const double x_0 = rig_.world.T_0E().p.x();
    const bool wall = clock_ == ClockKind::wall;
    Pacer pacer(0.002, std::chrono::milliseconds(10));
    pacer.begin(Process::Clock::now());
    int missed = 0;
    for (std::int64_t step = 0; step < end_ || (wall && missed < kLeft); ++step) {
      if (p.phase() == link::Phase::finished) break;
      const auto due = wall ? pacer.next(1, Process::Clock::now()) : Process::Clock::time_point::max();
      out->publish(to_message(rig_.world.reading()), step);
      p.await([&] { return in->at(step) || p.phase() == link::Phase::finished; }, due);
      if (!in->at(step) && !wall) break;
      missed = in->at(step) ? 0 : missed + 1;
      HardwareCommand command = in->at(step) ? from_message(*in->at(step)) : HardwareCommand{};
      rig_.world.apply(command);
      if (first_motion < 0 && std::abs(rig_.world.T_0E().p.x() - x_0) > 1e-6) first_motion = step;
      if (p.over()) ++steps_over_;
      if (wall) p.await([] { return false; }, due);
    }
    p.report_done();
    p.stay();
  }

  /// Says nothing and hears nothing for a while, once, when it is told to.
  void rest(const std::string& node) {
    if (node != rests || !resting_.exchange(false)) return;
    if (fails) throw FaultError(FaultCode::internal_error, "told to fail");
    std::this_thread::sleep_for(rest_for);
  }

  static constexpr int kLeft = 100;  // steps
  static constexpr int kOver = 100;  // steps after the stop that the test waits for
  link::Injection injection_;
  ClockKind clock_;
  std::atomic<bool> interrupted_{false};
  std::atomic<bool> resting_{false};
  std::atomic<int> steps_over_{};
  std::filesystem::path messages_;
  edp::test::Rig rig_;
  std::atomic<std::int64_t> end_{1'000'000'000};  // step in which the simulator ends
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  Nobody nobody_;

 public:
  Process mp;
  CoordinatorLinks links;
  link::Queue<effector_command_t> commands;
  link::Queue<effector_reply_t> replies;
  std::atomic<std::int64_t> first_motion{-1};  ///< step of the simulator
  Supervisor supervisor;
};

}  // namespace mrroc::mp::test
