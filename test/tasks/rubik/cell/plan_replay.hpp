// A plan carried out on paper: every state of every motion is visited, and hands, core and stickers are followed.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "ecp/generators/polyline.hpp"
#include "ecp/generators/trajectory.hpp"
#include "sim/cube.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/plan/plan.hpp"

namespace mrroc::rubik {

/// Follows a plan by forward kinematics alone and expects what every plan has to keep.
class PlanReplay {
 public:
  PlanReplay(const CubePlanCell& cell, const Plan& plan)
      : cell_(cell), joints_(plan.start_joints), grasp_(plan.start) {}

  /// @param visit  called with every state; 1 cm or less apart at the wrist
  void run(const Plan& plan, const std::function<void(const CellState&)>& visit) {
    for (const Step& step : plan.steps) {
      EXPECT_EQ(step.before_grasp, grasp_);
      if (step.before.size() == 2 && step.before[1].delay) follow_both(step.before[0], step.before[1], visit);
      for (const FreeMotion& motion : step.before) follow(motion, motion.hand == grasp_.hand, visit);
      if (step.shows)
        show(step, visit);
      else
        meet(step, visit);
    }
    EXPECT_EQ(plan.end, grasp_);
    for (const Hand hand : kHands) expect_at(hand, plan.end_joints[index(hand)]);
  }

  Cube cube;                ///< solved at the beginning
  std::vector<Face> shown;  ///< in their order
  int together{};           ///< motions of both arms at the same time

 private:
  [[nodiscard]] Pose hand(Hand h) const { return cell_.forward(h, joints_[index(h)]); }
  [[nodiscard]] Pose core() const { return hand(grasp_.hand) * cube_in_hand(grasp_); }
  void expect_at(Hand h, const AxisVector& joints) const {
    EXPECT_LT((joints_[index(h)] - joints).cwiseAbs().maxCoeff(), 1e-6);
  }

  void follow(const FreeMotion& motion, bool carries, const std::function<void(const CellState&)>& visit,
              bool touched = false) {
    ASSERT_GE(motion.points.size(), 2u);
    EXPECT_EQ(motion.carries, carries);
    expect_at(motion.hand, motion.points.front().joints);
    for (std::size_t k = 1; k < motion.points.size(); ++k) {
      const Waypoint& point = motion.points[k];
      EXPECT_LT((cell_.joints(motion.hand, point.motors) - point.joints).cwiseAbs().maxCoeff(), 1e-6);
      expect_speed(motion.hand, motion.points[k - 1], point);
      go(motion.hand, point.joints, carries, touched && k == 1, visit);
    }
  }

  /// Both arms at the times at which they are driven; then they are where they were.
  void follow_both(const FreeMotion& first, const FreeMotion& second,
                   const std::function<void(const CellState&)>& visit) {
    constexpr double kSpacing = 0.017;
    const double end = *second.delay + second.seconds;
    EXPECT_NE(first.hand, second.hand);
    EXPECT_GE(*second.delay, 0);
    EXPECT_GE(end, first.seconds) << "it comes before the cube is there";
    const std::array curves{curve(first), curve(second)};
    CellState state{joints_, {kOpenJaws, kOpenJaws}, grasp_, false};
    state.jaws[index(grasp_.hand)] = sim::kCubeEdge;
    for (const double ahead : {-kLag, 0.0, kLag})
      for (double t = 0; t < end; t += kSpacing) {
        state.joints[index(first.hand)] = cell_.joints(first.hand, curves[0]->at(t + ahead));
        state.joints[index(second.hand)] = cell_.joints(second.hand, curves[1]->at(t - *second.delay));
        visit(state);
      }
    if (first.seconds > 0) ++together;
  }
  [[nodiscard]] std::unique_ptr<ecp::Polyline> curve(const FreeMotion& motion) const {
    std::vector<ecp::ViaPoint> list;
    for (std::size_t k = 1; k < motion.points.size(); ++k)
      list.push_back({motion.points[k].motors, motion.points[k].speed, 1, k + 1 < motion.points.size()});
    return std::make_unique<ecp::Polyline>(motion.points[0].motors, list, cell_.limits(motion.hand).motors,
                                           ecp::Pacing{}.macrostep_s());
  }

  /// What the drivers of the task let pass: 250 rad/s of the motors, 1.5 m/s and 4 rad/s of E.
  void expect_speed(Hand h, const Waypoint& from, const Waypoint& to) const {
    const AxisVector displacement = to.motors - from.motors;
    const double seconds =
        displacement.cwiseAbs().cwiseQuotient(cell_.limits(h).motors.velocity).maxCoeff() / to.speed;
    EXPECT_LE(displacement.cwiseAbs().maxCoeff(), 250 * seconds + 1e-9);
    constexpr int kParts = 50;
    Pose before = cell_.forward(h, from.joints);
    for (int k = 1; k <= kParts; ++k) {
      const Pose now =
          cell_.forward(h, cell_.joints(h, from.motors + displacement * (static_cast<double>(k) / kParts)));
      const Vector6 r = angle_axis_from_pose(before.inverse() * now);
      EXPECT_LE(r.head<3>().norm(), 1.5 * seconds / kParts + 1e-9);
      EXPECT_LE(r.tail<3>().norm(), 4 * seconds / kParts + 1e-9);
      before = now;
    }
  }

  void go(Hand h, const AxisVector& to, bool carries, bool touched,
          const std::function<void(const CellState&)>& visit) {
    constexpr int kParts = 37;
    const AxisVector from = cell_.motors(h, joints_[index(h)]), displacement = cell_.motors(h, to) - from;
    for (int k = 0; k <= kParts; ++k) {
      CellState state{joints_, {}, grasp_, touched};
      state.joints[index(h)] = cell_.joints(h, from + displacement * (static_cast<double>(k) / kParts));
      state.jaws[index(grasp_.hand)] = sim::kCubeEdge;
      state.jaws[index(other(grasp_.hand))] = carries && touched ? sim::kCubeEdge : kOpenJaws;
      EXPECT_GE(cell_.joint_limit_margin(h, state.joints[index(h)]), 0);
      visit(state);
    }
    joints_[index(h)] = to;
  }

  void show(const Step& step, const std::function<void(const CellState&)>& visit) {
    for (const Hand h : kHands) expect_at(h, step.contact[index(h)]);
    const Pose T_UC = core();
    const Viewing& viewing = *cell_.viewing();
    const Vector3 middle = T_UC * (sim::kCubeEdge / 2 * normal(*step.shows));
    EXPECT_LT((middle - viewing.T_UG.p).norm(), 1e-6);
    EXPECT_LT((T_UC.R * normal(*step.shows) - viewing.T_UG.R.col(2)).norm(), 1e-6);
    EXPECT_LT((viewing.T_UG.R * step.R_GC - T_UC.R).norm(), 1e-6);
    // Its edges are along those of the place.
    EXPECT_NEAR(step.R_GC.cwiseAbs().maxCoeff(), 1, 1e-6);
    CellState state{joints_, {kOpenJaws, kOpenJaws}, grasp_, false, true};
    state.jaws[index(grasp_.hand)] = sim::kCubeEdge;
    visit(state);
    shown.push_back(*step.shows);
  }

  void meet(const Step& step, const std::function<void(const CellState&)>& visit) {
    const Hand comes = step.comes;
    ASSERT_EQ(comes, other(grasp_.hand));
    const Pose T_UC = core();
    // The guarded approach: along z, and then the palm is on the cube.
    const Pose T_EK = hand(comes).inverse() * cell_.forward(comes, step.contact[index(comes)]);
    EXPECT_LT((T_EK.p - Vector3(0, 0, kApproachDistance)).norm(), 1e-6);
    EXPECT_LT((T_EK.R - Matrix3::Identity()).norm(), 1e-6);
    go(comes, step.contact[index(comes)], false, true, visit);
    for (const Hand h : kHands) expect_at(h, step.contact[index(h)]);
    EXPECT_LT(((hand(comes) * cube_in_hand(step.grasp)).p - T_UC.p).norm(), 1e-6);
    EXPECT_LT(((hand(comes) * cube_in_hand(step.grasp)).R - T_UC.R).norm(), 1e-6);

    std::array<Grasp, 2> grasps;
    grasps[index(grasp_.hand)] = grasp_;
    grasps[index(comes)] = step.grasp;
    if (step.turn) turn(step, grasps, visit);

    grasp_ = grasps[index(other(step.leaves))];
    EXPECT_EQ(step.after_grasp, grasp_);
    EXPECT_EQ(step.retreat.hand, step.leaves);
    const Pose before = hand(step.leaves);
    follow(step.retreat, false, visit, true);
    const Pose back = before.inverse() * hand(step.leaves);
    EXPECT_LT((back.p - Vector3(0, 0, -kRetreatDistance)).norm(), 1e-6);
    for (const Hand h : kHands) expect_at(h, step.after[index(h)]);
  }

  /// The postument keeps its layer, the track arm takes the rest along.
  void turn(const Step& step, std::array<Grasp, 2>& grasps,
            const std::function<void(const CellState&)>& visit) {
    const Pose keeper = hand(Hand::postument);
    EXPECT_LT((keeper.R.col(2) + hand(Hand::track).R.col(2)).norm(), 1e-6) << "palms are not opposite";
    const Face face = face_along(cube_axes(Hand::track, grasps).col(2));
    EXPECT_EQ(face, grasps[index(Hand::postument)].palm);
    EXPECT_EQ(face, step.turn->face());

    AxisVector to = joints_[index(Hand::track)];
    to[to.size() - 1] += step.angle;
    grasp_ = grasps[index(Hand::track)];
    go(Hand::track, to, true, true, visit);
    const double quarters = step.angle / (std::numbers::pi / 2);
    EXPECT_NEAR(quarters, std::round(quarters), 1e-9);
    // Seen from outside the rest goes counterclockwise, so the face clockwise.
    const int clockwise = (static_cast<int>(std::lround(quarters)) + 4) % 4;
    cube = cube * cube::turn(Move(face, clockwise));
    grasps[index(Hand::postument)] = grasp_from(Hand::postument, keeper.R.transpose() * core().R);
  }
  /// @return axes of E of a hand in C
  [[nodiscard]] static Matrix3 cube_axes(Hand h, const std::array<Grasp, 2>& grasps) {
    return cube_in_hand(grasps[index(h)]).R.transpose();
  }

  const CubePlanCell& cell_;
  ArmJoints joints_;
  Grasp grasp_;
};

}  // namespace mrroc::rubik
