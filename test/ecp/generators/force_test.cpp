#include "ecp/generators/force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/representation.hpp"
#include "ecp/generators/weighing.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

using std::numbers::pi;

/// F_a at W with E = W and no force tool, after a bias in the orientation R_a: -(raw - raw at the bias).
Wrench seen(const ForceTool& tool, const Matrix3& R_0W, const Matrix3& R_a) {
  const auto gravity = [&](const Matrix3& R) {
    const Vector3 f = R.transpose() * Vector3(0, 0, -tool.w);
    return Wrench::from(f, tool.P.cross(f));
  };
  return gravity(R_a) - gravity(R_0W);
}

TEST(Weighing, FindsRandomToolsInTheThreeOrientationsWhateverTheHeading) {
  RandomList random(1);
  for (int k = 0; k < 200; ++k) {
    const ForceTool tool{random.between(0.5, 30), Vector3(random.pose(3, 0.2))};
    const auto about_vertical = [&] { return rotation_from_angle_axis({0, 0, random.between(-3, 3)}); };
    const Matrix3 down = about_vertical() * rotation_from_angle_axis({pi, 0, 0});
    const Matrix3 up = about_vertical();
    const Matrix3 side = about_vertical() * rotation_from_angle_axis({0, -pi / 2, 0});
    ASSERT_NEAR((side * Vector3::UnitX()).z(), 1, 1e-12) << "x_W up";
    const ForceTool found = identified_tool(seen(tool, up, down), seen(tool, side, down));
    EXPECT_NEAR(found.w, tool.w, 1e-12);
    EXPECT_NEAR((found.P - tool.P).norm(), 0, 1e-12);
  }
}

TEST(Weighing, RestsForASecondAndReadsForTwoUnlessToldOtherwise) {
  const WeighingPlan plan;
  EXPECT_NEAR(plan.settling * plan.pacing.macrostep_s(), 1, 1e-12);
  EXPECT_NEAR(plan.readings * plan.pacing.macrostep_s(), 2, 1e-12);
}

TEST(Weighing, OfNothingGivesNothing) {
  const ForceTool found = identified_tool({{0, 0, 0.02, 0.01, 0.01, 0}}, {});
  EXPECT_EQ(found.w, 0);
  EXPECT_EQ(found.P, Vector3::Zero());
}

struct Memory {
  Weighing weighing;
};
struct Agent : ArmAgent<Memory> {};

TEST(Weighing, RowsMoveRestBiasAndSetInThisOrder) {
  Agent::X x;
  x.e.joints = {0.1, -1.5, 0.1, 0, 0, 0};
  WeighingPlan& plan = x.c.weighing.plan;
  plan.down = plan.up = plan.side = Coordinates::Zero(6);
  plan.limits = default_limits(Representation::joints, 6);
  plan.settling = 3;
  plan.readings = 4;
  x.e.F_a = {{0, 0, 10, 0, 0, 0}};
  std::vector<std::string> said;
  for (const Motion<Agent>& row : WeighingRows<Agent>::rows(5)) {
    x.i_0 = x.i;
    x.c = row.f_entry(x);
    int macrosteps = 0;
    for (; !row.f_tau(x) && macrosteps < 10'000; ++macrosteps, ++x.i) {
      const EffectorCommand e = row.f_ce(x);
      if (e.instruction == Instruction::set && e.robot_model.set_force_tool)
        said.emplace_back(e.robot_model.weight > 0 ? "set" : "bias");
      if (has(e.set, Part::arm) && macrosteps == 0) said.emplace_back("move");
      x.c = row.f_cc(x);
    }
    EXPECT_LT(macrosteps, 10'000) << row.name;
  }
  EXPECT_EQ(said, (std::vector<std::string>{"move", "bias", "move", "move", "set"}));
  EXPECT_EQ(x.c.weighing.found.w, 5);
}

/// Random are the orientations.
WeighingPlan random_plan(RandomList& random) {
  WeighingPlan plan;
  plan.down = random.pose(6, 1);
  plan.up = random.pose(6, 1);
  plan.side = random.pose(6, 1);
  plan.limits = default_limits(Representation::joints, 6);
  plan.velocity = 0.5;
  plan.acceleration = 0.2;
  plan.settling = 7;
  plan.readings = 4;
  plan.T_WE.p = {0.1, 0.2, 0.3};
  plan.pacing = {.dt = 0.002, .n_s = 20, .n_Q = 19};
  return plan;
}

/// What F_a is with the hand up and to the side, after a bias with the hand down.
struct Readings {
  Wrench up, side;
};

Readings readings_with(const ForceTool& tool) {
  Readings r;
  r.up[Axis::z] = 2 * tool.w;
  r.up[Axis::ax] = 2 * tool.w * tool.P.y();
  r.up[Axis::ay] = -2 * tool.w * tool.P.x();
  r.side[Axis::ay] = tool.w * (tool.P.z() - tool.P.x());
  return r;
}

TEST(Weighing, RowsGoToTheThreeOrientationsAndFindTheToolEveryTime) {
  RandomList random(2);
  Agent::X x;
  const WeighingPlan plan = random_plan(random);
  x.c.weighing.plan = plan;
  const std::map<int, Coordinates> goals{{0, plan.down}, {3, plan.up}, {6, plan.side}};
  for (int time = 0; time < 3; ++time) {
    const ForceTool tool{random.between(0.5, 30), Vector3(random.pose(3, 0.2))};
    const auto [F_b, F_c] = readings_with(tool);
    EffectorCommand last;
    int k = 0;
    for (const Motion<Agent>& row : WeighingRows<Agent>::rows(5)) {
      EXPECT_EQ(row.m, 5 + k);
      const Coordinates from = joints_of(x.e, 6);
      x.i_0 = x.i;
      x.c = row.f_entry(x);
      int macrosteps = 0;
      for (; !row.f_tau(x) && macrosteps < 10'000; ++macrosteps, ++x.i) {
        const EffectorCommand e = row.f_ce(x);
        EXPECT_EQ(has(e.set, Part::arm), goals.contains(k)) << row.name;
        if (e.robot_model.set_force_tool) last = e;
        if (has(e.set, Part::arm)) {
          const Coordinates q = axes_from_numbers(e.arm.pose, 6);
          std::copy(q.begin(), q.end(), x.e.joints.begin());
          EXPECT_EQ(e.arm.representation, Representation::joints);
          EXPECT_EQ(e.arm.n_s, 20);
          EXPECT_EQ(e.arm.n_Q, 19);
        }
        x.e.F_a = k == 5 ? F_b : k == 8 ? F_c : Wrench{{50, 50, 50, 50, 50, 50}};
        x.e.F_a[Axis::ay] += macrosteps % 2 == 0 ? 1 : -1;  // noise, of which the mean is zero
        x.c = row.f_cc(x);
      }
      if (goals.contains(k)) {
        EXPECT_EQ(joints_of(x.e, 6), goals.at(k)) << row.name;
        const Trapezoid way(from, {{goals.at(k), 0.5, 0.2}}, plan.limits, 0.04);
        EXPECT_EQ(macrosteps, way.arrivals().back()) << "at the plan's speed";
      } else {
        EXPECT_EQ(macrosteps, k == 2 || k == 9 ? 2 : k == 5 || k == 8 ? 4 : 7) << row.name;
      }
      ++k;
    }
    EXPECT_NEAR(x.c.weighing.found.w, tool.w, 1e-12);
    EXPECT_NEAR((x.c.weighing.found.P - tool.P).norm(), 0, 1e-9);
    EXPECT_EQ(last.robot_model.weight, x.c.weighing.found.w);
    EXPECT_EQ(last.robot_model.mass_centre[2], x.c.weighing.found.P.z());
    EXPECT_TRUE(last.robot_model.set_tool);
    EXPECT_EQ(last.robot_model.tool, numbers_from_pose(Representation::frame, plan.T_WE));
  }
}

TEST(Force, GuidedIsContactWithoutForceAlongTheAxesGiven) {
  constexpr TaskFrameCommand kFrame = guided({Axis::x, Axis::az});
  static_assert(kFrame.x == c(0, 20, 0.005) && kFrame.az == c(0, 0.5, 0.1) && kFrame.y == u());
  for (const Axis a : kAxes) EXPECT_EQ(guided()[a].b, Behaviour::contact);
}

TEST(Force, ApproachSettlesAtTheForceAsked) {
  static_assert(approach(Axis::z, 0.01, 4).z == g(0.01, 5, 0.0025));
  constexpr TaskFrameCommand kBack = approach(Axis::x, -0.02, -5);
  EXPECT_DOUBLE_EQ(kBack.x.velocity / kBack.x.mobility, -5);
  EXPECT_GT(kBack.x.mobility, 0);
  EXPECT_EQ(kBack.y, u());
}

TEST(Force, ContactIsCountedInSuccession) {
  int n = 0;
  for (const double F : {3.0, 3.7, 3.7, 1.0, 3.7}) n = in_contact(n, F, 4);
  EXPECT_EQ(n, 1);
  EXPECT_EQ(in_contact(4, -3.7, -4), 5);
  EXPECT_EQ(in_contact(4, 3.7, -4), 0);
  EXPECT_EQ(in_contact(0, 3.61, 4), 1);
  EXPECT_EQ(in_contact(7, 3.59, 4), 0) << "nine tenths";
  EXPECT_EQ(in_contact(0, 2.1, 4, 0.5), 1);
  EXPECT_EQ(in_contact(0, 1.9, 4, 0.5), 0);
}

/// The tool against an edge whose outward normal points in the direction `normal`, all angles about z.
Wrench pushed(double frame, double normal, double force) {
  const double inward = normal + pi - frame;
  return {{force * std::cos(inward), force * std::sin(inward), 0, 0, 0, 0}};
}

TEST(EdgeFollowing, TurnsXIntoTheEdgeInOneStep) {
  const EdgeRule rule;
  RandomList random(2);
  for (int k = 0; k < 100; ++k) {
    const double frame = random.between(-3, 3), off = random.between(-1.4, 1.4);
    const EdgeStep step = follow_edge(rule, frame, pushed(frame, frame + off - pi, 4), frame);
    EXPECT_NEAR(step.angle, frame + off, 1e-12);
    EXPECT_NEAR(step.frame.y.velocity, 0.008, 1e-12);
    EXPECT_EQ(step.frame.x, c(4, 20, 0.005));
  }
}

TEST(EdgeFollowing, TooMuchForceTurnsTheWayOutward) {
  for (const double sense : {1.0, -1.0}) {
    EdgeRule rule;
    rule.speed_per_force *= sense;
    const EdgeStep step = follow_edge(rule, 0, pushed(0, pi, 5), 0);
    const double outward = -std::sin(step.angle) * step.frame.y.velocity;  // x of the way along y
    EXPECT_LT(outward, 0) << "away from the edge, which lies on the side of +x";
  }
}

TEST(EdgeFollowing, IsAsTheRuleSays) {
  const EdgeRule rule{
      .force = 6, .I = 11, .B = 0.02, .speed_per_force = 0.003, .turn_per_force = 0.1, .least_force = 2};
  const EdgeStep step = follow_edge(rule, 0.5, {{3, 4, 0, 0, 0, 0}}, 9);
  EXPECT_EQ(step.frame.x, c(6, 11, 0.02));
  EXPECT_NEAR(step.frame.y.velocity, 0.015, 1e-12);
  EXPECT_EQ(step.frame.z, u());
  EXPECT_NEAR(step.angle, 0.5 + std::atan2(4, 3) - 0.1, 1e-12) << "a newton too little turns it inward";
  EXPECT_EQ(follow_edge(rule, 0.5, {{1.9, 0, 0, 0, 0, 0}}, 9).angle, 9);
  EXPECT_NE(follow_edge(rule, 0.5, {{2.1, 0, 0, 0, 0, 0}}, 9).angle, 9);
}

TEST(EdgeFollowing, AnImpactIsNoReasonToTurnAwayFromTheEdge) {
  const EdgeRule rule;
  const auto turned = [&](double force) { return follow_edge(rule, 0, pushed(0, pi, force), 0); };
  EXPECT_NEAR(turned(6).angle, 0.4, 1e-12);
  EXPECT_EQ(turned(30).angle, turned(6).angle);
  EXPECT_EQ(turned(30).frame.y.velocity, turned(6).frame.y.velocity);
}

TEST(EdgeFollowing, IsSlowerOnAnEdgeThatIsHitHarderPressesAsMuchAndIsBetterDamped) {
  EXPECT_EQ(share_after_impact(3.9, 2), 1);
  EXPECT_NEAR(share_after_impact(8, 2), 0.25, 1e-12) << "four times as stiff";
  const EdgeRule rule, slow = slowed(rule, 0.25);
  EXPECT_EQ(slow.force, rule.force);
  EXPECT_EQ(slow.I, rule.I);
  EXPECT_EQ(slow.B * std::sqrt(4 * slow.I), rule.B * std::sqrt(rule.I) / 2)
      << "half the damping's inverse, four times the stiffness";
  EXPECT_EQ(slow.speed_per_force / slow.B, rule.speed_per_force / rule.B)
      << "what the force lacks along the edge";
}

TEST(EdgeFollowing, KeepsItsDirectionWhenItFeelsNothing) {
  const EdgeStep step = follow_edge({}, 0.3, {{0.1, 0.2, 0, 0, 0, 0}}, 0.7);
  EXPECT_EQ(step.angle, 0.7);
  EXPECT_EQ(step.frame.x, c(4, 20, 0.005)) << "and goes back to the edge";
}

}  // namespace
}  // namespace mrroc::ecp
