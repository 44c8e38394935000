#include "sim/camera/object_path.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mrroc::sim {
namespace {

ObjectParameters moving(ObjectMotion motion) {
  ObjectParameters p;
  p.kind = ObjectKind::chessboard;
  p.motion = motion;
  p.T_0G = {rotation_from_angle_axis({0, 0, 0.4}), {0.9, 0.1, 0.93}};
  p.start = 0.5;
  return p;
}

Vector3 velocity(const ObjectPath& path, double t) {
  constexpr double h = 1e-4;
  return (path.at(t + h).T_0G.p - path.at(t - h).T_0G.p) / (2 * h);
}

TEST(ObjectPath, RestsWhereItIsPut) {
  const ObjectPath path(moving(ObjectMotion::rest));
  for (const double t : {0.0, 1.0, 100.0}) {
    EXPECT_EQ(path.at(t).T_0G.p, Vector3(0.9, 0.1, 0.93));
    EXPECT_TRUE(path.at(t).present);
    EXPECT_FALSE(path.at(t).hidden);
  }
}

TEST(ObjectPath, GoesAlongALineAndStopsAtItsEnd) {
  ObjectParameters p = moving(ObjectMotion::line);
  p.heading = std::numbers::pi / 2;
  const ObjectPath path(p);
  EXPECT_EQ(path.at(0.5).T_0G.p, p.T_0G.p);
  // 0.2 s to reach 0.1 m/s, on the way 0.01 m.
  EXPECT_LT((path.at(0.7).T_0G.p - p.T_0G.p - Vector3(0, 0.01, 0)).norm(), 1e-12);
  EXPECT_LT((path.at(1.7).T_0G.p - p.T_0G.p - Vector3(0, 0.11, 0)).norm(), 1e-12);
  EXPECT_LT((velocity(path, 2) - Vector3(0, 0.1, 0)).norm(), 1e-9);
  EXPECT_LT((path.at(0.5 + 3.2).T_0G.p - p.T_0G.p - Vector3(0, 0.3, 0)).norm(), 1e-12);
  EXPECT_EQ(path.at(50).T_0G.p, path.at(4).T_0G.p);
  EXPECT_LT((path.at(2).T_0G.R - p.T_0G.R).norm(), 1e-12);
}

TEST(ObjectPath, NeverGetsFastOnAShortLine) {
  ObjectParameters p = moving(ObjectMotion::line);
  p.length = 0.005;
  const ObjectPath path(p);
  const double top = std::sqrt(0.005 * p.acceleration);
  for (double t = 0.4; t < 1; t += 0.01) EXPECT_LE(velocity(path, t).norm(), top + 1e-9);
  EXPECT_NEAR((path.at(5).T_0G.p - p.T_0G.p).norm(), 0.005, 1e-12);
}

TEST(ObjectPath, GoesRoundACircleToItsLeftAndTurnsWithIt) {
  const ObjectParameters p = moving(ObjectMotion::circle);
  const ObjectPath path(p);
  const Vector3 centre = p.T_0G.p + Vector3(0, p.radius, 0);
  for (double t = 0; t < 10; t += 0.37) {
    const ObjectState s = path.at(t);
    EXPECT_NEAR((s.T_0G.p - centre).norm(), p.radius, 1e-12);
    EXPECT_TRUE(is_proper(s.T_0G));
    // Seen from the object, the centre stays where it is.
    EXPECT_LT((s.T_0G.inverse() * centre - p.T_0G.inverse() * centre).norm(), 1e-12);
  }
  EXPECT_NEAR(velocity(path, 3).norm(), 0.1, 1e-6);
  EXPECT_GT(velocity(path, 0.52).x(), 0);
}

TEST(ObjectPath, FollowsAHandSmoothlyWithinItsReach) {
  ObjectParameters p = moving(ObjectMotion::hand);
  const ObjectPath path(p);
  EXPECT_EQ(path.at(0.5).T_0G.p, p.T_0G.p);
  double farthest = 0;
  for (double t = 0; t < 20; t += 0.01) {
    const ObjectState s = path.at(t);
    const Vector3 d = s.T_0G.p - p.T_0G.p;
    EXPECT_LE(d.cwiseAbs().maxCoeff(), 1.4 * p.reach);
    EXPECT_GE(d.z(), 0) << "not into the table";
    EXPECT_LT(velocity(path, t).norm(), 0.5);
    EXPECT_LT((velocity(path, t + 0.01) - velocity(path, t)).norm(), 0.05) << "no jerk at " << t;
    EXPECT_TRUE(is_proper(s.T_0G));
    farthest = std::max(farthest, d.norm());
  }
  EXPECT_GT(farthest, p.reach / 2);
  EXPECT_EQ(path.at(7).T_0G.p, ObjectPath(p).at(7).T_0G.p);
  ++p.seed;
  EXPECT_NE(path.at(7).T_0G.p, ObjectPath(p).at(7).T_0G.p);
}

TEST(ObjectPath, ComesLateAndIsHiddenForATime) {
  ObjectParameters p = moving(ObjectMotion::rest);
  p.absent_until = 2;
  p.hidden_from = 3;
  p.hidden_for = 1;
  const ObjectPath path(p);
  EXPECT_FALSE(path.at(1.99).present);
  EXPECT_TRUE(path.at(2).present);
  EXPECT_FALSE(path.at(2.99).hidden);
  EXPECT_TRUE(path.at(3).hidden);
  EXPECT_TRUE(path.at(3.99).hidden);
  EXPECT_FALSE(path.at(4).hidden);
  const auto bodies = [&](double t) {
    camera::Scene scene;
    path.add_to(scene, Pose{}, path.at(t));
    return scene.bodies.size();
  };
  EXPECT_EQ(bodies(1), 0U);
  EXPECT_EQ(bodies(2.5), 2U);
  EXPECT_EQ(bodies(3.5), 3U);
}

TEST(ObjectPath, IsWhatItIsSaidToBe) {
  const auto texture_of = [](ObjectKind kind) {
    ObjectParameters p = moving(ObjectMotion::rest);
    p.kind = kind;
    const ObjectPath path(p);
    camera::Scene scene;
    path.add_to(scene, Pose{Matrix3::Identity(), {1, 0, 0}}, path.at(0));
    if (scene.bodies.empty()) return std::pair(0, 0);
    EXPECT_LT((scene.bodies.back().T_UB.p - Vector3(1.9, 0.1, 0.93)).norm(), 1e-12);
    return std::pair(scene.bodies.back().texture->width, scene.bodies.back().texture->height);
  };
  EXPECT_EQ(texture_of(ObjectKind::none), std::pair(0, 0));
  EXPECT_EQ(texture_of(ObjectKind::chessboard), std::pair(12 * 64, 9 * 64));
  EXPECT_EQ(texture_of(ObjectKind::wrong_board), std::pair(10 * 64, 7 * 64));
  EXPECT_EQ(texture_of(ObjectKind::apriltag), std::pair(12 * 64, 12 * 64));
}

TEST(ObjectPath, RefusesNumbersThatMeanNothing) {
  for (const auto& spoil : std::vector<void (*)(ObjectParameters&)>{
           [](ObjectParameters& p) { p.speed = -1; }, [](ObjectParameters& p) { p.acceleration = 0; },
           [](ObjectParameters& p) { p.radius = 0; }, [](ObjectParameters& p) { p.T_0G.R.setZero(); },
           [](ObjectParameters& p) { p.hidden_for = std::nan(""); }}) {
    ObjectParameters p = moving(ObjectMotion::rest);
    spoil(p);
    EXPECT_THROW(ObjectPath{p}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace mrroc::sim
