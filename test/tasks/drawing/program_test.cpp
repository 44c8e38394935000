// The coordinator's program over a plant of two ideal pens: the order of the behaviours, the end, and that a
// pause never changes what is drawn.
#include "tasks/drawing/program.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tasks/drawing/playback.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using enum PenState;

/// Two pens that do at once what they are ordered, above paper that is 10 mm deep; an operator who gives what
/// is asked for and pauses as told.
class Plant {
 public:
  std::function<bool(std::int64_t)> paused = [](std::int64_t) { return false; };
  int limit{100'000};  ///< macrosteps
  double paper{0.01};  ///< below the pen at first [m]

  std::vector<int> behaviours;               ///< one after another
  std::vector<std::array<double, 2>> drawn;  ///< way along x and y, per behaviour [m]
  bool arms_alike{true};

  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    if (behaviours.empty() || behaviours.back() != motion.m) {
      behaviours.push_back(motion.m);
      drawn.push_back({});
    }
    const TaskFrameCommand& frame = y.T[0].arm.frame;
    if (motion.m >= 4) {
      arms_alike = arms_alike && frame == y.T[1].arm.frame;
      drawn.back()[0] += frame.x.velocity * 0.02;
      drawn.back()[1] += frame.y.velocity * 0.02;
      depth_ = std::min(paper, depth_ + frame.z.velocity * 0.02);
      EXPECT_EQ(frame.z.force, motion.m == 5 ? 1 : 0);
    }
    m_ = motion.m;
  }
  Outcome wait() { return ++i_ < limit ? Outcome::terminated : Outcome::aborted; }
  void read(X& x) {
    x.i = i_;
    for (Report& r : x.T.agent) {
      r.ready = true;
      r.sensor = static_cast<int>(depth_ >= paper ? paper_surface : above_paper);
    }
    x.T.h.started = true;
    x.T.h.paused = paused(i_);
    if (m_ == 3 && !x.T.h.paused) x.T.h.trigger = 1;
    clock_.advance(x.T.h.paused);
    x.t = clock_.now();
  }

 private:
  double depth_{0};
  TaskClock clock_ = TaskClock::ramped();
  int m_{};
  std::int64_t i_{};
};

Recording recording(const std::vector<PenState>& pens, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> v(-0.05, 0.05);
  Recording r(0.02);
  for (const PenState pen : pens) r = r.appended({Twist{{v(random), v(random), v(random), 0, 0, 0}}, pen});
  return r;
}

std::vector<PenState> nodes(std::initializer_list<std::pair<PenState, int>> runs) {
  std::vector<PenState> pens;
  for (const auto& [pen, n] : runs) pens.insert(pens.end(), static_cast<std::size_t>(n), pen);
  return pens;
}

X start(const Recording& r) {
  X x;
  x.c.recording = r;
  x.T.h.started = true;
  for (Report& report : x.T.agent) report.ready = true;
  return x;
}

TEST(Program, DrawsStrokeAfterStrokeAndEndsWithALiftOff) {
  Plant plant;
  X x = start(recording(nodes({{paper_surface, 5}, {above_paper, 3}, {paper_surface, 4}})));
  EXPECT_EQ(run_program(x, plant), Outcome::terminated);
  EXPECT_EQ(plant.behaviours, (std::vector<int>{3, 4, 5, 6, 7, 4, 5, 6}));
  EXPECT_EQ(x.c.p, 12);
  EXPECT_TRUE(plant.arms_alike);
}

TEST(Program, ARecordingThatEndsInTheAirEndsThereAndNeverLowersAgain) {
  Plant plant;
  X x = start(recording(nodes({{paper_surface, 5}, {above_paper, 3}})));
  EXPECT_EQ(run_program(x, plant), Outcome::terminated);
  EXPECT_EQ(plant.behaviours, (std::vector<int>{3, 4, 5, 6, 7}));
  EXPECT_EQ(x.c.p, 8);
}

TEST(Program, EveryNodeIsExecutedOnceWithItsVelocity) {
  Plant plant;
  const Recording r = recording(
      nodes({{paper_surface, 7}, {lift_off, 1}, {above_paper, 9}, {lowering, 4}, {paper_surface, 3}}));
  X x = start(r);
  ASSERT_EQ(run_program(x, plant), Outcome::terminated);
  std::array<double, 2> expected{}, sum{};
  for (std::size_t n = 0; n < r.size(); ++n) {
    expected[0] += r[n].velocity[Axis::x] * 0.02;
    expected[1] += r[n].velocity[Axis::y] * 0.02;
  }
  for (const auto& way : plant.drawn) {
    sum[0] += way[0];
    sum[1] += way[1];
  }
  EXPECT_NEAR(sum[0], expected[0], 1e-12);
  EXPECT_NEAR(sum[1], expected[1], 1e-12);
}

TEST(Program, APauseAtAnyTimeNeverChangesWhatIsDrawn) {
  const Recording r = recording(nodes({{paper_surface, 37},
                                       {lift_off, 1},
                                       {above_paper, 22},
                                       {lowering, 3},
                                       {paper_surface, 1},
                                       {above_paper, 9},
                                       {paper_surface, 30}}),
                                5);
  Plant without;
  X x = start(r);
  ASSERT_EQ(run_program(x, without), Outcome::terminated);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<bool> paused;
    while (paused.size() < 5000)
      paused.insert(paused.end(), 1 + random() % 40, paused.empty() ? false : !paused.back());
    Plant plant;
    plant.paused = [&](std::int64_t i) {
      return i < static_cast<std::int64_t>(paused.size()) && paused[static_cast<std::size_t>(i)];
    };
    X y = start(r);
    ASSERT_EQ(run_program(y, plant), Outcome::terminated) << "seed " << seed;
    ASSERT_EQ(plant.behaviours, without.behaviours) << "seed " << seed;
    for (std::size_t k = 0; k < plant.drawn.size(); ++k)
      for (const std::size_t axis : {0, 1})
        EXPECT_NEAR(plant.drawn[k][axis], without.drawn[k][axis], 1e-12)
            << "seed " << seed << " behaviour " << k;
    EXPECT_EQ(y.c.p, static_cast<double>(r.size()));
  }
}

TEST(Program, AnyRecordingIsDrawnToItsEnd) {
  std::mt19937 random(7);
  for (int k = 0; k < 100; ++k) {
    std::vector<PenState> pens{paper_surface};
    while (pens.size() < 1 + random() % 60) pens.push_back(kPenStates[random() % 4]);
    Plant plant;
    X x = start(recording(pens));
    ASSERT_EQ(run_program(x, plant), Outcome::terminated);
    EXPECT_EQ(x.c.p, static_cast<double>(pens.size()));
    for (std::size_t b = 1; b < plant.behaviours.size(); ++b) {
      const int from = plant.behaviours[b - 1], to = plant.behaviours[b];
      EXPECT_TRUE((from == 3 && to == 4) || (from == 4 && to == 5) || (from == 5 && to == 6) ||
                  (from == 6 && to == 7) || (from == 7 && to == 4))
          << from << " -> " << to;
    }
  }
}

TEST(Program, SaysWhyThePortGaveUp) {
  for (const int limit : {1, 5, 20, 60, 100}) {
    Plant plant;
    plant.limit = limit;
    X x = start(recording(nodes({{paper_surface, 500}})));
    EXPECT_EQ(run_program(x, plant), Outcome::aborted) << limit;
  }
}

TEST(Playback, AtFullPaceOneNodeIsExecuted) {
  const Recording r = recording(nodes({{paper_surface, 3}}));
  const Advance a = advance(r, 1, 1, true);
  EXPECT_EQ(a.p, 2);
  EXPECT_EQ(a.vx, r[1].velocity[Axis::x]);
  EXPECT_EQ(a.vy, r[1].velocity[Axis::y]);
}

TEST(Playback, AtAnyPaceTheWayOfWholeNodesIsTheSame) {
  const Recording r = recording(nodes({{paper_surface, 50}}));
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    double p = 0, way = 0, expected = 0;
    for (int k = 0; p < 50 && k < 10000; ++k) {
      const Advance a = advance(r, p, 0.1 * static_cast<double>(random() % 11), true);
      EXPECT_GE(a.p, p);
      EXPECT_LE(a.p, p + 1 + 1e-9);
      p = a.p;
      way += a.vx;
    }
    for (std::size_t n = 0; n < r.size(); ++n) expected += r[n].velocity[Axis::x];
    EXPECT_EQ(p, 50);
    EXPECT_NEAR(way, expected, 1e-12);
  }
}

TEST(Playback, StopsInFrontOfANodeOfTheOtherKindAndAtTheEnd) {
  const Recording r = recording(nodes({{paper_surface, 2}, {above_paper, 2}}));
  EXPECT_EQ(advance(r, 1.5, 1, true).p, 2);
  EXPECT_EQ(advance(r, 2, 1, true).p, 2);
  EXPECT_EQ(advance(r, 2, 1, true).vx, 0);
  EXPECT_EQ(advance(r, 3.5, 1, false).p, 4);
  EXPECT_EQ(advance(r, 4, 1, false).p, 4);
  EXPECT_EQ(advance(r, 0, 0, true).p, 0);
  EXPECT_FALSE(next_node_is(r, 4, false));
  EXPECT_FALSE(next_node_is(r, 4, true));
  EXPECT_FALSE(next_node_is(Recording(0.02), 0, true));
}

TEST(Program, PensThatFindNoPaperAreAFault) {
  X x = start(recording(nodes({{paper_surface, 5}})));
  Plant plant;
  plant.paper = 1;
  EXPECT_EQ(run_program(x, plant), Outcome::faulted);
  EXPECT_TRUE(no_contact(x));
  EXPECT_EQ(plant.behaviours.back(), 4);
}

}  // namespace
}  // namespace mrroc::drawing
