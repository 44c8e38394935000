// The pen-state sensor's part of a configuration, what it believes of a sample, and the channels of its process.
#include "vsp/pen_state/config.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <thread>

#include "base/fault.hpp"
#include "base/link/memory_bus.hpp"
#include "vsp/sample.hpp"
#include "vsp/shell.hpp"

namespace mrroc::vsp {
namespace {

/// One number of the table [pen_state].
struct Key {
  const char* name;
  double PenStateParameters::*number;
  double low, high;
};
constexpr std::array<Key, 17> kKeys{{{"v_filter", &PenStateParameters::v_filter, 0, 1},
                                     {"F_filter", &PenStateParameters::F_filter, 0, 1},
                                     {"tremor_period", &PenStateParameters::tremor_period, 0.002, 0.5},
                                     {"tremor_memory", &PenStateParameters::tremor_memory, 0.1, 10},
                                     {"lowering_speed", &PenStateParameters::lowering_speed, 0.0005, 0.1},
                                     {"braked_speed", &PenStateParameters::braked_speed, 0.0005, 0.1},
                                     {"rest_speed", &PenStateParameters::rest_speed, 0, 0.1},
                                     {"rest_time", &PenStateParameters::rest_time, 0, 10},
                                     {"touch_height", &PenStateParameters::touch_height, 0.0001, 0.01},
                                     {"impact_force", &PenStateParameters::impact_force, 0.1, 20},
                                     {"impact_time", &PenStateParameters::impact_time, 0.002, 0.098},
                                     {"stop_share", &PenStateParameters::stop_share, 0, 1},
                                     {"stop_force", &PenStateParameters::stop_force, 0, 20},
                                     {"rest_force", &PenStateParameters::rest_force, 0.1, 20},
                                     {"rest_force_time", &PenStateParameters::rest_force_time, 0, 10},
                                     {"sink_depth", &PenStateParameters::sink_depth, 0.0003, 0.05},
                                     {"lift_height", &PenStateParameters::lift_height, 0.0001, 0.02}}};
struct PaperKey {
  const char* name;
  double PlaneParameters::*number;
  double low, high;
};
constexpr std::array<PaperKey, 4> kPaperKeys{{{"slope", &PlaneParameters::slope, 0.0001, 0.5},
                                              {"roughness", &PlaneParameters::roughness, 1e-5, 0.01},
                                              {"correlation", &PlaneParameters::correlation, 0.002, 10},
                                              {"memory", &PlaneParameters::memory, 0.1, 1000}}};

PenStateParameters with(const std::string& key, double value) {
  std::ostringstream text;
  text.precision(17);
  text << "[pen_state]\n" << key << " = " << std::showpoint << value << "\n";
  return read_pen_state(Config::parse(text.str(), "test"));
}

/// Sets the number to both of its bounds, and beyond them.
template <class Read>
void expect_bounds(const std::string& name, double low, double high, Read read) {
  EXPECT_EQ(read(with(name, low)), low) << name;
  EXPECT_EQ(read(with(name, high)), high) << name;
  EXPECT_THROW(with(name, low - 0.01 * std::max(low, 1e-3)), ConfigError) << name;
  EXPECT_THROW(with(name, 1.01 * high), ConfigError) << name;
}

TEST(PenConfig, WithoutAWordTheNumbersAreTheSensorsOwn) {
  const PenStateParameters read = read_pen_state(Config::parse("", "test")), own;
  for (const Key& key : kKeys) EXPECT_EQ(read.*key.number, own.*key.number) << key.name;
  for (const PaperKey& key : kPaperKeys) EXPECT_EQ(read.paper.*key.number, own.paper.*key.number) << key.name;
  EXPECT_EQ(read.dt, 0.002);
}

// The numbers with which the papers' pen is told from a hand's tremor; a configuration that changes one says so.
TEST(PenConfig, TheSensorsOwnNumbersAreTheDocumentedOnes) {
  const PenStateParameters own;
  constexpr std::array<double, 17> kNumbers{0.020, 0.006, 0.25, 1.0, 0.005, 0.003, 0.0015, 0.5,   0.0012,
                                            1.25,  0.020, 0.25, 0.8, 1.2,   0.2,   0.002,  0.0022};
  for (std::size_t k = 0; k < kKeys.size(); ++k)
    EXPECT_EQ(own.*kKeys[k].number, kNumbers[k]) << kKeys[k].name;
  constexpr std::array<double, 4> kPaper{0.02, 0.0005, 0.3, 30};
  for (std::size_t k = 0; k < kPaperKeys.size(); ++k)
    EXPECT_EQ(own.paper.*kPaperKeys[k].number, kPaper[k]) << kPaperKeys[k].name;
}

TEST(PenConfig, EveryNumberHasItsKeyAndItsBounds) {
  for (const Key& key : kKeys)
    expect_bounds(key.name, key.low, key.high, [&](const PenStateParameters& p) { return p.*key.number; });
  for (const PaperKey& key : kPaperKeys)
    expect_bounds(key.name, key.low, key.high,
                  [&](const PenStateParameters& p) { return p.paper.*key.number; });
}

TEST(PenConfig, OneKeyChangesOneNumber) {
  const PenStateParameters own;
  for (const Key& changed : kKeys) {
    const PenStateParameters read = with(changed.name, 0.5 * (changed.low + changed.high));
    for (const Key& key : kKeys)
      EXPECT_EQ(read.*key.number == own.*key.number, &key != &changed) << changed.name << ' ' << key.name;
    for (const PaperKey& key : kPaperKeys)
      EXPECT_EQ(read.paper.*key.number, own.paper.*key.number) << changed.name;
  }
}

TEST(PenConfig, AStepLastsTwoMilliseconds) {
  EXPECT_EQ(read_pen_state(Config::parse("[time]\ndt = 0.002\n", "test")).dt, 0.002);
  EXPECT_THROW(read_pen_state(Config::parse("[time]\ndt = 0.0021\n", "test")), ConfigError);
  EXPECT_THROW(read_pen_state(Config::parse("[time]\ndt = 0.0019\n", "test")), ConfigError);
}

TEST(Sample, IsAReadingWhenEveryNumberIsPossible) {
  EXPECT_TRUE(is_reading({}));
  const auto impossible = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           1e6, -1e6};
  for (std::size_t k = 0; k < 6; ++k) {
    for (const double x : impossible) {
      StepSample pose, force;
      pose.T_0E[k] = x;
      force.F_a.v[k] = x;
      EXPECT_FALSE(is_reading(pose)) << k << ' ' << x;
      EXPECT_FALSE(is_reading(force)) << k << ' ' << x;
    }
    for (const double x : {0.999e6, -0.999e6}) {
      StepSample pose, force;
      pose.T_0E[k] = x;
      force.F_a.v[k] = x;
      EXPECT_TRUE(is_reading(pose)) << k;
      EXPECT_TRUE(is_reading(force)) << k;
    }
  }
}

TEST(PenProcess, ReadsTheSamplesOfItsArmAndTellsThePensState) {
  const auto context_of = [](const std::string& name) {
    link::NodeContext m;
    m.session = "pen";
    m.name = name;
    m.roster = {"mp", "vsp"};
    return m;
  };
  link::MemoryHub hub;
  const auto bus = hub.open();
  link::Process mp(*bus, context_of("mp"));
  link::Outbox<supervisor_t> supervisor(*bus, mp.route("supervisor"), 1);
  const auto samples = mp.outbox<step_samples_t>("arm2.samples");
  const auto settings = mp.outbox<sensor_setting_t>("arm2.pen_state.setting");
  const auto readings = mp.inbox<sensor_reading_t>("arm2.pen_state");
  link::Queue<process_status_t> status(*bus, mp.route("vsp.status"), 1);
  link::ProcessState state{};
  mp.on_service = [&] {
    while (const auto s = status.take()) state = static_cast<link::ProcessState>(s->state);
  };
  const auto say = [&supervisor](link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor.publish(m, 0);
  };
  const auto await = [&mp](auto ready) {
    return mp.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  };
  const std::jthread sensor([&] {
    const auto own = hub.open();
    link::Process process(*own, context_of("vsp"));
    run_pen_state(process, Config::parse("[pen_state]\nF_filter = 0.0\n", "test"), {.arm = "arm2"});
  });
  EXPECT_TRUE(await([&] { return state == link::ProcessState::ready; }));
  say(link::Phase::running);
  for (std::int64_t i = 1; i <= 3; ++i) {
    settings->publish({}, i);
    step_samples_t m{};
    m.macrostep = i;
    m.n = 10;
    m.last = i == 3;
    for (auto& s : m.sample) s.F_a[2] = static_cast<double>(i);
    samples->publish(m, i);
    EXPECT_TRUE(await([&] { return readings->at(i) != nullptr; })) << i;
    if (readings->at(i) == nullptr) break;
    EXPECT_EQ(readings->at(i)->state, static_cast<int>(PenState::above_paper));
    EXPECT_EQ(readings->at(i)->value[2], static_cast<double>(i)) << "not filtered, as the configuration says";
  }
  EXPECT_TRUE(await([&] { return state == link::ProcessState::done; }));
  say(link::Phase::finished);
}

}  // namespace
}  // namespace mrroc::vsp
