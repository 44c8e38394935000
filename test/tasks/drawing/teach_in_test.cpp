// What the coordinator memorises while it is taught: MS (37)-(40).
#include <gtest/gtest.h>

#include <random>

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

TEST(TeachIn, RecordedVelocitiesTelescopeToThePose) {  // (39), (40)
  std::mt19937 random(1);
  for (const bool with_pause : {false, true}) {
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
      if (with_pause) x.T.h.paused = k > 100 && k < 300;
      const PenState pen = kPenStates[random() % 4];
      x.T.agent[0].sensor = static_cast<int>(pen);
      x.c = row(2).f_cc(x);
      pens.push_back(pen);
      T = T * pose_from_angle_axis(random_step(random));
      give_pose(x, T);
    }
    x.c = row(2).f_cc(x);
    pens.push_back(static_cast<PenState>(x.T.agent[0].sensor));
    ASSERT_EQ(x.c.recording.size(), 501U);
    Pose sum = T_touch;
    for (std::size_t n = 0; n < x.c.recording.size(); ++n) {
      const Node node = x.c.recording[n];
      EXPECT_EQ(node.pen, pens[n]);
      sum = sum * pose_from_angle_axis(node.velocity.vector() * 0.02);
    }
    EXPECT_LT((sum.p - T.p).norm(), 1e-9);
    EXPECT_LT((sum.R - T.R).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(x.c.recording.macrostep_s(), 0.02);
  }
}

TEST(TeachIn, APenThatRestsInAPauseLeavesNoNodes) {
  X x = image(paper_surface);
  give_pose(x, Pose{});
  x.c = row(2).f_entry(x);
  x.T.h.paused = true;
  for (int k = 0; k < 10; ++k) x.c = row(2).f_cc(x);
  const std::size_t nodes = x.c.recording.size();
  for (int k = 0; k < 100; ++k) x.c = row(2).f_cc(x);
  EXPECT_EQ(x.c.recording.size(), nodes);
  give_pose(x, {Matrix3::Identity(), Vector3(1e-3, 0, 0)});  // but a moving one does
  EXPECT_EQ(row(2).f_cc(x).recording.size(), nodes + 1);
}

}  // namespace
}  // namespace mrroc::drawing
