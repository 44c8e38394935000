// The place where the arms meet: both reach it in all quarter turns with margin, and their links keep clear.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "robots/irb6/arm.hpp"
#include "test/rig/cube_cell.hpp"

namespace mrroc::rubik {
namespace {

using std::numbers::pi;

struct Reached {
  AxisVector joints;
  double
      margin;  ///< from the limits of joints and motors, and from the wrist's singularity, over half the range
};

class Meeting : public testing::Test {
 protected:
  Meeting() : world(cube_cell({})) {
    for (const sim::ArmParameters& arm : world.arms) robots.push_back(irb6::make_arm(arm.type->name));
  }
  [[nodiscard]] Reached reach(int arm, const Pose& T_ME) const {
    const irb6::Arm& robot = *robots[static_cast<std::size_t>(arm)];
    const sim::ArmParameters& p = world.arms[static_cast<std::size_t>(arm)];
    const AxisVector near = Eigen::Map<const Eigen::VectorXd>(p.start.data(), robot.axes());
    const auto found =
        robot.inverse(p.T_UB.inverse() * meeting_place() * T_ME * robot.tool_in_wrist().inverse(), near);
    EXPECT_TRUE(found.reached);
    const AxisVector motors = robot.motors_from_joints(found.joints);
    double margin = 1;
    const auto keep = [&](double x, const edp::Range& range) {
      margin = std::min(margin, 2 * std::min(x - range.lower, range.upper - x) / (range.upper - range.lower));
    };
    for (int k = 0; k < robot.axes(); ++k) {
      keep(found.joints[k], robot.axis(k).joint);
      keep(motors[k], robot.axis(k).motor);
    }
    // The axes of T and N are parallel where q5 is a multiple of pi.
    margin = std::min(margin, 2 * (1 - std::abs(std::cos(found.joints[robot.axes() - 2]))));
    return {found.joints, margin};
  }
  /// @return shoulder, elbow, wrist, flange and hand of an arm in the world, and how thick the links between are
  [[nodiscard]] std::vector<Vector3> links(int arm, const AxisVector& q) const {
    const irb6::Arm& robot = *robots[static_cast<std::size_t>(arm)];
    const auto& k = robot.parameters().lengths;
    const int f = robot.parameters().first();
    const double theta3 = q[f + 1] + q[f + 2] + pi / 2;
    const Vector3 h(std::cos(q[f]), std::sin(q[f]), 0);
    const Vector3 shoulder(0, f == 1 ? q[0] : 0, k.z_offset);
    const Vector3 elbow = shoulder + k.a2 * (h * std::cos(q[f + 1]) - Vector3::UnitZ() * std::sin(q[f + 1]));
    const Vector3 wrist = elbow + k.a3 * (h * std::cos(theta3) - Vector3::UnitZ() * std::sin(theta3));
    const Pose T_0W = robot.forward(q);
    std::vector<Vector3> points{shoulder, elbow, wrist, T_0W.p, T_0W * Vector3(0, 0, 0.2)};
    for (Vector3& p : points) p = world.arms[static_cast<std::size_t>(arm)].T_UB * p;
    return points;
  }

  sim::WorldParameters world;
  std::vector<std::unique_ptr<irb6::Arm>> robots;
};

double distance(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  double least = 1e9;
  constexpr int kPoints = 40;
  for (int i = 0; i <= kPoints; ++i) {
    const Vector3 p = a + (b - a) * (static_cast<double>(i) / kPoints);
    const double s = std::clamp((p - c).dot(d - c) / (d - c).squaredNorm(), 0., 1.);
    least = std::min(least, (p - c - s * (d - c)).norm());
  }
  return least;
}

TEST_F(Meeting, IsReachedWithMarginInAllQuarterTurnsAndOnTheWayBack) {
  for (const int arm : {kPostument, kTrack})
    for (const double back : {0., 0.1})
      for (int quarter = -1; quarter <= 1; ++quarter) {
        const Pose turned{rotation_from_angle_axis({0, 0, quarter * pi / 2}), {0, 0, -back}};
        EXPECT_GT(reach(arm, grip(arm) * turned).margin, 0.35) << arm << ' ' << quarter << ' ' << back;
      }
}

TEST_F(Meeting, LeavesRoomBetweenTheArms) {
  // Links of at most 0.1 m radius; the hands meet on purpose, so the last one of each arm only counts against others.
  for (int quarter = -1; quarter <= 1; ++quarter) {
    const Pose turned{rotation_from_angle_axis({0, 0, quarter * pi / 2}), Vector3::Zero()};
    const auto a = links(kPostument, reach(kPostument, grip(kPostument)).joints);
    const auto b = links(kTrack, reach(kTrack, grip(kTrack) * turned).joints);
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
      for (std::size_t j = 0; j + 1 < b.size(); ++j) {
        const bool both_hands = i + 2 == a.size() && j + 2 == b.size();
        EXPECT_GT(distance(a[i], a[i + 1], b[j], b[j + 1]), both_hands ? 0.05 : 0.2) << i << ' ' << j;
      }
  }
}

}  // namespace
}  // namespace mrroc::rubik
