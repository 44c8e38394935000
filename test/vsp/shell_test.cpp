// The shell of a virtual sensor: one reading per macrostep with the stamp of its samples, to the last one.
#include "vsp/shell.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "base/link/memory_bus.hpp"

namespace mrroc::vsp {
namespace {

/// Counts steps and adds their forces.
struct Adder {
  int steps{};
  double sum{};
  void step(const StepSample& s) {
    ++steps;
    sum += s.F_a[Axis::z];
  }
  SensorReading reading() const {
    SensorReading r;
    r.state = steps;
    r.value[0] = sum;
    return r;
  }
};

link::Membership member(const std::string& name) {
  link::Membership m;
  m.session = "test";
  m.name = name;
  m.roster = {"mp", "vsp"};
  return m;
}

class VspShell : public ::testing::Test {
 protected:
  VspShell()
      : bus_(hub_.open()),
        mp_(*bus_, member("mp")),
        supervisor_(*bus_, mp_.route("supervisor"), 1),
        samples_(mp_.outbox<step_samples_t>("arm1.samples")),
        readings_(mp_.inbox<sensor_reading_t>("arm1.pen")),
        status_(*bus_, mp_.route("vsp.status"), 1),
        thread_([this] {
          const auto bus = hub_.open();
          link::Process process(*bus, member("vsp"));
          run_step_sensor(process, "arm1", "arm1.pen", Adder{});
          ended_ = true;
        }) {
    mp_.on_service = [this] {
      while (const auto s = status_.take()) state_ = static_cast<link::ProcessState>(s->state);
    };
    EXPECT_TRUE(await([this] { return state_ == link::ProcessState::ready; }));
    say(link::Phase::running);
  }
  ~VspShell() override { say(link::Phase::finished); }

  template <class Ready>
  bool await(Ready ready) {
    return mp_.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  }
  void say(link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor_.publish(m, 0);
  }
  void give(std::int64_t i, int n, bool last = false) {
    step_samples_t m{};
    m.n = n;
    m.last = last;
    for (auto& s : m.sample) s.F_a[2] = 0.5;
    samples_->publish(m, i);
  }

  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  link::Process mp_;
  link::Outbox<supervisor_t> supervisor_;
  std::unique_ptr<link::Outbox<step_samples_t>> samples_;
  std::unique_ptr<link::Inbox<sensor_reading_t>> readings_;
  link::Queue<process_status_t> status_;
  link::ProcessState state_{};
  std::atomic<bool> ended_{false};
  std::jthread thread_;
};

TEST_F(VspShell, GivesOneReadingPerMacrostepUntilTheDriverEnds) {
  for (std::int64_t i = 1; i <= 50; ++i) {
    give(i, 10, i == 50);
    ASSERT_TRUE(await([&] { return readings_->at(i) != nullptr; })) << i;
    EXPECT_EQ(readings_->at(i)->state, 10 * i);
    EXPECT_DOUBLE_EQ(readings_->at(i)->value[0], 5.0 * static_cast<double>(i));
  }
  EXPECT_TRUE(await([this] { return state_ == link::ProcessState::done; }));
}

TEST_F(VspShell, ACountThatCannotBeReadsNothingBeyondTheMessage) {
  give(1, 1000);
  ASSERT_TRUE(await([&] { return readings_->at(1) != nullptr; }));
  EXPECT_EQ(readings_->at(1)->state, 32);
  give(2, -5);
  ASSERT_TRUE(await([&] { return readings_->at(2) != nullptr; }));
  EXPECT_EQ(readings_->at(2)->state, 32);
}

TEST_F(VspShell, EndsWithTheSystem) {
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended_.load(); }));
}

}  // namespace
}  // namespace mrroc::vsp
