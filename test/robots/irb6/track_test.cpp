// The arm on the track with the track as an active axis: one axis more than a pose has degrees of freedom.
#include <limits>

#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

class ActiveTrack : public Irb6 {
 protected:
  const TrackRule rule_ = arm_.parameters().track_rule;
  const int kept_ = rule_ == TrackRule::column_kept ? 1 : 6;
  const std::unique_ptr<Arm> still_ = make_arm(arm_.name(), model_number(GetParam().set));
  const double lower_ = arm_.joints_from_motors(ends(&edp::Range::lower))[0];
  const double upper_ = arm_.joints_from_motors(ends(&edp::Range::upper))[0];

  AxisVector ends(double edp::Range::*end) const {
    AxisVector m(7);
    for (int k = 0; k < 7; ++k) m[k] = arm_.axis(k).motor.*end;
    return m;
  }
  bool on_track(double x) const { return x >= lower_ - 1e-12 && x <= upper_ + 1e-12; }
  /// @return how level what decides the place of the track lies across it: 0 ill, 1 well conditioned
  double conditioning(const AxisVector& q) const {
    const double hand = rule_ == TrackRule::column_kept ? 1 : std::cos(q.segment(2, 3).sum() + kPi / 2);
    return std::abs(std::cos(q[1]) * hand);
  }
  /// @return joints with the pen straight down in front of the arm
  AxisVector pen_down() const {
    AxisVector near = arm_.front();
    near[0] = 0.5;
    near.tail<2>() << 4.712, 1.57;
    return still_->inverse(tool_down(0.90, 0.5, 0.92) * arm_.tool_in_wrist().inverse(), near).joints;
  }
  edp::InverseSolution pen_at(const Pose& T_0E, const AxisVector& near) const {
    return arm_.inverse(T_0E * arm_.tool_in_wrist().inverse(), near);
  }
};
INSTANTIATE_TEST_SUITE_P(Models, ActiveTrack, kTrackActive, arm_case_name);

TEST_P(ActiveTrack, AloneMovesForAWayAlongIt) {
  const AxisVector start = pen_down();
  AxisVector q = start;
  for (double y = 0.5; y < 1.2; y += 0.001) {
    const edp::InverseSolution s = pen_at(tool_down(0.90, y, 0.92), q);
    ASSERT_TRUE(s.reached);
    q = s.joints;
    ASSERT_NEAR(q[0], y, 1e-9);
    ASSERT_LE((q - start).tail<6>().cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_P(ActiveTrack, KeepsWhatItsRuleKeeps) {
  int moved = 0;
  for (int k = 0; k < kCases / 10; ++k) {
    const AxisVector near = random_joints();
    AxisVector q = near;
    for (int j = 0; j < 7; ++j)
      if (j != kept_) q[j] += uniform(-0.01, 0.01);
    if (conditioning(near) < 0.21 || conditioning(q) < 0.21 || !motors_legal(arm_, q)) continue;
    const edp::InverseSolution s = arm_.inverse(arm_.forward(q), near);
    ASSERT_TRUE(s.reached);
    ASSERT_LE((s.joints - q).cwiseAbs().maxCoeff(), 1e-9);
    ++moved;
  }
  EXPECT_GT(moved, kCases / 40);
}

// Without the track's help, but with its harm: a rule that would lead out of reach or limits stands back.
TEST_P(ActiveTrack, ReachesWhateverTheArmReachesWithTheTrackStill) {
  int reached = 0;
  for (int k = 0; k < kCases; ++k) {
    const Pose T = arm_.forward(random_joints());
    const AxisVector near = random_joints();
    const edp::InverseSolution still = still_->inverse(T, near), active = arm_.inverse(T, near);
    ASSERT_LE(active.missing, still.missing);
    ASSERT_TRUE(on_track(active.joints[0])) << active.joints.transpose();
    if (!still.reached) continue;
    ASSERT_LE(difference(arm_.forward(active.joints), T), 1e-9);
    if (!motors_legal(arm_, still.joints)) continue;
    ASSERT_TRUE(motors_legal(arm_, active.joints)) << active.joints.transpose();
    ++reached;
  }
  EXPECT_GT(reached, kCases / 20);
}

TEST_P(ActiveTrack, LeavesTheRestToTheArmAtTheEndOfTheTrack) {
  AxisVector q = pen_down();
  for (double y = 0.5; y < 1.6; y += 0.001) {
    const Pose T_0E = tool_down(0.90, y, 0.92);
    const edp::InverseSolution s = pen_at(T_0E, q);
    ASSERT_TRUE(s.reached);
    ASSERT_LE((s.joints - q).cwiseAbs().maxCoeff(), 0.01);
    ASSERT_LE(difference(arm_.forward(s.joints) * arm_.tool_in_wrist(), T_0E), 1e-9);
    q = s.joints;
    ASSERT_LE(q[0], upper_);
  }
  EXPECT_DOUBLE_EQ(q[0], upper_);
}

// Random walks that swing the column along the track and the hand upright, where the rules are ill-conditioned.
TEST_P(ActiveTrack, NeverJumpsOnAPath) {
  double worst_conditioning = 1;
  for (int walk = 0; walk < 50; ++walk) {
    AxisVector q = random_joints(), speed(7);
    AxisVector solved = q;
    for (double& v : speed) v = uniform(-0.0005, 0.0005);
    for (int k = 0; k < 3000; ++k) {
      q += speed;
      if (!motors_legal(arm_, q)) break;
      if (std::abs(std::sin(q[5])) < 0.05) break;  // there any wrist turns fast
      const Pose T = still_->forward(q);
      const edp::InverseSolution s = arm_.inverse(T, solved);
      ASSERT_TRUE(s.joints.allFinite());
      if (!s.reached) break;
      ASSERT_LE(difference(arm_.forward(s.joints), T), 1e-9);
      const double radius = std::hypot(T.p.x(), T.p.y() - s.joints[0]);
      if (radius < 0.2 || std::abs(std::sin(s.joints[5])) < 0.05) break;
      ASSERT_LE(std::abs(s.joints[0] - solved[0]), 0.02);
      ASSERT_LE((s.joints - solved).cwiseAbs().maxCoeff(), 0.1);
      worst_conditioning = std::min(worst_conditioning, conditioning(s.joints));
      solved = s.joints;
    }
  }
  EXPECT_LT(worst_conditioning, 0.1) << "no walk came where it matters";
}

TEST_P(ActiveTrack, IsNeverNotANumber) {
  constexpr std::array kStrange{std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(),
                                -1e308,
                                1e154,
                                9e5,
                                1e-308,
                                0.0};
  for (int k = 0; k < kCases / 4; ++k) {
    Pose T = arm_.forward(random_joints());
    AxisVector near = random_joints();
    const double x = kStrange[static_cast<std::size_t>(uniform(0, kStrange.size() - 1e-9))];
    switch (k % 3) {
      case 0:
        T.p[k % 3] = x;
        break;
      case 1:
        T.R(static_cast<int>(uniform(0, 3)), static_cast<int>(uniform(0, 3))) = x;
        break;
      default:
        near[static_cast<int>(uniform(0, 7))] = x;
    }
    const edp::InverseSolution s = arm_.inverse(T, near);
    ASSERT_TRUE(s.joints.allFinite()) << s.joints.transpose();
    ASSERT_FALSE(std::isnan(s.missing));
    ASSERT_EQ(s.reached, s.missing == 0);
  }
}

}  // namespace
}  // namespace mrroc::irb6::test
