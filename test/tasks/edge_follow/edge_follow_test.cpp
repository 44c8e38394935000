#include "tasks/edge_follow/edge_follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

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

}  // namespace
}  // namespace mrroc::edge_follow
