// The shell of a virtual sensor: one reading per macrostep with the stamp of its samples, to the last one.
#include "vsp/shell.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "test/base/link/led.hpp"

namespace mrroc::vsp {
namespace {

/// Counts steps and adds their forces.
struct Adder {
  int steps{};
  int mode{};
  double sum{};
  void set(const SensorSetting& setting) { mode = setting.mode; }
  void step(const StepSample& s) {
    ++steps;
    sum += s.F_a[Axis::z];
  }
  SensorReading reading() const {
    SensorReading r;
    r.state = steps;
    r.value[0] = sum;
    r.value[1] = mode;
    return r;
  }
};

class VspShell : public ::testing::Test, protected link::test::Led {
 protected:
  VspShell()
      : Led("vsp"),
        samples_(mp.outbox<step_samples_t>("arm1.samples")),
        settings_(mp.outbox<sensor_setting_t>("arm1.pen.setting")),
        readings_(mp.inbox<sensor_reading_t>("arm1.pen")) {
    begin([this](link::Process& process) {
      try {
        run_step_sensor(process, "arm1", "arm1.pen", Adder{});
      } catch (const FaultError& e) {
        fault_ = e.fault().code;
      }
    });
    EXPECT_TRUE(run());
  }
  ~VspShell() override { end(); }

  void set(std::int64_t i, int mode) { settings_->publish(to_message(SensorSetting{.mode = mode}), i); }
  void give(std::int64_t i, int n, bool last = false) {
    set(i, static_cast<int>(100 + i));
    give_samples(i, n, last);
  }
  void give_samples(std::int64_t i, int n, bool last = false) {
    step_samples_t m{};
    m.n = n;
    m.last = last;
    m.macrostep = i;
    for (auto& s : m.sample) s.F_a[2] = 0.5;
    samples_->publish(m, i);
  }

  std::unique_ptr<link::Outbox<step_samples_t>> samples_;
  std::unique_ptr<link::Outbox<sensor_setting_t>> settings_;
  std::unique_ptr<link::Inbox<sensor_reading_t>> readings_;
  std::atomic<FaultCode> fault_{FaultCode::none};
};

TEST_F(VspShell, GivesOneReadingPerMacrostepUntilTheDriverEnds) {
  for (std::int64_t i = 1; i <= 50; ++i) {
    give(i, 10, i == 50);
    ASSERT_TRUE(await([&] { return readings_->at(i) != nullptr; })) << i;
    EXPECT_EQ(readings_->at(i)->state, 10 * i);
    EXPECT_DOUBLE_EQ(readings_->at(i)->value[0], 5.0 * static_cast<double>(i));
    EXPECT_EQ(readings_->at(i)->value[1], static_cast<double>(100 + i)) << "y_cV of the same macrostep";
  }
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

TEST_F(VspShell, ACountThatCannotBeReadsNothingBeyondTheMessage) {
  give(1, 1000);
  ASSERT_TRUE(await([&] { return readings_->at(1) != nullptr; }));
  EXPECT_EQ(readings_->at(1)->state, 32);
  give(2, -5);
  ASSERT_TRUE(await([&] { return readings_->at(2) != nullptr; }));
  EXPECT_EQ(readings_->at(2)->state, 32);
}

// Rule R1: y_cV decides on the reading, so it is waited for, and settings that come early wait for their samples.
TEST_F(VspShell, NoReadingBeforeTheSettingOfItsMacrostep) {
  give_samples(1, 10);
  EXPECT_FALSE(mp.await([&] { return readings_->at(1) != nullptr; },
                        link::Process::Clock::now() + std::chrono::milliseconds(50)));
  set(1, 7);
  ASSERT_TRUE(await([&] { return readings_->at(1) != nullptr; }));
  EXPECT_EQ(readings_->at(1)->value[1], 7);
  set(2, 8);
  set(3, 9);
  give_samples(2, 10);
  ASSERT_TRUE(await([&] { return readings_->at(2) != nullptr; }));
  EXPECT_EQ(readings_->at(2)->value[1], 8);
}

TEST_F(VspShell, ReadsOnToTheLastSamplesWhenItsAgentHasEnded) {
  give(1, 10);
  settings_->publish(to_message(SensorSetting{}), link::kEndOfLink);
  give_samples(2, 10);
  give_samples(3, 10, true);
  ASSERT_TRUE(await([&] { return readings_->at(3) != nullptr; }));
  EXPECT_EQ(readings_->at(3)->value[1], 101) << "the last setting stays";
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

TEST_F(VspShell, ASettingThatIsNotFiniteIsAFault) {
  sensor_setting_t m{};
  m.value[2] = std::numeric_limits<double>::infinity();
  settings_->publish(m, 1);
  give_samples(1, 10);
  EXPECT_TRUE(await([this] { return fault_ == FaultCode::malformed_message; }));
}

TEST_F(VspShell, EndsWithTheSystem) {
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended(); }));
}

}  // namespace
}  // namespace mrroc::vsp
