// Ways of a platform around boxes and other platforms.
#include "tasks/box_push/detour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/planar.hpp"
#include "test/tasks/box_push/halls.hpp"

namespace mrroc::box_push {
namespace {

constexpr double kReach = 0.55;

TEST(Detour, IsStraightWhereNothingStands) {
  const auto way = way_around(a_hall().room, {-2, 1}, {2, -1}, kReach);
  ASSERT_TRUE(way);
  EXPECT_EQ(way->points.size(), 2U);
  EXPECT_NEAR(way->length, std::hypot(4, 2), 1e-12);
}

TEST(Detour, KeepsItsDistanceFromWhatStandsThere) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-3, 3);
  for (int k = 0; k < 30; ++k) {
    Room room = a_hall().room;
    room.obstacles.push_back(rectangle({0, 0, angle(random)}, 0.5, 1.5));
    room.obstacles.push_back(rectangle({-1.6, 0.5, angle(random)}, 0.8, 0.66));
    const auto way = way_around(room, {-3.5, 0.4}, {3, 0.1}, kReach);
    ASSERT_TRUE(way) << k;
    EXPECT_GT(way->length, 6.5);
    EXPECT_LT(way->length, 9);
    for (std::size_t n = 1; n < way->points.size(); ++n)
      EXPECT_GE(clearance(room, way->points[n - 1], way->points[n]), kReach) << k;
  }
}

TEST(Detour, IsNoneIntoAnObstacle) {
  Room room = a_hall().room;
  room.obstacles.push_back(rectangle({}, 0.5, 1.5));
  EXPECT_FALSE(way_around(room, {-3, 0}, {0.5, 0}, kReach));
}

TEST(DriveAlong, TurnsAtEveryCornerAndEndsWithTheHeading) {
  const Way way{{{0, 0}, {1, 0}, {1, 1.5}}, 2.5};
  const auto all = drive_along(way, {0, 0, -1}, 3, {});
  const PlanarPose end = all.back().knot.back().p;
  EXPECT_NEAR(end.x, 1, 1e-9);
  EXPECT_NEAR(end.y, 1.5, 1e-9);
  EXPECT_NEAR(wrap_angle(end.phi - 3), 0, 1e-9);
  PathPoint before{{0, 0, -1}};
  for (const Fragment& f : all) {
    EXPECT_NEAR(distance(f.knot.front().p, before.p), 0, 1e-9);
    EXPECT_NEAR(f.knot.front().p.phi, before.p.phi, 1e-9);
    before = f.knot.back();
  }
}

}  // namespace
}  // namespace mrroc::box_push
