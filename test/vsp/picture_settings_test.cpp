// Settings of receptors that look at pictures: which one is for a picture, and when it has come.
#include "vsp/picture_settings.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "base/fault.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert_cube_face.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kSteps = 10;  // of a macrostep

link::NodeContext context_of(const std::string& name, ClockKind clock) {
  link::NodeContext m;
  m.clock = clock;
  m.session = "settings" + std::to_string(getpid());
  m.name = name;
  m.roster = {"mp", "vsp-cube"};
  return m;
}

class Settings : public testing::Test {
 protected:
  explicit Settings(ClockKind clock = ClockKind::step)
      : mp_bus_(hub_.open()),
        own_bus_(hub_.open()),
        mp_(*mp_bus_, context_of("mp", clock)),
        own_(*own_bus_, context_of("vsp-cube", clock)),
        supervisor_(*mp_bus_, mp_.route("supervisor"), 1),
        link_(mp_, "cube.cube_face.setting"),
        settings_(own_, "cube.cube_face.setting", kSteps) {}

  /// The setting of macrostep i says place i.
  void send(std::int64_t from, std::int64_t to) {
    for (std::int64_t i = from; i <= to; ++i) {
      link_.set({.face = 1, .place = static_cast<int>(i)});
      link_.send(i);
    }
  }
  bool here(std::int64_t step) {
    own_.poll();
    return settings_.here(step);
  }
  int place(std::int64_t step) {
    own_.poll();
    return settings_.at(step).place;
  }
  void stop(std::int64_t as_of) {
    supervisor_t m{};
    m.phase = static_cast<int>(link::Phase::stopping);
    m.as_of = as_of;
    supervisor_.publish(m, 0);
  }

  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> mp_bus_, own_bus_;
  link::Process mp_, own_;
  link::Outbox<supervisor_t> supervisor_;
  link::OutgoingLink<CubeFaceSetting> link_;
  PictureSettings<CubeFaceSetting> settings_;
};

class HurriedSettings : public Settings {
 protected:
  HurriedSettings() : Settings(ClockKind::wall) {}
};

TEST_F(Settings, InLockStepThePictureOfAMacrostepWaitsForItsOwn) {
  EXPECT_TRUE(here(0) && here(9)) << "before the first macrostep nothing is set";
  EXPECT_FALSE(here(10));
  send(1, 1);
  EXPECT_TRUE(here(10) && here(19));
  EXPECT_FALSE(here(20));
  send(2, 3);
  EXPECT_TRUE(here(20) && here(39));
  EXPECT_FALSE(here(40));
}

TEST_F(Settings, APictureHasTheNewestThatIsNotAboveItsMacrostep) {
  EXPECT_EQ(settings_.at(5), CubeFaceSetting{}) << "nothing is asked";
  send(1, 4);
  EXPECT_EQ(place(9), -1);
  EXPECT_EQ(place(10), 1);
  EXPECT_EQ(place(19), 1);
  EXPECT_EQ(place(35), 3) << "the second one is passed over";
  send(6, 6);
  EXPECT_EQ(place(59), 4);
  EXPECT_EQ(place(60), 6);
  EXPECT_EQ(place(90), 6) << "it holds on";
  EXPECT_EQ(settings_.at(90).face, 1);
}

TEST_F(Settings, WhatHasBeenTakenIsNotWaitedForAgain) {
  send(1, 1);
  EXPECT_EQ(place(10), 1);
  EXPECT_FALSE(here(10)) << "there is one picture after the other";
}

TEST_F(Settings, NobodyWaitsForAnAgentThatHasEnded) {
  send(1, 2);
  link_.end();
  EXPECT_TRUE(here(20)) << "the last one";
  EXPECT_EQ(place(20), 2);
  EXPECT_FALSE(here(20));
  EXPECT_TRUE(here(30)) << "the first macrostep without one";
  EXPECT_TRUE(here(300));
  EXPECT_EQ(place(300), 2);
}

TEST_F(Settings, NobodyWaitsBehindTheMacrostepInWhichTheSystemStops) {
  EXPECT_FALSE(here(70));
  stop(5);
  EXPECT_FALSE(here(50)) << "in this one everybody still speaks";
  EXPECT_FALSE(here(59));
  EXPECT_TRUE(here(60));
  EXPECT_TRUE(here(70));
}

TEST_F(Settings, AnImproperOneIsAnErrorOfItsChannel) {
  link_.set({.face = 99, .place = 0});
  link_.send(1);
  try {
    (void)place(10);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::malformed_message);
    EXPECT_NE(std::string(e.what()).find("cube.cube_face.setting: a number is not proper"),
              std::string::npos);
  }
}

// An agent that is ahead by more than any camera's latency.
TEST_F(Settings, TenThousandAreKept) {
  for (std::int64_t i = 1; i <= 10'002; i += 3334) {
    send(i, i + 3333);
    (void)here(0);
  }
  EXPECT_TRUE(here(100'000));
  EXPECT_FALSE(here(100'010));
  EXPECT_EQ(place(100'020), 10'000);
}

TEST_F(HurriedSettings, NobodyWaits) {
  EXPECT_TRUE(here(10) && here(1000));
  send(1, 3);
  EXPECT_TRUE(here(90));
  EXPECT_EQ(place(29), 2);
  EXPECT_EQ(place(90), 3);
}

}  // namespace
}  // namespace mrroc::vsp
