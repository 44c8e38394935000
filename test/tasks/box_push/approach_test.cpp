// How both platforms come behind the box.
#include "tasks/box_push/approach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/tasks/box_push/halls.hpp"

namespace mrroc::box_push {
namespace {

const std::array<PlanarPose, kPlatforms> kApart{PlanarPose{-2.5, 0.8, 0.3}, PlanarPose{-2.5, -0.8, -2}};

TEST(Approach, BringsBothBeforeTheSideAtTheirPlaces) {
  const Hall hall = a_hall();
  for (const Side side : kSides) {
    const PlanarPose box{0.2, -0.1, 0.4};
    const auto a = plan_approach(hall, {side, {}}, box, kApart, {});
    ASSERT_TRUE(a);
    EXPECT_NE(a->place[0], a->place[1]);
    for (std::size_t k = 0; k < kPlatforms; ++k) {
      const PlanarPose wanted = chained(a->pair, member_at(hall.formation, a->place[k]));
      ASSERT_FALSE(a->way[k].empty());
      const PlanarPose end = a->way[k].back().knot.back().p;
      EXPECT_NEAR(distance(end, wanted), 0, 1e-6);
      EXPECT_NEAR(wrap_angle(end.phi - wanted.phi), 0, 1e-6);
      EXPECT_NEAR(distance(a->way[k].front().knot.front().p, kApart[k]), 0, 1e-9);
      const double nose = seen_from(chained(box, pair_at(hall.formation, side, 0)), end).x;
      EXPECT_NEAR(nose, -hall.formation.gap, 1e-6) << "before the box";
    }
  }
}

TEST(Approach, NeverTouchesTheBoxOrTheOtherPlatform) {
  const Hall hall = a_hall();
  const Formation& f = hall.formation;
  for (const double angle : {-2.5, -1.0, 0.0, 0.7, 2.0}) {
    const PlanarPose box{0, 0, angle};
    const auto a = plan_approach(hall, {Side::front, {}}, box, kApart, {});
    ASSERT_TRUE(a) << angle;
    for (const std::size_t k : {a->first, 1 - a->first}) {
      const PlanarPose other = k == a->first ? kApart[1 - k] : a->way[1 - k].back().knot.back().p;
      Room room = hall.room;
      room.obstacles = {rectangle(box, f.box_length, f.box_width),
                        rectangle(other, f.platform_length, f.platform_width)};
      for (const Fragment& fragment : a->way[k])
        for (const PathPoint& knot : fragment.knot) {
          const Obstacle outline = rectangle(knot.p, f.platform_length, f.platform_width);
          for (std::size_t c = 0; c < 4; ++c)
            ASSERT_GT(clearance(room, outline.corner[c], outline.corner[(c + 1) % 4]), 0.05)
                << angle << ' ' << k;
        }
    }
  }
}

TEST(Approach, IsNoneWhereAPlatformIsShutIn) {
  Hall hall = a_hall();
  hall.room.obstacles.push_back({"fence", {{-1.6, -4}, {-1.5, -4}, {-1.5, 4}, {-1.6, 4}}});
  EXPECT_FALSE(plan_approach(hall, {Side::front, {}}, {}, kApart, {}));
}

}  // namespace
}  // namespace mrroc::box_push
