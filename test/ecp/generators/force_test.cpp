#include "ecp/generators/force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
        said.push_back(e.robot_model.weight > 0 ? "set" : "bias");
      if (has(e.set, Part::arm) && macrosteps == 0) said.emplace_back("move");
      x.c = row.f_cc(x);
    }
    EXPECT_LT(macrosteps, 10'000) << row.name;
  }
  EXPECT_EQ(said, (std::vector<std::string>{"move", "bias", "move", "move", "set"}));
  EXPECT_EQ(x.c.weighing.found.w, 5);
}

TEST(Force, GuidedIsContactWithoutForceAlongTheAxesGiven) {
  constexpr TaskFrameCommand frame = guided({Axis::x, Axis::az});
  static_assert(frame.x == c(0, 20, 0.005) && frame.az == c(0, 0.5, 0.1) && frame.y == u());
  for (const Axis a : kAxes) EXPECT_EQ(guided()[a].b, Behaviour::contact);
}

TEST(Force, ApproachSettlesAtTheForceAsked) {
  static_assert(approach(Axis::z, 0.01, 4).z == g(0.01, 5, 0.0025));
  constexpr TaskFrameCommand back = approach(Axis::x, -0.02, -5);
  EXPECT_DOUBLE_EQ(back.x.velocity / back.x.mobility, -5);
  EXPECT_GT(back.x.mobility, 0);
  EXPECT_EQ(back.y, u());
}

TEST(Force, ContactIsCountedInSuccession) {
  int n = 0;
  for (const double F : {3.0, 3.7, 3.7, 1.0, 3.7}) n = in_contact(n, F, 4);
  EXPECT_EQ(n, 1);
  EXPECT_EQ(in_contact(4, -3.7, -4), 5);
  EXPECT_EQ(in_contact(4, 3.7, -4), 0);
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

TEST(EdgeFollowing, KeepsItsDirectionWhenItFeelsNothing) {
  const EdgeStep step = follow_edge({}, 0.3, {{0.1, 0.2, 0, 0, 0, 0}}, 0.7);
  EXPECT_EQ(step.angle, 0.7);
  EXPECT_EQ(step.frame.x, c(4, 20, 0.005)) << "and goes back to the edge";
}

}  // namespace
}  // namespace mrroc::ecp
