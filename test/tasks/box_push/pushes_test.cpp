// Which pushes bring a box to its goal.
#include "tasks/box_push/pushes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "test/tasks/box_push/halls.hpp"

namespace mrroc::box_push {
namespace {

TEST(Formation, StandsBeforeTheSideThatItPushes) {
  const Formation f;
  const PlanarPose back = pair_at(f, Side::back, 0.1), front = pair_at(f, Side::front, 0.1);
  EXPECT_NEAR(back.x, -(f.box_length + f.platform_length) / 2 - 0.1, 1e-12);
  EXPECT_NEAR(back.phi, 0, 1e-12);
  EXPECT_NEAR(front.x, -back.x, 1e-12);
  EXPECT_NEAR(std::abs(front.phi), std::numbers::pi, 1e-12);
  EXPECT_GT(apart(f), f.platform_width) << "they stand beside each other";
  EXPECT_LT(apart(f) - f.platform_width, f.box_width) << "both are before the box";
}

TEST(Pushes, AreOneToWhatLiesAhead) {
  const auto ahead = plan_pushes(a_hall(), {}, {1.5, 0, 0});
  ASSERT_TRUE(ahead);
  ASSERT_EQ(ahead->size(), 1U);
  EXPECT_EQ(ahead->front().side, Side::back);
  const auto behind = plan_pushes(a_hall(), {}, {-1.5, 0, 0});
  ASSERT_TRUE(behind);
  ASSERT_EQ(behind->size(), 1U);
  EXPECT_EQ(behind->front().side, Side::front);
}

TEST(Pushes, EndAtTheGoalAndHaveRoom) {
  const Hall hall = a_hall();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-2.2, 2.2), y(-1.4, 1.4), phi(-3.1, 3.1);
  for (int k = 0; k < 40; ++k) {
    const PlanarPose box{x(random), y(random), phi(random)}, goal{x(random), y(random), phi(random)};
    const auto pushes = plan_pushes(hall, box, goal);
    ASSERT_TRUE(pushes) << k;
    EXPECT_LE(pushes->size(), static_cast<std::size_t>(kMostPushes));
    EXPECT_EQ(distance(pushes->back().to, goal), 0);
    PlanarPose from = box;
    for (const Push& push : *pushes) {
      EXPECT_TRUE(has_room(hall, push.side, from)) << k;
      EXPECT_TRUE(has_room(hall, push.side, push.to)) << k;
      const PlanarPose pair = pair_at(hall.formation, push.side, 0);
      if (&push == &pushes->back()) {
        EXPECT_TRUE(planned_course(seen_from(chained(from, pair), chained(push.to, pair)), hall.steering))
            << k;
      }
      from = push.to;
    }
  }
}

TEST(Pushes, MoveABoxAsideByGoingThereAndBack) {
  const auto pushes = plan_pushes(a_hall(), {}, {0, 0.05, 0});
  ASSERT_TRUE(pushes);
  EXPECT_EQ(pushes->size(), 2U);
  EXPECT_NE((*pushes)[0].side, (*pushes)[1].side);
}

TEST(Pushes, AreNoneIntoAWall) {
  EXPECT_FALSE(has_room(a_hall(), Side::back, {4.8, 0, 0}));
  EXPECT_FALSE(plan_pushes(a_hall(), {}, {4.8, 0, 0}));
  Hall narrow = a_hall();
  narrow.room.obstacles.push_back({"pillar", {{-1.2, 0.3}, {-0.8, 0.3}, {-0.8, 0.8}, {-1.2, 0.8}}});
  EXPECT_FALSE(has_room(narrow, Side::back, {}));
  EXPECT_TRUE(has_room(narrow, Side::front, {}));
}

}  // namespace
}  // namespace mrroc::box_push
