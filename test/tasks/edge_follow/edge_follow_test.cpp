#include "tasks/edge_follow/edge_follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <tuple>

#include "base/representation.hpp"
#include "edp/control_law.hpp"

namespace mrroc::edge_follow {
namespace {

using std::numbers::pi;
using X = Arm::X;

constexpr double kDt = 0.002;
constexpr double kStiffness = 1e4;  // [N/m]

/// Outward normal of an elastic edge at a point, and how deep the point is in it [m].
struct Edge {
  Eigen::Vector2d normal;
  double depth;
};

Edge disc(const Eigen::Vector2d& p) {
  const Eigen::Vector2d centre(0.1, 0);
  return {(p - centre).normalized(), 0.05 - (p - centre).norm()};
}

/// A square of 60 mm that a finger of 8 mm rolls along.
Edge square(const Eigen::Vector2d& p) {
  const Eigen::Vector2d centre(0.1, 0);
  const Eigen::Vector2d core = (p - centre).cwiseMax(-0.03).cwiseMin(0.03);
  const Eigen::Vector2d off = p - centre - core;
  return {off.normalized(), 0.008 - off.norm()};
}

/// An ideal arm on a table: it moves as law (28) says, its answers come as late as over the links.
class IdealArm {
 public:
  explicit IdealArm(Edge (*edge)(const Eigen::Vector2d&)) : edge_(edge) {}

  void dispatch(const Motion<Arm>&, const Arm::Y& y) { commands_.push_back(y.e); }
  Outcome wait() {
    execute(commands_.front());
    commands_.pop_front();
    return ++i_ < 10'000 ? Outcome::terminated : Outcome::aborted;
  }
  void read(X& x) {
    x.i = i_;
    const Vector6 r = angle_axis_from_pose(T_0E());
    std::ranges::copy(r, x.e.T_0E.begin());
    x.e.F_a = F_;
    if (F_.linear().norm() > 0) forces.push_back(F_.linear().norm());
    where.emplace_back(T_0W_.p.head<2>());
  }

  std::vector<double> forces;
  std::vector<Eigen::Vector2d> where;

 private:
  [[nodiscard]] Pose T_0E() const { return T_0W_ * T_WE_; }
  void execute(const EffectorCommand& e) {
    if (has(e.set, Part::robot_model)) {
      const Pose T_WE = *pose_from_numbers(e.robot_model.tool_representation, e.robot_model.tool);
      v_ = xi_star(T_WE.R.transpose() * T_WE_.R, v_);
      T_WE_ = T_WE;
    }
    if (!has(e.set, Part::arm)) return;
    for (int step = 0; step < e.arm.n_s; ++step) {
      const Edge edge = edge_(T_0W_.p.head<2>());
      const Eigen::Vector2d push = -std::max(0.0, edge.depth) * kStiffness * edge.normal;
      F_ = Wrench::from(T_0E().R.transpose() * Vector3(push.x(), push.y(), 0), Vector3::Zero());
      v_ = edp::step_velocity(e.arm.frame, F_, v_, kDt);
      T_0W_.p += kDt * (T_0E().R * v_.linear());
    }
  }

  Edge (*edge_)(const Eigen::Vector2d&);
  std::deque<EffectorCommand> commands_{{}};
  Pose T_0W_{rotation_from_angle_axis({pi, 0, 0}), Vector3::Zero()};  // the tool points down
  Pose T_WE_;
  Twist v_;
  Wrench F_;
  std::int64_t i_{};
};

class EdgeFollowTable : public testing::TestWithParam<std::pair<Edge (*)(const Eigen::Vector2d&), double>> {};

TEST_P(EdgeFollowTable, LeadsAnIdealArmOnceAroundAndBackToWhereItBegan) {
  IdealArm arm(GetParam().first);
  X x;
  arm.read(x);
  x.c.rule.speed_per_force = GetParam().second;
  for (const auto& row : kEdgeFollow) {
    arm.forces.clear();
    if (row.m == 2) arm.where.clear();
    ASSERT_EQ(move(row, x, arm), Outcome::terminated) << row.name;
    if (row.m != 2) continue;
    EXPECT_NEAR(std::abs(x.c.angle), 2 * pi, 0.4);
    double way = 0, square_error = 0;
    for (std::size_t k = 1; k < arm.where.size(); ++k) way += (arm.where[k] - arm.where[k - 1]).norm();
    EXPECT_GT(way, 0.24) << "around the plate";
    EXPECT_LT(way, 0.40);
    EXPECT_LT((arm.where.back() - arm.where.front()).norm(), 0.004);
    for (const double F : arm.forces) square_error += (F - 4) * (F - 4);
    EXPECT_LT(std::sqrt(square_error / static_cast<double>(arm.forces.size())), 0.4);
  }
  EXPECT_EQ(x.e.F_a.linear().norm(), 0) << "away from the edge";
}

INSTANTIATE_TEST_SUITE_P(Edges, EdgeFollowTable,
                         testing::Values(std::pair{&disc, 0.002}, std::pair{&disc, -0.002},
                                         std::pair{&square, 0.002}, std::pair{&square, -0.002}));

TEST(EdgeFollowFigures, AreOfTheForceAlongTheEdgePerArm) {
  mp::ArmTrace rows(4);
  rows[0].m = 1;
  rows[0].F[Axis::x] = 100;
  for (std::size_t k = 1; k < 4; ++k) {
    rows[k].m = 2;
    rows[k].t = static_cast<double>(k);
    rows[k].F[Axis::x] = 3;
    rows[k].F[Axis::y] = 4;  // 5 N, 1 N too much
    rows[k].F[Axis::z] = 50;
  }
  const auto f = figures({rows, rows}, Config());
  for (const char* key : {"edge_follow_rms_N", "edge_follow_mean_N", "edge_follow_peak_N", "edge_follow_s"})
    EXPECT_EQ(std::get<std::vector<double>>(figure(f, key)).size(), 2u) << key;
  EXPECT_NEAR(std::get<std::vector<double>>(figure(f, "edge_follow_rms_N"))[1], 1, 1e-12);
  EXPECT_NEAR(std::get<std::vector<double>>(figure(f, "edge_follow_peak_N"))[0], 5, 1e-12);
  EXPECT_NEAR(std::get<std::vector<double>>(figure(f, "edge_follow_s"))[0], 2, 1e-12);
}

TEST(EdgeFollowMemory, ComesFromTheConfiguration) {
  const Config config = Config::parse(
      "[task]\nforce = 6\n[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 10\n"
      "mass_centre = [0, 0, 0.1]\n",
      "test");
  const Memory c = read_memory(config, "arm1");
  EXPECT_EQ(c.rule.force, 6);
  EXPECT_EQ(c.rule.turn_per_force, 0.2);
  EXPECT_EQ(c.T_WE.p.z(), 0.25);
}

TEST(EdgeFollow, FiguresOfAnArmThatHasNotBegunAreNoNumbers) {
  for (const mp::TaskFigure& figure : figures({{}, {}}, Config()))
    for (const double x : std::get<std::vector<double>>(figure.value))
      EXPECT_TRUE(std::isnan(x)) << figure.info.key;
}

X at_pose(const Vector3& p, double turned = 0) {
  X x;
  const Vector6 r = angle_axis_from_pose({rotation_from_angle_axis({0, 0, turned}), p});
  std::ranges::copy(r, x.e.T_0E.begin());
  return x;
}

TEST(EdgeFollowRows, TheFingerPushesWhenItsContactLastsForMoreThanTenMacrosteps) {
  X x;
  x.c.rule.force = 4;
  for (int k = 0; k <= 20; ++k) {
    EXPECT_EQ(kEdgeFollow[0].f_tau(x), k > 10) << k;
    x.e.F_a[Axis::x] = 3;
    x.c = kEdgeFollow[0].f_cc(x);
  }
  x.e.F_a[Axis::x] = 0;
  x.c = kEdgeFollow[0].f_cc(x);
  EXPECT_FALSE(kEdgeFollow[0].f_tau(x)) << "and begins anew when it is lost";
}

TEST(EdgeFollowRows, ApproachAndRetreatAreAlongX) {
  X x;
  x.c.rule.force = 4;
  const EffectorCommand comes = kEdgeFollow[0].f_ce(x), leaves = kEdgeFollow[2].f_ce(x);
  EXPECT_EQ(comes.arm.frame.x.velocity, 0.01);
  EXPECT_DOUBLE_EQ(comes.arm.frame.x.velocity / comes.arm.frame.x.mobility, 2) << "half of the force";
  EXPECT_EQ(leaves.arm.frame.x, u(-0.02));
  for (const Axis a : kAxes)
    if (a != Axis::x) {
      EXPECT_EQ(comes.arm.frame[a].velocity, 0);
      EXPECT_EQ(leaves.arm.frame[a], u());
    }
  EXPECT_EQ(leaves.arm.n_s, kPacing.n_s);
  EXPECT_EQ(comes.arm.n_s, kPacing.n_s);
  x.i = 59;
  EXPECT_FALSE(kEdgeFollow[2].f_tau(x));
  x.i = 60;
  EXPECT_TRUE(kEdgeFollow[2].f_tau(x));
}

TEST(EdgeFollowRows, TheWayAroundBeginsWhereTheFingerPushes) {
  X x = at_pose({0.1, 0.2, 0.3}, 0.5);
  x.c.angle = 3;
  x.c.farthest = 1;
  x.c.pushing = 11;
  const Memory c = kEdgeFollow[1].f_entry(x);
  EXPECT_LT((c.T_0E.p - Vector3(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_NEAR(angle_axis_from_rotation(c.T_0E.R).z(), 0.5, 1e-12);
  EXPECT_EQ(c.angle, 0);
  EXPECT_EQ(c.farthest, 0);
}

TEST(EdgeFollowRows, TheRoundIsDoneAfterAFullTurnFarAwayAndBack) {
  const auto done = [](double angle, double farthest, double off) {
    X x = at_pose({off, 0, 5});  // heights do not count
    x.c.angle = angle;
    x.c.farthest = farthest;
    return kEdgeFollow[1].f_tau(x);
  };
  constexpr double kRound = 2 * pi - 0.3;
  for (const double way : {1.0, -1.0}) {
    EXPECT_TRUE(done(way * (kRound + 1e-6), 0.0101, 0.0019));
    EXPECT_FALSE(done(way * (kRound - 1e-6), 0.0101, 0.0019));
  }
  EXPECT_FALSE(done(7, 0.0099, 0.0019));
  EXPECT_FALSE(done(7, 0.0101, 0.0021));
}

TEST(EdgeFollowRows, TheFarthestPlaceIsRememberedAndTheAngleGoesOnBeyondATurn) {
  X x = at_pose({0.03, 0.04, 9}, 0.1);
  x.c.farthest = 0.02;
  EXPECT_NEAR(kEdgeFollow[1].f_cc(x).farthest, 0.05, 1e-12);
  x.c.farthest = 0.06;
  EXPECT_EQ(kEdgeFollow[1].f_cc(x).farthest, 0.06);
  const double once = kEdgeFollow[1].f_cc(x).angle;
  x.c.angle = 2 * pi;
  EXPECT_NEAR(kEdgeFollow[1].f_cc(x).angle, once + 2 * pi, 1e-9);
  x.c.angle = -2 * pi;
  EXPECT_NEAR(kEdgeFollow[1].f_cc(x).angle, once - 2 * pi, 1e-9);
}

TEST(EdgeFollowRows, TheToolIsTurnedWithTheAngle) {
  X x = at_pose({0, 0, 0}, 0.25);
  x.c.T_WE = {rotation_from_angle_axis({0, 0, 0}), {0, 0, 0.25}};
  x.c.angle = 0.25;
  x.e.F_a[Axis::x] = x.c.rule.force;
  const EffectorCommand command = kEdgeFollow[1].f_ce(x);
  ASSERT_TRUE(command.robot_model.set_tool);
  const Pose T = *pose_from_numbers(command.robot_model.tool_representation, command.robot_model.tool);
  EXPECT_NEAR(T.p.z(), 0.25, 1e-12);
  EXPECT_NEAR(angle_axis_from_rotation(T.R).z(), kEdgeFollow[1].f_cc(x).angle, 1e-9);
}

TEST(EdgeFollowFigures, OfUnevenForcesAreMeanErrorAndLargest) {
  mp::ArmTrace rows(3);
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k].m = 2;
    rows[k].t = 10 + static_cast<double>(k);
    rows[k].F[Axis::x] = std::array{3., 8., 4.}[k];
  }
  rows.emplace_back().m = 3;
  rows.back().t = 99;
  const auto f = figures({rows}, Config());
  const auto value = [&](const char* key) { return std::get<std::vector<double>>(figure(f, key))[0]; };
  EXPECT_NEAR(value("edge_follow_mean_N"), 5, 1e-12);
  EXPECT_NEAR(value("edge_follow_rms_N"), std::sqrt(17. / 3), 1e-12);
  EXPECT_EQ(value("edge_follow_peak_N"), 8);
  EXPECT_EQ(value("edge_follow_s"), 2);
  EXPECT_EQ(f[0].info.high, 0.5);
}

TEST(EdgeFollowMemory, HasBoundsForEveryNumber) {
  const auto allowed = [](const std::string& setting) {
    Config config;
    config.set("task." + setting);
    try {
      std::ignore = read_rule(config);
    } catch (const ConfigError&) {
      return false;
    }
    return true;
  };
  for (const char* good : {"force=1.0", "force=20.0", "speed_per_force=-0.01", "speed_per_force=0.01",
                           "turn_per_force=0.0", "turn_per_force=1.0"})
    EXPECT_TRUE(allowed(good)) << good;
  for (const char* bad : {"force=0.99", "force=20.1", "speed_per_force=-0.011", "speed_per_force=0.011",
                          "turn_per_force=-0.1", "turn_per_force=1.1"})
    EXPECT_FALSE(allowed(bad)) << bad;
}

}  // namespace
}  // namespace mrroc::edge_follow
