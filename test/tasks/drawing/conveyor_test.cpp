// Drawing on a conveyor by value: who moves along y (MS 8.3), and how arms follow a belt that runs by itself.
#include "tasks/drawing/conveyor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tasks/drawing/belt_figures.hpp"
#include "test/tasks/drawing/coordinator_image.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using enum PenState;

/// Two arms with their pens there, and a conveyor.
X with_conveyor(PenState pens, bool belt_runs) {
  X x = image(pens, pens);
  x.T.agent.emplace_back();
  x.T.agent.back().ready = true;
  x.c.k.belt_runs = belt_runs;
  return x;
}
/// Puts the belt there, along y of E.
void put_belt(X& x, double y) { x.T.agent[kConveyor].T_0E[1] = -y; }

TEST(Conveyor, MovesByMinusVyInsteadOfTheArms) {
  for (const auto& [m, pen] : {std::pair(5, paper_surface), std::pair(7, above_paper)}) {
    X x = with_conveyor(pen, false);
    x.c.recording = recording({pen, pen});
    const X plain = [&, pen = pen] {
      X without = image(pen, pen);
      without.c.recording = x.c.recording;
      return without;
    }();
    const auto orders = row(m).f_cT(x);
    const auto alone = row(m).f_cT(plain);
    ASSERT_EQ(orders.size(), 3U);
    ASSERT_EQ(alone.size(), 2U);
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      EXPECT_EQ(orders[arm].arm.frame.y.velocity, 0) << m;
      EXPECT_EQ(orders[arm].arm.frame.x, alone[arm].arm.frame.x) << m;
      EXPECT_EQ(orders[arm].arm.frame.z, alone[arm].arm.frame.z) << m;
    }
    EXPECT_EQ(alone[0].arm.frame.y.velocity, -0.002) << m;
    EXPECT_EQ(orders[kConveyor].arm.frame.y.velocity, 0.002) << m;
    EXPECT_EQ(orders[kConveyor].arm.frame.x, u()) << m;
    EXPECT_EQ(orders[kConveyor].arm.frame.z, u()) << m;
  }
}

TEST(Conveyor, StandsWhileNobodyReproduces) {
  for (const bool runs : {false, true})
    for (const int m : {1, 2, 3, 4, 6}) {
      const X x = with_conveyor(above_paper, runs);
      EXPECT_EQ(row(m).f_cT(x)[kConveyor].arm.frame, kBlocked) << m;
    }
  const X x = with_conveyor(above_paper, false);
  EXPECT_EQ(row(3).f_cT(x)[0].arm.frame, kCompliant) << "the hand leads the arm along y as well";
}

TEST(Conveyor, TheTaskWaitsForItAsForTheArms) {
  X x = with_conveyor(above_paper, false);
  EXPECT_TRUE(kWaitForStart.f_tau(x));
  x.T.agent[kConveyor].ready = false;
  EXPECT_FALSE(kWaitForStart.f_tau(x));
}

TEST(BeltTrack, ForeseesABeltThatAcceleratesEvenlyExactly) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<> number(-0.1, 0.1);
  for (int k = 0; k < 200; ++k) {
    const double p = number(random), v = number(random), a = number(random);
    const auto at = [&](double t) { return p + v * t + a * t * t; };
    BeltTrack track;
    for (const double t : {-2.0, -1.0, 0.0}) track = seen_at(track, at(t));
    for (const double ahead : {0.0, 1.0, horizon(10)}) EXPECT_NEAR(foreseen(track, ahead), at(ahead), 1e-12);
  }
}

TEST(BeltTrack, LooksAsFarAheadAsAnOrderIsUnderWay) { EXPECT_NEAR(horizon(10), 4.1, 1e-12); }

TEST(BeltTrack, OrdersAddUpToTheWayOfTheBeltWhateverItDoes) {
  std::mt19937_64 random(12);
  std::normal_distribution<> jerk(0, 1e-5);
  BeltTrack track;
  double p = 0.3, v = 0;
  for (int k = 0; k < 3; ++k) track = seen_at(track, p);
  for (int k = 0; k < 5000; ++k) {
    v += jerk(random);
    p += v;
    track = follow(seen_at(track, p), 4.1);
  }
  for (int k = 0; k < 3; ++k) track = follow(seen_at(track, p), 4.1);  // it has stopped
  EXPECT_NEAR(track.start, 0.3, 1e-4);
  EXPECT_NEAR(track.followed, p - track.start, 1e-12) << "no error adds up";
}

TEST(RunningBelt, IsAddedToWhatTheArmsDoInEveryBehaviourOfReproduction) {
  for (const int m : {4, 5, 6, 7}) {
    const PenState pen = m == 5 ? paper_surface : above_paper;
    X x = with_conveyor(pen, true);
    x.c.recording = recording({pen, pen});
    X plain = image(pen, pen);
    plain.c.recording = x.c.recording;
    constexpr double kWay = 0.002;  // in a macrostep: 0.1 m/s
    double belt = 0.5;
    for (int k = 0; k < 10; ++k) {
      put_belt(x, belt += kWay);
      x.c.belt = row(m).f_cc(x).belt;
    }
    put_belt(x, belt + kWay);
    const auto orders = row(m).f_cT(x);
    const auto alone = row(m).f_cT(plain);
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      EXPECT_NEAR(orders[arm].arm.frame.y.velocity - alone[arm].arm.frame.y.velocity, 0.1, 1e-9) << m;
      EXPECT_EQ(orders[arm].arm.frame.x, alone[arm].arm.frame.x) << m;
      EXPECT_EQ(orders[arm].arm.frame.z, alone[arm].arm.frame.z) << m;
    }
  }
}

TEST(RunningBelt, IsFollowedInAPauseToo) {
  X x = with_conveyor(paper_surface, true);
  x.c.recording = recording({paper_surface, paper_surface});
  x.t.pace = 0;
  double belt = 0;
  for (int k = 0; k < 10; ++k) {
    put_belt(x, belt += 0.002);
    x.c.belt = row(5).f_cc(x).belt;
  }
  put_belt(x, belt + 0.002);
  EXPECT_NEAR(row(5).f_cT(x)[0].arm.frame.y.velocity, 0.1, 1e-9);
  EXPECT_EQ(row(5).f_cT(x)[0].arm.frame.x.velocity, 0);
}

TEST(BeltSchedule, StartsAndStopsWithoutAJumpAndComesBack) {
  for (const double speed : {0.01, 0.05, 0.1}) {
    const BeltSchedule schedule(speed, 0.02);
    double way = 0, farthest = 0, fastest = 0, before = 0;
    for (int i = 0; i < 190; ++i) {  // to and fro: 3.8 s
      const double v = schedule.velocity(i);
      EXPECT_LE(std::abs(v - before), 0.05 * speed) << i;
      way += 0.02 * v;
      farthest = std::max(farthest, way);
      fastest = std::max(fastest, v);
      before = v;
    }
    EXPECT_NEAR(way, 0, 1e-9) << "the sheets stay within reach, however long it runs";
    EXPECT_LE(farthest, 0.1);
    EXPECT_NEAR(fastest, speed, 1e-3 * speed);
  }
}

TEST(RunningBelt, StandsUntilTheArmsReproduceAndRunsUntilTheTaskIsOver) {
  Belt::X x;
  x.c = {.speed = 0.1, .dt = 0.002, .n_s = 10};
  for (const int m : {0, 1, 2, 3}) {
    x.T.m = m;
    EXPECT_FALSE(kBeltStands.f_tau(x)) << m;
  }
  EXPECT_EQ(kBeltStands.f_ce(x).arm.frame.y.velocity, 0);
  x.T.m = 4;
  EXPECT_TRUE(kBeltStands.f_tau(x));
  x.i = 42;
  EXPECT_NEAR(kBeltRuns.f_ce(x).arm.frame.y.velocity, -0.1, 1e-12) << "y of E is against the belt's";
  EXPECT_FALSE(kBeltRuns.f_tau(x));
  x.T.finished = true;
  EXPECT_TRUE(kBeltRuns.f_tau(x));
}

TEST(BeltFigures, TheDrawingIsInItsPlaceWhereTheNodesLeadFromTheStart) {
  constexpr double kT = 0.02;
  Recording recording(kT);
  const auto node = [&](double vx, double vy, PenState pen) {
    recording = recording.appended({Twist::from({vx, vy, 0}, {0, 0, 0}), pen});
  };
  node(0.05, 0, paper_surface);
  node(0.05, 0.1, paper_surface);
  node(0, 0.1, above_paper);
  node(-0.05, 0, paper_surface);
  const Drawing drawing = drawing_in_place(recording, {10, 20});
  ASSERT_EQ(drawing.size(), 2U) << "a stroke for each stretch on the paper";
  ASSERT_EQ(drawing[0].size(), 3U);
  EXPECT_LT((drawing[0].front() - Point(10, 20)).norm(), 1e-9);
  EXPECT_LT((drawing[0].back() - Point(12, 22)).norm(), 1e-9) << "x of E is y of the sheet";
  EXPECT_LT((drawing[1].front() - Point(14, 22)).norm(), 1e-9);
  EXPECT_LT((drawing[1].back() - Point(14, 21)).norm(), 1e-9);
}

TEST(ConveyorOptions, RefuseABeltThatHardlyRuns) {
  for (const double speed : {0.001, 0.0099}) {
    Config config;
    for (const std::string& setting : conveyor_settings({.conveyor = false, .belt_speed = speed}))
      config.set(setting);
    EXPECT_THROW(static_cast<void>(read_belt_speed(config)), FaultError) << speed;
  }
}

TEST(ConveyorOptions, StandForAConfigurationThatSaysTheSame) {
  EXPECT_TRUE(conveyor_settings({}).empty());
  for (const ConveyorOptions& o :
       {ConveyorOptions{.conveyor = true}, ConveyorOptions{.conveyor = false, .belt_speed = 0.05}}) {
    Config config;
    for (const std::string& setting : conveyor_settings(o)) config.set(setting);
    EXPECT_TRUE(has_conveyor(config));
    EXPECT_EQ(read_belt_speed(config), o.belt_speed.value_or(0));
  }
}

}  // namespace
}  // namespace mrroc::drawing
