// n_s and n_Q belong to the command (MG 7): the real driver shell and the real simulator, in lock-step, with macrosteps of
// any length, and of different lengths for the robots of one system.
#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "base/latency.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "edp/shell.hpp"
#include "edp/simulated_hardware.hpp"
#include "mrroc/simulation_control_t.hpp"
#include "mrroc/step_samples_t.hpp"
#include "robots/irb6/arm.hpp"
#include "robots/irb6/robot_type.hpp"
#include "sim/shell/shell.hpp"

namespace mrroc::sim {
namespace {

using link::Process;

constexpr std::int64_t kSession = 1;
constexpr int kWithoutCommand = 10;  // steps of a macrostep without a command
/// A command is decided when the replies of so many macrosteps before are there.
constexpr std::int64_t kLoop = latency::kOrderToCommand + latency::kCommandToReply;
constexpr auto kTimeout = std::chrono::seconds(60);
constexpr auto kSaidAgain = std::chrono::milliseconds(100);  // the supervisor's word

std::string arm_name(std::size_t arm) { return "arm" + std::to_string(arm + 1); }

link::NodeContext context_of(const std::string& name, std::size_t arms) {
  link::NodeContext m;
  m.session = "lengths";
  m.session_id = kSession;
  m.name = name;
  m.roster = {"mp", "simulator"};
  for (std::size_t arm = 0; arm < arms; ++arm) m.roster.push_back("edp-" + arm_name(arm));
  for (std::size_t arm = 0; arm < arms; ++arm) m.roster.push_back("ecp-" + arm_name(arm));
  m.timeout = kTimeout;
  return m;
}

/// A simulator and a driver per arm as threads; the test is MP and all ECPs.
class System {
 public:
  System(std::size_t arms, std::uint64_t seed)
      : random_(seed), bus_(hub_.open()), mp_(*bus_, context_of("mp", arms)), arms_(arms) {
    supervisor_.emplace(*bus_, mp_.route("supervisor"), kSession);
    control_ = mp_.outbox<simulation_control_t>("simulation.control");
    statuses_.push_back(
        std::make_unique<link::Queue<process_status_t>>(*bus_, mp_.route("simulator.status"), kSession));
    parameters_.arms.assign(arms, arm_parameters(irb6::postument()));
    for (std::size_t k = 0; k < arms; ++k) {
      Arm& arm = arms_[k];
      const std::string name = arm_name(k);
      arm.commands = mp_.outbox<effector_command_t>(name + ".command");
      arm.replies = mp_.inbox<effector_reply_t>(name + ".reply");
      arm.samples =
          std::make_unique<link::Queue<step_samples_t>>(*bus_, mp_.route(name + ".samples"), kSession);
      statuses_.push_back(std::make_unique<link::Queue<process_status_t>>(
          *bus_, mp_.route("edp-" + name + ".status"), kSession));
      parameters_.arms[k].T_UB.p.y() = 3.0 * static_cast<double>(k);
    }
    states_.resize(statuses_.size());
    mp_.on_service = [this] { hear(); };
    threads_.emplace_back([this] { simulate(); });
    for (std::size_t k = 0; k < arms; ++k) threads_.emplace_back([this, k] { drive(k); });
    EXPECT_TRUE(await([this] { return all(link::ProcessState::ready); }));
    say(link::Phase::running);
  }
  ~System() {
    say(link::Phase::finished);
    while (ended_ < threads_.size()) await([this] { return ended_ == threads_.size(); });
  }
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Commands so many macrosteps of random length, then releases. Each arm has lengths of its own.
  void run(std::int64_t macrosteps) {
    last_ = macrosteps + 1;  // that of the release
    for (std::int64_t i = 1; i <= kLoop && !testing::Test::HasFatalFailure(); ++i) send(i);
    for (std::int64_t i = 1; i <= last_ + 2 && !testing::Test::HasFatalFailure(); ++i) {
      ASSERT_TRUE(await([&] { return replied(i) || faulted(); })) << "deadlock in macrostep " << i;
      ASSERT_FALSE(faulted()) << fault_;
      for (Arm& arm : arms_) check(arm, *arm.replies->at(i), i);
      if (testing::Test::HasFatalFailure()) return;
      send(i + kLoop);
    }
    ASSERT_TRUE(await([this] { return all(link::ProcessState::done) || faulted(); })) << "who does not end?";
    ASSERT_FALSE(faulted()) << fault_;
    for (const Arm& arm : arms_) EXPECT_EQ(arm.sampled, arm.replied + 1) << "the last reply has all samples";
  }

  /// @return steps that all arms were commanded to make
  [[nodiscard]] std::int64_t steps() const { return arms_[0].begins; }

 private:
  struct Length {
    int n_s{}, n_Q{};
    [[nodiscard]] int steps() const { return std::max(n_s, n_Q); }
  };
  struct Arm {
    std::unique_ptr<link::Outbox<effector_command_t>> commands;
    std::unique_ptr<link::Inbox<effector_reply_t>> replies;
    std::unique_ptr<link::Queue<step_samples_t>> samples;
    std::map<std::int64_t, Length> length;  // of commanded macrosteps
    std::int64_t begins{};                  // step in which the macrostep of the next reply begins
    std::int64_t replied{-1};               // step of the last reply
    std::int64_t sampled{};                 // first step of which no sample has come
  };

  void send(std::int64_t i) {
    if (i > last_) return;
    simulation_control_t control{};
    control.finished = i == last_ - 1;
    if (i < last_) control_->publish(control, i);
    for (Arm& arm : arms_) arm.commands->publish(to_message(command(arm, i)), i);
  }

  EffectorCommand command(Arm& arm, std::int64_t i) {
    EffectorCommand c;
    c.session = 7;
    c.number = i;
    c.instruction = i == 1 ? Instruction::synchro : i == last_ ? Instruction::release : Instruction::set;
    if (c.instruction != Instruction::set) return c;
    Length& length = arm.length[i];
    length.n_s = std::uniform_int_distribution<int>(2, 64)(random_);
    length.n_Q = length.n_s + (std::bernoulli_distribution(0.5)(random_) ? 1 : -1);
    c.set = Part::arm | Part{};
    c.arm.n_s = static_cast<std::uint16_t>(length.n_s);
    c.arm.n_Q = static_cast<std::uint16_t>(length.n_Q);
    c.arm.frame.z = u(i % 2 == 0 ? 0.002 : -0.002);
    return c;
  }

  /// Every reply comes in step n_Q of its macrostep and with the samples of all steps since the one before.
  void check(Arm& arm, const effector_reply_t& reply, std::int64_t i) {
    const std::int64_t macrostep = i - 1;
    const auto commanded = arm.length.find(macrostep);
    const Length length =
        commanded != arm.length.end() ? commanded->second : Length{kWithoutCommand, kWithoutCommand - 1};
    if (macrostep > 0) {
      ASSERT_NE(reply.verdict, static_cast<int>(Verdict::refused)) << macrostep;
    }
    // Robots that wait for others do that in whole macrosteps without a command.
    const std::int64_t late = reply.step - (arm.begins + length.n_Q - 1);
    ASSERT_EQ(late % kWithoutCommand, 0) << "macrostep " << macrostep;
    ASSERT_GE(late, 0);
    if (arms_.size() == 1) {
      ASSERT_EQ(late, 0) << "one robot waits for nobody";
    }
    arm.begins += late + length.steps();
    arm.replied = reply.step;
    ASSERT_TRUE(await([&] { return take_samples(arm) >= i || faulted(); }))
        << "lost samples of " << macrostep;
  }

  /// @return newest macrostep all samples of which have come; they follow one another without a gap
  std::int64_t take_samples(Arm& arm) {
    while (const auto m = arm.samples->take()) {
      EXPECT_EQ(m->step - m->n + 1, arm.sampled) << "macrostep " << m->macrostep;
      arm.sampled = m->step + 1;
      if (m->more == 0) whole_[&arm] = m->macrostep;
    }
    return whole_[&arm];
  }

  [[nodiscard]] bool replied(std::int64_t i) const {
    return std::ranges::all_of(arms_, [&](const Arm& arm) { return arm.replies->at(i) != nullptr; });
  }
  template <class Ready>
  bool await(Ready ready) {
    return mp_.await(ready, Process::Clock::now() + kTimeout);
  }
  void say(link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    said_ = phase;
    said_at_ = Process::Clock::now();
    supervisor_->publish(m, 0);
  }
  void hear() {
    if (Process::Clock::now() - said_at_ > kSaidAgain) say(said_);
    for (std::size_t k = 0; k < statuses_.size(); ++k)
      while (const auto s = statuses_[k]->take()) {
        states_[k] = static_cast<link::ProcessState>(s->state);
        if (states_[k] == link::ProcessState::faulted) fault_ = describe(from_message(s->fault));
      }
  }
  [[nodiscard]] bool all(link::ProcessState least) const {
    return std::ranges::all_of(states_, [&](link::ProcessState s) { return s >= least; });
  }
  [[nodiscard]] bool faulted() const { return !fault_.empty(); }

  template <class Body>
  void part(const std::string& name, Body body) {
    const auto bus = hub_.open();
    Process process(*bus, context_of(name, arms_.size()));
    try {
      body(process);
    } catch (const FaultError& e) {
      process.report_fault(e.fault());
    }
    ++ended_;
  }
  void simulate() {
    part("simulator", [&](Process& process) {
      ShellParameters k;
      for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
        k.robots.push_back(arm_name(arm));
        k.drivers.push_back("edp-" + arm_name(arm));
      }
      World world(parameters_, 1);
      run_simulator(process, {.arms = &world}, k);
    });
  }
  void drive(std::size_t arm) {
    part("edp-" + arm_name(arm), [&](Process& process) {
      const auto robot = irb6::make_arm("irb6_postument");
      edp::DriverParameters p;
      p.n_s = kWithoutCommand;
      p.T_WE = robot->tool_in_wrist();
      p.force.T_WS = robot->sensor_in_wrist();
      p.synchro_joints = World(parameters_, 1).start_joints(static_cast<int>(arm));
      edp::Driver driver(*robot, p);
      edp::ShellParameters k{.robot = arm_name(arm), .ecp = "ecp-" + arm_name(arm)};
      k.start_guard = std::chrono::milliseconds(0);
      edp::run_edp(process, driver, edp::SimulatedHardware(process, k.robot, "simulator", p.dt), k);
    });
  }

  std::mt19937_64 random_;
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  Process mp_;
  std::optional<link::Outbox<supervisor_t>> supervisor_;
  std::unique_ptr<link::Outbox<simulation_control_t>> control_;
  std::vector<std::unique_ptr<link::Queue<process_status_t>>> statuses_;
  link::Phase said_{};
  Process::Clock::time_point said_at_{};
  std::vector<link::ProcessState> states_;
  std::string fault_;
  WorldParameters parameters_;
  std::vector<Arm> arms_;
  std::map<const Arm*, std::int64_t> whole_;
  std::int64_t last_{};
  std::atomic<std::size_t> ended_{};  // of the threads
  std::vector<std::jthread> threads_;
};

TEST(MacrostepLength, TenThousandMacrostepsOfAnyLengthStopNothingAndLoseNoSample) {
  System system(1, 1);
  system.run(10'000);
  EXPECT_GT(system.steps(), 300'000);
}

TEST(MacrostepLength, RobotsOfOneSystemMayHaveMacrostepsOfDifferentLengths) {
  System system(2, 2);
  system.run(400);
}

}  // namespace
}  // namespace mrroc::sim
