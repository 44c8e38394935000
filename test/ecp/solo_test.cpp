// An agent that works on its own, from the preparation of its effector to the release: what it commands and reports
// when the coordinator gives start, pauses and ends it.
#include "ecp/solo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "ecp/generators/polynomials.hpp"
#include "test/base/link/answered_bus.hpp"

namespace mrroc::ecp {
namespace {

using link::Phase;
using link::ProcessState;

constexpr std::int64_t kStart = 80;  // macrostep in which start is given; the arm is prepared long before

const Config kConfig = Config::parse(
    "speed = 0.3\n[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 7\nmass_centre = [0, 0.01, "
    "0.05]\n",
    "test");

/// The process of an agent in this thread; driver, sensor, coordinator and supervisor answer while it waits.
class Room {
 public:
  Room() {
    link::NodeContext m;
    m.session = "solo";
    m.name = "ecp-arm1";
    m.roster = {"mp", m.name};
    process.emplace(own, m);
    replies.emplace(*others, process->route("arm1.reply"), 1);
    orders.emplace(*others, process->route("arm1.order"), 1);
    readings.emplace(*others, process->route("arm1.eye"), 1);
    supervisor.emplace(*others, process->route("supervisor"), 1);
    commands.emplace(*others, process->route("arm1.command"), 1);
    reports.emplace(*others, process->route("arm1.report"), 1);
    status.emplace(*others, process->route("ecp-arm1.status"), 1);
    say(Phase::running);
  }
  void run(const link::NodeMain& body) {
    body(*process, kConfig, {.arm = "arm1"});
    stayed = over_;
    serve();
  }
  /// @return the commands to the arm by their macrosteps: speeds along x, which say whether the arm was commanded at all
  [[nodiscard]] std::vector<double> speeds() const {
    std::vector<double> all;
    for (const effector_command_t& c : sent)
      if (c.header.stamp > kStart && has(c.set, Part::arm)) all.push_back(c.arm.axis[0].velocity);
    return all;
  }
  /// @return the macrosteps of all commands of that kind
  [[nodiscard]] std::vector<std::int64_t> macrosteps_of(Instruction instruction) const {
    std::vector<std::int64_t> all;
    for (const effector_command_t& c : sent)
      if (c.instruction == static_cast<int>(instruction)) all.push_back(c.header.stamp);
    return all;
  }

  std::function<SoloOrder(std::int64_t)> order = [](std::int64_t i) {
    return i < kStart ? SoloOrder::wait : SoloOrder::work;
  };
  std::int64_t refused{};  ///< macrostep whose command is refused
  std::int64_t stopped{};  ///< macrostep in which the system stops
  bool stayed{};           ///< the process came to its end after the system
  std::vector<effector_command_t> sent;
  std::vector<agent_report_t> told;

 private:
  void say(Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor->publish(m, 0);
  }
  void serve() {
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    while (const auto r = reports->take()) {
      told.push_back(*r);
      if (r->event == kWorkDone && ++done_ > 3) finished_ = true;
    }
    while (const auto s = status->take()) {
      last = *s;
      over_ = s->state >= static_cast<int>(ProcessState::done);
      if (over_) say(Phase::finished);
    }
    while (const auto c = commands->take()) {
      sent.push_back(*c);
      if (c->header.stamp == 1) give(1, Verdict::none, 0);
      const bool loud = c->instruction != static_cast<int>(Instruction::keep);
      const bool refuses = loud && c->header.stamp == refused;
      give(c->header.stamp + 1,
           refuses ? Verdict::refused
           : loud  ? Verdict::executed
                   : Verdict::none,
           loud ? c->number : 0);
      if (c->header.stamp == stopped) say(Phase::stopping);
    }
  }
  void give(std::int64_t i, Verdict verdict, std::int64_t number) {
    EffectorReply r;
    r.state = DriverState::ready;
    r.verdict = verdict;
    r.number = number;
    if (verdict == Verdict::refused) r.fault.code = FaultCode::start_guard;
    replies->publish(to_message(r), i);
    Order o{.m = static_cast<int>(order(i))};
    o.finished = finished_;
    orders->publish(to_message(o), i);
    readings->publish(to_message(SensorReading{.state = static_cast<int>(i)}), i);
  }

  link::MemoryHub hub_;
  int done_{};
  bool finished_{}, over_{};

 public:
  link::test::AnsweredBus own{hub_.open(), [this] {
                                if (status) serve();
                              }};
  std::unique_ptr<link::Bus> others = hub_.open();
  std::optional<link::Process> process;
  std::optional<link::Outbox<effector_reply_t>> replies;
  std::optional<link::Outbox<agent_order_t>> orders;
  std::optional<link::Outbox<sensor_reading_t>> readings;
  std::optional<link::Outbox<supervisor_t>> supervisor;
  std::optional<link::Queue<effector_command_t>> commands;
  std::optional<link::Queue<agent_report_t>> reports;
  std::optional<link::Queue<process_status_t>> status;
  process_status_t last{};
};

/// An agent that pushes with the speed that it remembers, and then with twice that.
struct Pusher : ArmAgent<Parameter<7>> {};

EffectorCommand push(const Pusher::X& x) { return move_arm(TaskFrameCommand{.x = u(x.c.value)}); }
EffectorCommand push_twice(const Pusher::X& x) { return move_arm(TaskFrameCommand{.x = u(2 * x.c.value)}); }
constexpr std::array kPushes{row<Pusher>(3, "push", push, after<Pusher, 4>, "four macrosteps"),
                             row<Pusher>(4, "push twice as fast", push_twice, after<Pusher, 2>)};

TEST(Solo, PreparesTheEffectorWaitsForTheStartExecutesItsRowsOnceAndReleasesTheEffector) {
  Room room;
  room.run(solo<Pusher>(kPushes));
  EXPECT_EQ(room.macrosteps_of(Instruction::synchro), std::vector<std::int64_t>{2});
  const auto set =
      std::ranges::find(room.sent, static_cast<int>(Instruction::set), &effector_command_t::instruction);
  ASSERT_NE(set, room.sent.end());
  EXPECT_EQ(set->robot_model.weight, 7) << "the tool of its arm";
  EXPECT_EQ(set->robot_model.tool[2], 0.25);
  EXPECT_GT(set->header.stamp, 50) << "a second at rest before the force is biased";
  EXPECT_EQ(room.speeds(), (std::vector<double>{7, 7, 7, 7, 14, 14})) << "the usual value";
  for (const effector_command_t& c : room.sent)
    EXPECT_FALSE(has(c.set, Part::arm) && c.header.stamp <= kStart) << c.header.stamp;
  ASSERT_EQ(room.macrosteps_of(Instruction::release).size(), 1U);
  EXPECT_EQ(room.sent.back().instruction, static_cast<int>(Instruction::release));
  EXPECT_EQ(room.last.state, static_cast<int>(ProcessState::done));
  EXPECT_TRUE(room.stayed) << "a peer may still need a message repeated";
}

TEST(Solo, ReportsTheBehaviourAndAtLastThatItsWorkIsDone) {
  Room room;
  room.run(solo<Pusher>(kPushes));
  std::vector<int> m;
  for (const agent_report_t& r : room.told) {
    if (r.header.stamp <= kStart) continue;
    EXPECT_EQ(r.ready, 1);
    if (r.m != 0) m.push_back(r.m);
    if (r.event != 0) {
      EXPECT_EQ(r.event, kWorkDone);
      EXPECT_EQ(r.m, 0);
      EXPECT_GT(r.header.stamp, kStart + 6);
    }
  }
  EXPECT_EQ(m, (std::vector<int>{3, 3, 3, 3, 4, 4}));
  EXPECT_GT(std::ranges::count(room.told, kWorkDone, &agent_report_t::event), 3) << "until the task is over";
  EXPECT_EQ(room.told.back().ready, 1) << "with the release";
}

TEST(Solo, RemembersWhatIsReadFromTheConfiguration) {
  Room room;
  room.run(solo<Pusher>(
      kPushes, +[](const Config& config) {
        return config.number("speed", {}, {0, 1}, "m/s");
      }));
  EXPECT_EQ(room.speeds(), (std::vector<double>{0.3, 0.3, 0.3, 0.3, 0.6, 0.6}));
}

TEST(Solo, InAPauseItsTimeSlowsDownAndStandsStillAndItsWayIsTheSame) {
  static constexpr std::array kLong{row<Pusher>(3, "push", push, after<Pusher, 20>, "twenty macrosteps")};
  Room room;
  room.order = [](std::int64_t i) {
    return i < kStart                           ? SoloOrder::wait
           : i >= kStart + 2 && i < kStart + 32 ? SoloOrder::pause
                                                : SoloOrder::work;
  };
  room.run(solo<Pusher>(kLong));
  const std::vector<double> speeds = room.speeds();
  EXPECT_NEAR(std::accumulate(speeds.begin(), speeds.end(), 0.0), 20 * 7, 7);
  EXPECT_GT(std::ranges::count_if(speeds, [](double v) { return std::abs(v) < 1e-9; }), 10) << "it stands";
  EXPECT_EQ(room.last.state, static_cast<int>(ProcessState::done));
}

/// An agent that reads a sensor: it writes down what it reads.
struct Reader : ArmAgent<std::vector<int>> {};

TEST(Solo, ASensorIsReadByItsChannelInEveryMacrostep) {
  static std::vector<int> read;
  read.clear();
  static constexpr auto kLook = [](const Reader::X& x) {
    read.push_back(x.V.state - static_cast<int>(x.i));
    return rest();
  };
  static constexpr std::array kRows{row<Reader>(1, "look", kLook, after<Reader, 5>)};
  Room room;
  room.run(solo<Reader>(kRows, "eye"));
  EXPECT_EQ(read, std::vector<int>(5, 0));
  Room blind;
  read.clear();
  blind.run(solo<Reader>(kRows));
  ASSERT_EQ(read.size(), 5U);
  for (const int difference : read) EXPECT_LT(difference, -kStart + 2) << "nothing is read";
}

TEST(Solo, AStopEndsItWithoutARelease) {
  Room room;
  room.stopped = kStart + 3;
  room.run(solo<Pusher>(kPushes));
  EXPECT_LE(room.speeds().size(), 4U);
  EXPECT_TRUE(room.macrosteps_of(Instruction::release).empty());
  EXPECT_EQ(room.last.state, static_cast<int>(ProcessState::done));
}

TEST(Solo, ARefusedPreparationEndsItWithTheDriversFault) {
  Room room;
  room.refused = 2;
  room.run(solo<Pusher>(kPushes));
  EXPECT_TRUE(room.speeds().empty());
  EXPECT_EQ(room.last.state, static_cast<int>(ProcessState::faulted));
  EXPECT_EQ(room.last.fault.code, static_cast<int>(FaultCode::start_guard));
}

TEST(Rows, AReportTellsTheEffectorAndTheSensor) {
  Pusher::X x;
  x.V.state = 5;
  x.e.state = DriverState::executing;
  x.e.verdict = Verdict::executed;
  x.e.position_known = true;
  x.e.T_0E = {1, 2, 3, 4, 5, 6};
  x.e.F_a = {{6, 5, 4, 3, 2, 1}};
  x.e.gripper = 0.04;
  x.e.blocked = true;
  const Report r = report_of(x, 9);
  EXPECT_EQ(r.m, 9);
  EXPECT_EQ(r.event, 0);
  EXPECT_TRUE(r.ready);
  EXPECT_EQ(r.sensor, 5);
  EXPECT_EQ(r.driver_state, DriverState::executing);
  EXPECT_EQ(r.verdict, Verdict::executed);
  EXPECT_EQ(r.fault.code, FaultCode::none);
  EXPECT_TRUE(r.position_known);
  EXPECT_EQ(r.T_0E, x.e.T_0E);
  EXPECT_EQ(r.F_a, x.e.F_a);
  EXPECT_EQ(r.gripper, 0.04);
  EXPECT_TRUE(r.blocked);
  EXPECT_EQ(tell<Pusher>(x).m, 0);
}

TEST(Rows, ADriverThatHasFailedIsReportedThoughNothingWasCommanded) {
  Pusher::X x;
  x.e.fault.code = FaultCode::over_current;
  for (const auto& [state, verdict, told] :
       {std::tuple(DriverState::faulted, Verdict::none, Verdict::failed),
        std::tuple(DriverState::faulted, Verdict::executed, Verdict::failed),
        std::tuple(DriverState::ready, Verdict::none, Verdict::none),
        std::tuple(DriverState::ready, Verdict::refused, Verdict::refused)}) {
    x.e.state = state;
    x.e.verdict = verdict;
    EXPECT_EQ(report_of(x, 1).verdict, told);
    EXPECT_EQ(report_of(x, 1).fault.code, FaultCode::over_current);
  }
  x.e.fault.code = FaultCode::none;
  x.e.state = DriverState::faulted;
  x.e.verdict = Verdict::executed;
  EXPECT_EQ(report_of(x, 1).verdict, Verdict::executed) << "an old fault that has been told";
}

/// Memory of an agent that follows a path.
struct Way {
  Trajectory path;
};
struct Follower : ArmAgent<Way> {};

TEST(Rows, APathEndsWithItsLastMacrostepAndHasEndedInAllThatFollow) {
  const std::vector<Knot> knots{{.t = 0, .pose = Coordinates::Zero(6)},
                                {.t = 0.1, .pose = Coordinates::Ones(6)}};
  Follower::X x;
  x.c.path = Trajectory(linear_spline(knots), {.space = Representation::joints}, {});
  x.i_0 = 30;
  const std::int64_t end = x.c.path.macrosteps();
  for (std::int64_t k = 0; k <= 3 * end; ++k) {
    x.i = x.i_0 + k;
    EXPECT_EQ(path_ends(x), k >= end) << k;
  }
}

constexpr TaskFrameCommand kFrame{.z = u(-0.1)};

TEST(Rows, AreMadeOfWhatTheySay) {
  const Motion<Pusher> made = row<Pusher>(8, "down", command<Pusher, kFrame>, after<Pusher, 3>, "three");
  EXPECT_EQ(made.m, 8);
  EXPECT_EQ(made.name, "down");
  EXPECT_EQ(made.until, "three");
  Pusher::X x;
  x.c.value = 4;
  x.i_0 = 10;
  EXPECT_EQ(made.f_ce(x).arm.frame, kFrame);
  EXPECT_TRUE(has(made.f_ce(x).set, Part::arm));
  EXPECT_TRUE(has(made.f_ce(x).get, Part::arm));
  EXPECT_EQ(made.f_entry(x), x.c);
  EXPECT_EQ(made.f_cc(x), x.c);
  for (x.i = 10; x.i < 15; ++x.i) EXPECT_EQ(made.f_tau(x), x.i >= 13) << x.i;
  EXPECT_EQ(at_rest<Pusher>(x).instruction, Instruction::keep);
  EXPECT_EQ(Parameter<7>{}.value, 7);
}

}  // namespace
}  // namespace mrroc::ecp
