// The driver's shell through the Hardware seam with a plant of a few motors: no simulator, no world.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/operator.hpp"
#include "edp/loopback_hardware.hpp"
#include "edp/shell.hpp"
#include "mrroc/operator_order_t.hpp"
#include "robots/irb6/arm.hpp"
#include "test/base/link/led.hpp"

namespace mrroc::edp {
namespace {

using namespace std::chrono_literals;
using link::Process;

/// A driver of an IRb-6 in a thread; the test is MP and ECP.
class Loopback : public ::testing::Test, protected link::test::Led {
 protected:
  explicit Loopback(ClockKind clock = ClockKind::step)
      : Led("edp-arm1", clock, "loopback"),
        commands_(mp.outbox<effector_command_t>("arm1.command")),
        orders_(mp.outbox<operator_order_t>("operator")),
        replies_(mp.inbox<effector_reply_t>("arm1.reply")),
        console_(mp.bus(), mp.route("edp-arm1.console"), mp.context().session_id) {}
  ~Loopback() override { end(); }

  /// @param make        gives the hardware, from the robot and where its motors stand
  /// @param macrosteps  that are commanded, the release with them
  template <class Make>
  void begin(Make make, std::int64_t macrosteps) {
    last_ = macrosteps;
    Led::begin([make](Process& process) {
      const auto robot = irb6::make_arm("irb6_postument");
      DriverParameters p;
      p.T_WE = robot->tool_in_wrist();
      p.force.T_WS = robot->sensor_in_wrist();
      p.synchro_joints = (AxisVector(6) << 0, -1.57, 0, 1.5, 1.57, 0).finished();
      Driver driver(*robot, p);
      ShellParameters k{.robot = "arm1", .ecp = "mp"};
      k.start_guard = 0ms;
      run_edp(process, driver, make(*robot, robot->motors_from_joints(p.synchro_joints), p.dt), k);
    });
    EXPECT_TRUE(run());
  }

  void send(std::int64_t i) {
    EffectorCommand c;
    c.session = 7;
    c.number = i;
    c.instruction = i == 1 ? Instruction::synchro : i == last_ ? Instruction::release : Instruction::set;
    c.set = c.instruction == Instruction::set ? Part::arm | Part{} : std::uint8_t{};
    c.arm.frame.x = u(0.02);
    c.arm.n_s = n_s_;
    c.arm.n_Q = static_cast<std::uint16_t>(n_s_ - 1);
    commands_->publish(to_message(c), i);
  }
  /// @return all lines that the driver has said
  const std::string& lines() {
    while (const auto line = console_.take()) lines_ += link::get_text(line->text) + "\n";
    return lines_;
  }

  std::int64_t last_{};
  std::uint16_t n_s_{10};  // of the commanded macrosteps
  std::unique_ptr<link::Outbox<effector_command_t>> commands_;
  std::unique_ptr<link::Outbox<operator_order_t>> orders_;
  std::unique_ptr<link::Inbox<effector_reply_t>> replies_;

 private:
  link::Queue<console_t> console_;
  std::string lines_;
};

/// The same by the wall clock.
class LoopbackByTheWallClock : public Loopback {
 protected:
  LoopbackByTheWallClock() : Loopback(ClockKind::wall) {}
};

LoopbackHardware lock_step(const Robot& robot, const AxisVector& motors, double dt) {
  return {LoopbackPlant(robot, motors, dt), dt, false};
}
LoopbackHardware wall_clock(const Robot& robot, const AxisVector& motors, double dt) {
  return {LoopbackPlant(robot, motors, dt), dt, true};
}

TEST_F(Loopback, TheDriverOfAnIRb6MovesAPlantWithoutAnySimulator) {
  constexpr std::int64_t kMacrosteps = 200;
  begin(lock_step, kMacrosteps);
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();
  send(1);
  for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
    ASSERT_TRUE(await([&] { return replies_->at(i) != nullptr; })) << i;
    const effector_reply_t& reply = *replies_->at(i);
    ASSERT_EQ(reply.fault.code, 0) << describe(from_message(reply.fault));
    ASSERT_EQ(reply.step, 10 * i - 2);
    EXPECT_EQ(reply.position_known, i > 1);
    to = Eigen::Map<const Vector3>(reply.T_0E);
    if (i == 20) from = to;
    send(i + 1);
  }
  EXPECT_NEAR((to - from).norm(), 0.02 * 0.02 * (kMacrosteps - 20), 0.002) << "0.02 m/s along x of E";
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

/// A plant that follows a script: it is silent for a while, and ends.
struct ScriptedHardware {
  LoopbackPlant plant;
  std::int64_t silent_from, silent_for, ends;
  ReadResult read(std::int64_t step) {
    if (step >= ends) return {ReadStatus::ended};
    if (step >= silent_from && silent_for-- > 0) {
      std::this_thread::sleep_for(100us);
      return {ReadStatus::silent};
    }
    return {ReadStatus::reading, plant.reading()};
  }
  void write(const HardwareCommand& command) { plant.step(&command); }
};

TEST_F(LoopbackByTheWallClock, AHardwareThatEndsEndsTheDriver) {
  begin(
      [](const Robot& robot, const AxisVector& motors, double dt) {
        return ScriptedHardware{LoopbackPlant(robot, motors, dt), 0, 0, 300};
      },
      1000);
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

TEST_F(LoopbackByTheWallClock, AHardwareThatIsSilentForTooLongIsAFault) {
  begin(
      [](const Robot& robot, const AxisVector& motors, double dt) {
        return ScriptedHardware{LoopbackPlant(robot, motors, dt), 50, 300, 1'000'000};
      },
      1000);
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::faulted; }));
  EXPECT_EQ(status().fault.code, static_cast<int>(FaultCode::hardware_silent));
}

/// A robot with a clock of its own, which goes by as the test says, however long that takes. It ends after three of the
/// windows in which a pace is judged.
struct PacedHardware {
  LoopbackPlant plant;
  PeriodClock periods;
  PeriodClock::Time::duration every;  // between two readings
  PeriodClock::Time now{1h};
  ReadResult read(std::int64_t step) {
    now += every;
    if (now > PeriodClock::Time{1h} + 3 * PaceWatch::kWindow) return {ReadStatus::ended};
    const std::int64_t begun = periods.begin(step, now);
    while (plant.reading().step < begun) plant.step(nullptr);
    return {ReadStatus::reading, plant.reading()};
  }
  void write(const HardwareCommand& command) { plant.step(&command); }
  [[nodiscard]] const PeriodClock* clock() const { return &periods; }
};

TEST_F(LoopbackByTheWallClock, AHostThatMissesHalfOfTheRobotsPeriodsTripsTheDriverAndIsAFault) {
  begin(
      [](const Robot& robot, const AxisVector& motors, double dt) {
        return PacedHardware{LoopbackPlant(robot, motors, dt), PeriodClock(dt), 4ms};
      },
      1000);
  ASSERT_TRUE(await([this] { return state() >= link::ProcessState::done; }));
  ASSERT_EQ(state(), link::ProcessState::faulted);
  EXPECT_EQ(status().fault.code, static_cast<int>(FaultCode::host_too_slow));
  EXPECT_NEAR(status().fault.value, 0.5, 0.01) << "periods that have begun, of those that were due";
  EXPECT_EQ(status().fault.limit, PaceWatch::kSlowest);
  EXPECT_TRUE(await([this] {
    return replies_->newest() &&
           replies_->newest()->fault.code == static_cast<int>(FaultCode::host_too_slow) &&
           replies_->newest()->state == static_cast<int>(DriverState::faulted);
  })) << "the drives brake";
}

TEST_F(LoopbackByTheWallClock, AHostThatMissesAThirdOfTheRobotsPeriodsIsNoFault) {
  begin(
      [](const Robot& robot, const AxisVector& motors, double dt) {
        return PacedHardware{LoopbackPlant(robot, motors, dt), PeriodClock(dt), 3ms};
      },
      1000);
  ASSERT_TRUE(await([this] { return state() >= link::ProcessState::done; }));
  EXPECT_EQ(state(), link::ProcessState::done) << status().fault.code;
}

/// A robot that is read when the test lets it. Once, it misses steps.
class MissedSteps : public LoopbackByTheWallClock {
 protected:
  ~MissedSteps() override { until_ = std::numeric_limits<std::int64_t>::max(); }

  struct Hardware {
    LoopbackPlant plant;
    const std::atomic<std::int64_t>* until;  // steps that it makes
    std::int64_t misses_in, misses;          // the step in which it misses some, and how many
    ReadResult read(std::int64_t step) {
      while (step >= *until) std::this_thread::sleep_for(100us);
      const std::int64_t due = step == misses_in ? step + misses : step;
      while (plant.reading().step < due) plant.step(nullptr);
      return {ReadStatus::reading, plant.reading()};
    }
    void write(const HardwareCommand& command) { plant.step(&command); }
  };
  std::atomic<std::int64_t> until_{0};
};

TEST_F(MissedSteps, AreCountedInMacrostepsOfTheLengthThatIsCommanded) {
  begin(
      [this](const Robot& robot, const AxisVector& motors, double dt) {
        return Hardware{LoopbackPlant(robot, motors, dt), &until_, 45, 40};
      },
      1000);
  n_s_ = 20;
  for (std::int64_t i = 1; i <= 10; ++i) send(i);
  until_ = 200;
  // 0: steps 0 to 9; 1, the homing: 10 to 19; 2: 20 to 39; 3: 40 to 59, but steps 45 to 84 are missed: to 99.
  ASSERT_TRUE(await([this] { return replies_->newest() && replies_->newest()->header.stamp >= 8; }));
  ASSERT_TRUE(replies_->at(4));
  EXPECT_EQ(replies_->at(4)->step, 98);
  EXPECT_FALSE(replies_->at(5)) << "two macrosteps went by";
  EXPECT_FALSE(replies_->at(6));
  ASSERT_TRUE(replies_->at(7)) << "the one after macrosteps 4 and 5";
  EXPECT_EQ(replies_->at(7)->step, 108) << "its command comes after lost ones: ten steps without one";
}

TEST(LoopbackPlant, DrivesBrakeByThemselvesWhenCommandsStayAway) {
  const auto robot = irb6::make_arm("irb6_postument");
  const AxisVector motors =
      robot->motors_from_joints((AxisVector(6) << 0, -1.57, 0, 1.5, 1.57, 0).finished());
  LoopbackPlant plant(*robot, motors, 0.002);
  HardwareCommand command;
  command.enabled = true;
  command.pwm[0] = 100;
  for (int k = 0; k < 100; ++k) plant.step(&command);
  ASSERT_GT(plant.motors()[0], motors[0] + 0.1);
  EXPECT_GT(plant.reading().current[0], 0);
  for (int k = 0; k < LoopbackPlant::kCommandTimeout; ++k) plant.step(nullptr);
  EXPECT_TRUE(plant.enabled());
  plant.step(nullptr);
  EXPECT_FALSE(plant.enabled());
  for (int k = 0; k < 10; ++k) plant.step(nullptr);
  const std::int32_t stands = plant.reading().encoder[0];
  for (int k = 0; k < 100; ++k) plant.step(nullptr);
  EXPECT_EQ(plant.reading().encoder[0], stands);
}

TEST_F(Loopback, ADriverThatWaitsForNoCommandAnyMoreEndsWithTheSystem) {
  begin(lock_step, 1000);
  send(1);
  ASSERT_TRUE(await([this] { return replies_->at(1) != nullptr; }));
  say(link::Phase::stopping);
  ASSERT_TRUE(await([this] { return replies_->newest()->header.stamp > 10; })) << "it goes on by itself";
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended(); }));
}

TEST_F(LoopbackByTheWallClock, PeriodsAreThoseOfTheMonotonicClockAndLateOnesAreCountedAndTold) {
  const auto begun = Process::Clock::now();
  begin(wall_clock, 100);
  std::array<double, 2> late{1e9, 1e9};  // of the promptest reply in either half [s]
  for (std::int64_t i = 1; i <= last_; ++i) {
    send(i);
    ASSERT_TRUE(await([&] {
      return (replies_->newest() && replies_->newest()->header.stamp >= i) ||
             state() == link::ProcessState::done;
    })) << i;
    const double since = std::chrono::duration<double>(Process::Clock::now() - begun).count();
    double& half = late[i <= last_ / 2 ? 0 : 1];
    half = std::min(half, since - 0.002 * static_cast<double>(replies_->newest()->step));
  }
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
  EXPECT_GT(late[0], 0) << "no step is made before its time";
  EXPECT_NEAR(late[1], late[0], 0.25) << "steps keep to the clock, whatever this host is busy with";
  EXPECT_TRUE(await([this] { return lines().find("periods late, the worst by") != std::string::npos; }))
      << lines();
}

TEST_F(LoopbackByTheWallClock, ADriverWhoseHardwareHasAClockOfItsOwnHearsTheEmergencyStop) {
  begin(wall_clock, 1'000'000);
  ASSERT_TRUE(await([this] { return replies_->newest() != nullptr; }));
  EXPECT_EQ(replies_->newest()->fault.code, 0);
  operator_order_t order{};
  order.order = static_cast<std::int32_t>(OperatorOrder::emergency_stop);
  orders_->publish(order, 0);
  EXPECT_TRUE(await(
      [this] { return replies_->newest()->fault.code == static_cast<int>(FaultCode::emergency_stop); }));
}

TEST_F(LoopbackByTheWallClock, ADriverWhoseHardwareHasAClockOfItsOwnEndsWithTheSystem) {
  begin(wall_clock, 1'000'000);
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended(); }));
}

}  // namespace
}  // namespace mrroc::edp
