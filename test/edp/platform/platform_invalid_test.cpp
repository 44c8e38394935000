// Commands that must not be executed: nothing of the driver's state may change by them, and nothing that it sends is out of
// its bounds whatever comes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

#ifdef MRROC_SANITIZED
constexpr int kCommands = 10'000;
#else
constexpr int kCommands = 1'000'000;
#endif

/// @return a number that no fragment may have anywhere
double wrong_number(std::mt19937_64& random) {
  constexpr std::array kWrong{std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity(),
                              1e308,
                              -1e9,
                              1e6};
  return kWrong[random() % kWrong.size()];
}

/// Damages one thing of a good command to hand a fragment over.
void damage(PlatformCommand& c, std::mt19937_64& random) {
  const auto odd = [&] { return 1 + static_cast<std::int64_t>(random() % 1000); };
  Fragment& f = c.fragment;
  PathPoint& knot = f.knot[random() % kFragmentKnots];
  const std::array<double*, 5> numbers{&knot.p.x, &knot.p.y, &knot.p.phi, &knot.v, &knot.w};
  switch (random() % 12) {
    case 0:
      c.session += odd();
      break;
    case 1:
      c.number += odd();
      break;
    case 2:
      c.number -= 1 + odd();
      break;
    case 3:
      c.instruction = random() % 2 == 0 ? Instruction::get : Instruction::set_get;
      break;
    case 4:
      c.instruction = static_cast<Instruction>(8 + random() % 248);
      break;
    case 5:
      f.number += random() % 2 == 0 ? odd() : -odd();
      break;
    case 6:
      f.steps = static_cast<std::int32_t>(random() % 2 == 0 ? -odd() : kMaxFragmentSteps + odd());
      break;
    case 7:
      f.notify =
          static_cast<std::int32_t>(random() % 2 == 0 ? -kMaxFragmentSteps - odd() : f.steps + odd() - 1);
      break;
    case 8:
      for (PathPoint& moved : f.knot) moved.p.x += 0.2;
      break;
    case 9:
      for (PathPoint& turned : f.knot) turned.p.phi += 0.3;
      break;
    case 10:
      f.knot[3].v = random() % 2 == 0 ? 1.1 : -7;
      break;
    default:
      *numbers[random() % numbers.size()] = wrong_number(random);
      break;
  }
}

/// What a reply says about the platform, beyond the answer.
bool same(const PlatformReply& a, const PlatformReply& b) {
  return a.state == b.state && a.accepted == b.accepted && a.notified == b.notified &&
         a.executing == b.executing && a.iteration == b.iteration && a.remaining == b.remaining &&
         a.torque == b.torque && a.estimate.p.x == b.estimate.p.x && a.estimate.p.phi == b.estimate.p.phi;
}

TEST(PlatformInvalid, DamagedFragmentsAreNeverExecutedAndChangeNothing) {
  std::mt19937_64 random(1);
  PlatformRig rig;
  PlatformRig twin;
  ASSERT_TRUE(rig.synchronise() && twin.synchronise());
  long executed = 0;
  long refused = 0;
  long differ = 0;
  std::int64_t fragments = 0;
  for (int k = 0; k < kCommands / 10; ++k) {
    Way way(PathPoint{rig.driver.wanted().p, 0, 0});
    way.number = fragments;
    PlatformCommand c = rig.keep();
    c.number = rig.number + 1;
    c.instruction = Instruction::set;
    c.fragment = way.next(0.05, 0.1, 20);
    damage(c, random);
    const PlatformReply reply = rig.macrostep(c);
    const PlatformReply other = twin.wait(1);
    if (c.session == 7 && c.number == rig.number + 1) ++rig.number;  // used up
    executed += reply.verdict == Verdict::executed;
    refused += reply.verdict == Verdict::refused;
    differ += !same(reply, other);
    if (k % 50 == 49) {  // a good one, so that the platform moves
      if (rig.driver.state() == DriverState::executing) continue;
      Way good = rig.way();
      good.number = fragments++;
      const Fragment f = good.next(0.1, 0.2, 30);
      EXPECT_EQ(rig.macrostep(rig.set(f)).verdict, Verdict::executed);
      std::ignore = twin.macrostep(twin.set(f));
    }
  }
  EXPECT_EQ(executed, 0);
  EXPECT_EQ(differ, 0);
  EXPECT_EQ(refused, kCommands / 10);
  EXPECT_GT(fragments, 100 * (kCommands / 1'000'000));
}

TEST(PlatformInvalid, WhateverComesTorquesAndRepliesStayWithinTheirBounds) {
  std::mt19937_64 random(2);
  PlatformRig rig;
  ASSERT_TRUE(rig.synchronise());
  Way way = rig.way();
  for (int k = 0; k < 5; ++k) rig.macrostep(rig.set(way.next(0.3, 0.4, 320)));
  bool good = true;
  rig.after_each_step = [&] {
    for (const double torque : rig.last.torque) good = good && std::abs(torque) <= kMaxTorque;
  };
  for (int k = 0; k < kCommands / 10; ++k) {
    for (int j = 0; j < 10; ++j) {
      PlatformCommand c;
      std::array<std::uint64_t, sizeof(PlatformCommand) / 8> noise{};
      for (std::uint64_t& word : noise) word = random() % 8 == 0 ? 0 : random();
      std::memcpy(static_cast<void*>(&c), noise.data(), noise.size() * 8);
      c.session = 7;
      c.number = rig.driver.protocol().expected();
      c.instruction = static_cast<Instruction>(random() % 6);
      c.map.valid = random() % 2 == 0;  // a byte that is no bool is the message's affair
      c.odometry.valid = random() % 2 == 0;
      rig.driver.take(c);
    }
    const PlatformReply reply = rig.quiet();
    good = good && std::isfinite(reply.estimate.p.x) && std::isfinite(reply.estimate.v.vx);
    good = good && reply.accepted <= 5 && reply.state != DriverState::faulted;
    ASSERT_TRUE(good) << k << " " << rig.driver.fault().text.view();
  }
}

}  // namespace
}  // namespace mrroc::edp::test
