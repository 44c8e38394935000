// The coordinator's memory during teach-in: MS (37)-(40).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "base/representation.hpp"
#include "test/tasks/drawing/coordinator_image.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using enum PenState;

AngleAxisPose random_step(std::mt19937& random) {
  std::normal_distribution<> n;
  AngleAxisPose r;
  for (int k = 0; k < 6; ++k) r[k] = 1e-3 * n(random);
  return r;
}

constexpr double kMacrostep = 0.02;  // [s]
constexpr double kSpeed = 0.02;      // of the hand [m/s]

/// A pen that is led around a circle, at 20 mm/s of task time.
Pose on_the_way(double task_time) {
  constexpr double kRadius = 0.02;
  const double angle = kSpeed * kMacrostep / kRadius * task_time;
  return {rotation_from_angle_axis({0, 0, 0.3}),
          Vector3(0.8, 0.1, 0.3) + kRadius * Vector3(std::cos(angle), std::sin(angle), 0)};
}

/// What the hand does in one macrostep of a pause.
using InPause = std::function<void(X&)>;

struct Pause {
  int begin{}, length{};  ///< [macrosteps]
};

/// Teaches until so much task time has been reported, with a hand that goes by task time, too. @return what was recorded
Recording taught(double task_time, const std::vector<Pause>& pauses, const InPause& in_pause) {
  X x = image(paper_surface);
  give_pose(x, on_the_way(0));
  x.c = row(2).f_entry(x);
  double led = 0;  // task time of the hand, as it is reported
  for (int i = 0; led < task_time - 1e-9; ++i) {
    x.T.h.paused =
        std::ranges::any_of(pauses, [i](const Pause& p) { return i >= p.begin && i < p.begin + p.length; });
    note_pause(x);
    const double pace = row(2).f_cc(x).paces.front();
    led += pace;
    x.T.agent[0].sensor = static_cast<int>(paper_surface);
    give_pose(x, on_the_way(led));
    if (pace == 0) in_pause(x);
    finish(x, 2);
  }
  return x.c.recording;
}

void expect_near(const Recording& a, const Recording& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].pen, b[n].pen) << n;
    EXPECT_LT((a[n].velocity.vector() - b[n].velocity.vector()).norm(), 0.01 * kSpeed) << n;
  }
}

Pose end_of(const Recording& recording, const Pose& begin) {
  Pose T = begin;
  for (std::size_t n = 0; n < recording.size(); ++n)
    T = T * pose_from_angle_axis(recording[n].velocity.vector() * kMacrostep);
  return T;
}

TEST(TeachIn, RecordedVelocitiesTelescopeToThePose) {  // (39), (40)
  std::mt19937 random(1);
  X x = image(paper_surface);
  Pose T = pose_from_angle_axis((AngleAxisPose() << 0.8, 0.1, 0.3, 2.9, 0.4, -0.2).finished());
  give_pose(x, T);
  x.c = row(1).f_entry(x);
  EXPECT_TRUE(x.c.recording.empty());
  EXPECT_EQ(x.c.p, 0);
  x.c = row(1).f_cc(x);
  x.c = row(2).f_entry(x);
  const Pose T_touch = T;
  std::vector<PenState> pens;
  for (int k = 0; k < 500; ++k) {
    T = T * pose_from_angle_axis(random_step(random));
    give_pose(x, T);
    const PenState pen = kPenStates[random() % 4];
    x.T.agent[0].sensor = static_cast<int>(pen);
    pass(x, 2);
    pens.push_back(pen);
  }
  ASSERT_EQ(x.c.recording.size(), 500U);
  for (std::size_t n = 0; n < pens.size(); ++n) {
    const PenState pen = pens[n];
    EXPECT_EQ(x.c.recording[n].pen, pen);
  }
  const Pose sum = end_of(x.c.recording, T_touch);
  EXPECT_LT((sum.p - T.p).norm(), 1e-9);
  EXPECT_LT((sum.R - T.R).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(x.c.recording.macrostep_s(), kMacrostep);
}

TEST(TeachIn, NothingOfAPauseIsRecordedWhateverTheHandDoes) {
  constexpr int kNodes = 400;
  const Recording unpaused = taught(kNodes, {}, [](X&) {});
  ASSERT_EQ(unpaused.size(), static_cast<std::size_t>(kNodes));
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::vector<Pause> pauses;
    for (int begin = 5 + static_cast<int>(random() % 150); begin < kNodes;
         begin += pauses.back().length + 25 + static_cast<int>(random() % 150))
      pauses.push_back({begin, 1 + static_cast<int>(random() % 300)});
    // It trembles by a millimetre under force, and goes away and comes back.
    const Recording paused = taught(kNodes, pauses, [&](X& x) {
      const Pose T = pose_of(x.T.agent[0]);
      give_pose(x, T * pose_from_angle_axis(random_step(random) * (1 + random() % 30)));
    });
    expect_near(paused, unpaused);
  }
}

TEST(TeachIn, TaskTimeThatGoesSlowlyIsRecordedInShares) {
  // Never quite at rest: pauses shorter than the ten macrosteps in which task time comes to a standstill.
  const Recording unpaused = taught(300, {}, [](X&) {});
  std::vector<Pause> pauses;
  for (int begin = 7; begin < 400; begin += 23) pauses.push_back({begin, 1 + begin % 9});
  const Recording slow = taught(300, pauses, [](X&) { ADD_FAILURE() << "at rest"; });
  ASSERT_GE(slow.size() + 1, unpaused.size());
  for (std::size_t n = 0; n < slow.size(); ++n)
    EXPECT_LT((slow[n].velocity.vector() - unpaused[n].velocity.vector()).norm(), 0.01 * kSpeed) << n;
}

TEST(TeachIn, ALiftOffInAPauseEndsTheStrokeAsItDoesOnTheSheet) {
  for (const PenState off : {lift_off, above_paper}) {
    int left = 0;
    const Recording r = taught(100, {{40, 60}}, [&](X& x) {
      if (++left == 20) x.T.agent[0].sensor = static_cast<int>(off);  // and comes down again
    });
    ASSERT_EQ(r.size(), 100U) << to_string(off);
    std::size_t lifted = 0;
    for (std::size_t n = 0; n < r.size(); ++n) lifted += r[n].pen != paper_surface;
    EXPECT_EQ(lifted, 1U) << to_string(off);
    EXPECT_EQ(r[47].pen, lift_off) << "in the node in which task time stood";
  }
}

TEST(TeachIn, AHandThatWentElsewhereInAPauseIsJoinedSlowlyAndWithoutInkIfThePenWasOffThePaper) {
  const Vector3 away(0.03, -0.04, 0);
  for (const bool lifted : {false, true}) {
    SCOPED_TRACE(lifted);
    X x = image(paper_surface);
    const Pose T_begin = on_the_way(0);
    Pose T = T_begin;
    give_pose(x, T);
    x.c = row(2).f_entry(x);
    const auto lasts = [&x](int macrosteps, bool paused) {
      x.T.h.paused = paused;
      for (int k = 0; k < macrosteps; ++k) pass(x, 2);
    };
    lasts(20, false);
    lasts(20, true);
    const std::size_t before = x.c.recording.size();
    if (lifted) x.T.agent[0].sensor = static_cast<int>(lift_off);
    lasts(10, true);
    T.p += away;
    give_pose(x, T);
    x.T.agent[0].sensor = static_cast<int>(paper_surface);
    lasts(100, true);
    EXPECT_EQ(x.c.recording.size(), before) << "task time stands";
    lasts(30, false);
    const Recording& r = x.c.recording;
    std::size_t moving = 0;
    for (std::size_t n = 0; n < r.size(); ++n) {
      const double speed = r[n].velocity.vector().head<3>().norm();
      EXPECT_LE(speed, 0.0501) << n;
      moving += speed > 1e-6;
      const bool last = n + 1 == r.size() || r[n + 1].velocity.vector().head<3>().norm() < 1e-6;
      if (speed > 1e-6 && !last) {
        EXPECT_EQ(r[n].pen, lifted ? lift_off : paper_surface) << n;
      }
    }
    EXPECT_NEAR(static_cast<double>(moving), 50, 1) << "50 mm at 50 mm/s";
    EXPECT_LT((end_of(r, T_begin).p - T.p).norm(), 1e-9);
  }
}

/// Teaches a line, and lets the pen say `pens` in the pause and from then on. @return what was recorded
Recording interrupted(const std::vector<PenState>& pens, std::size_t of_these_in_the_pause) {
  X x = image(paper_surface);
  double led = 0;
  give_pose(x, on_the_way(led));
  x.c = row(2).f_entry(x);
  const auto lasts = [&](int macrosteps, PenState pen, bool paused) {
    x.T.h.paused = paused;
    x.T.agent[0].sensor = static_cast<int>(pen);
    for (int k = 0; k < macrosteps; ++k) {
      note_pause(x);
      led += row(2).f_cc(x).paces.front();
      give_pose(x, on_the_way(led));
      finish(x, 2);
    }
  };
  lasts(50, paper_surface, false);
  lasts(20, paper_surface, true);
  for (std::size_t k = 0; k < pens.size(); ++k) lasts(1, pens[k], k < of_these_in_the_pause);
  lasts(60, pens.back(), false);
  lasts(50, paper_surface, false);
  return x.c.recording;
}

std::size_t nodes_of(const Recording& recording, PenState pen) {
  std::size_t nodes = 0;
  for (std::size_t n = 0; n < recording.size(); ++n) nodes += recording[n].pen == pen;
  return nodes;
}

TEST(TeachIn, AStrokeIsKeptWhoseLiftOffFellInAPauseThatEndedInLowering) {
  const std::vector<PenState> pens{lift_off, above_paper, lowering};
  for (std::size_t in_the_pause = 0; in_the_pause <= pens.size(); ++in_the_pause) {
    SCOPED_TRACE(in_the_pause);  // fewer: slow task time has no node for them
    const Recording r = interrupted(pens, in_the_pause);
    EXPECT_EQ(nodes_of(r, lift_off), 1U);
    EXPECT_GT(nodes_of(r, lowering), 40U);
    EXPECT_EQ(without_false_touches(r), r) << "no stroke is taken for a false touch";
  }
}

TEST(TeachIn, AFalseTouchInAPauseIsStillNone) {
  const Recording r = interrupted({lowering}, 1);
  EXPECT_EQ(nodes_of(r, lift_off), 0U);
  EXPECT_NE(without_false_touches(r), r);
}

TEST(TeachIn, AHandOfConstantSpeedIsNotRecordedFasterThanItGoes) {
  for (const double speed : {0.005, 0.02, 0.08})
    for (const int length : {3, 9, 40}) {
      SCOPED_TRACE(testing::Message() << speed << " m/s, pause of " << length);
      X x = image(paper_surface);
      const Pose T_begin = on_the_way(0);
      Pose T = T_begin;
      give_pose(x, T);
      x.c = row(2).f_entry(x);
      for (int i = 0; i < 200; ++i) {
        x.T.h.paused = i >= 50 && i < 50 + length;
        T.p += Vector3(0.6, 0.8, 0) * speed * kMacrostep;  // whatever task time does
        give_pose(x, T);
        pass(x, 2);
      }
      const Recording& r = x.c.recording;
      const double joining = length > 13 ? 0.0501 : 0;
      for (std::size_t n = 0; n < r.size(); ++n)
        EXPECT_LE(r[n].velocity.vector().head<3>().norm(), std::max(1.11 * speed, joining)) << n;
      EXPECT_LT((end_of(r, T_begin).p - T.p).norm(), speed * kMacrostep);
    }
}

TEST(TeachIn, APenThatRestsInAPauseLeavesNoNodes) {
  X x = image(paper_surface);
  give_pose(x, Pose{});
  x.c = row(2).f_entry(x);
  x.T.h.paused = true;
  for (int k = 0; k < 13; ++k) pass(x, 2);
  const std::size_t nodes = x.c.recording.size();
  EXPECT_EQ(nodes, 7U) << "3 that were on their way, and 0.9 + 0.8 + ... + 0.1 macrosteps of task time";
  for (int k = 0; k < 100; ++k) pass(x, 2);
  EXPECT_EQ(x.c.recording.size(), nodes);
  give_pose(x, {Matrix3::Identity(), Vector3(1e-3, 0, 0)});  // and one that moves none either
  EXPECT_EQ(row(2).f_cc(x).recording.size(), nodes);
}

/// One macrostep in which task time goes at a pace below one. Ways are of the pen, in mm along x; a node lasts 20 ms.
struct Slowly {
  double pace, usual, way, share;  ///< usual: at full pace
  double nodes;                    ///< that the macrostep is
};

TEST(TeachIn, AMacrostepIsAsManyNodesAsItsPaceOrAsThePenNeedsForItsWay) {
  for (const Slowly& s : {Slowly{0.5, 1, 0.4, 0.1, 0.5},  // by the pace
                          {0.5, 2, 1.6, 0.1, 0.8},        // the way is 0.8 of the usual one
                          {0.2, 0.5, 0.44, 0.1, 0.8},     // up to a tenth faster than usual
                          {0.2, 0.1, 0.5, 0.1, 1},    // one node at most, for a hand that is slow as a rule
                          {0.5, 2, 3, 0.1, 1.5},      // a way that was gone in a pause
                          {0.5, 0.1, 1.5, 0.3, 1.5},  // ... at 50 mm/s when the hand is slow
                          {0.5, 1, 0, 0.7, 0.5}}) {
    SCOPED_TRACE(testing::Message() << s.pace << " " << s.usual << " " << s.way);
    X x = image(paper_surface);
    give_pose(x, Pose{});
    x.c = row(2).f_entry(x);
    x.c.paces.fill(s.pace);
    x.t.pace = s.pace;
    x.c.way = 1e-3 * s.usual;
    x.c.share = s.share;
    give_pose(x, {Matrix3::Identity(), Vector3(1e-3 * s.way, 0, 0)});
    const auto c = row(2).f_cc(x);
    const double until = s.share + s.nodes;
    ASSERT_EQ(c.recording.size(), static_cast<std::size_t>(until));
    EXPECT_NEAR(c.share, until - std::floor(until), 1e-12);
    EXPECT_EQ(c.way, 1e-3 * s.usual) << "known from full pace alone";
    EXPECT_NEAR(c.T_seen.p.x(), 1e-3 * s.way, 1e-15);
    for (std::size_t n = 0; n < c.recording.size(); ++n) {
      const double part = n == 0 ? 1 - s.share : 1;  // of a node that is new in this macrostep
      EXPECT_NEAR(c.recording[n].velocity[Axis::x], part * 1e-3 * s.way / s.nodes / kMacrostep, 1e-12) << n;
    }
  }
}

TEST(TeachIn, AtFullPaceTheWayIsRemembered) {
  X x = image(paper_surface);
  give_pose(x, Pose{});
  x.c = row(2).f_entry(x);
  give_pose(x, {Matrix3::Identity(), Vector3(0, 3e-3, 4e-3)});
  const auto c = row(2).f_cc(x);
  EXPECT_NEAR(c.way, 5e-3, 1e-15);
  EXPECT_EQ(c.share, 0);
  EXPECT_EQ(c.recording.size(), 1U);
}

}  // namespace
}  // namespace mrroc::drawing
