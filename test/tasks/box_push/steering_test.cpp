// The courses of a pair that pushes.
#include "tasks/box_push/steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mrroc::box_push {
namespace {

const SteeringLimits kLimits;

/// Follows courses until none is left. @return the target as it is seen then
PlanarPose followed(PlanarPose target, double step) {
  for (int n = 0; n < 1000; ++n) {
    const Course course = course_to(target, kLimits);
    if (course.length <= 1e-4) break;
    EXPECT_LE(std::abs(course.curvature), 1 / kLimits.least_radius + 1e-9);
    const double way = std::min(step, course.length), angle = way * course.curvature;
    target = seen_from({way * std::cos(angle / 2), way * std::sin(angle / 2), angle}, target);
  }
  return target;
}

TEST(Course, IsStraightToWhatIsStraightAhead) {
  const auto course = planned_course({1.5, 0, 0}, kLimits);
  ASSERT_TRUE(course);
  EXPECT_NEAR(course->curvature, 0, 1e-12);
  EXPECT_NEAR(course->length, 1.5, 1e-12);
}

TEST(Course, OfAPlannedOneLeadsToTheTarget) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ahead(0.3, 4), beside(-1.5, 1.5), turned(-1.5, 1.5);
  int planned = 0;
  for (int k = 0; k < 500; ++k) {
    const PlanarPose target{ahead(random), beside(random), turned(random)};
    if (!planned_course(target, kLimits)) continue;
    ++planned;
    const PlanarPose left = followed(target, 0.03);
    EXPECT_NEAR(left.x, 0, 0.03) << target.x << ' ' << target.y << ' ' << target.phi;
    EXPECT_NEAR(left.y, 0, 0.01) << target.x << ' ' << target.y << ' ' << target.phi;
    EXPECT_NEAR(left.phi, 0, 0.05) << target.x << ' ' << target.y << ' ' << target.phi;
  }
  EXPECT_GT(planned, 40);
}

TEST(Course, IsNotPlannedToWhatIsBehindOrTooFarAside) {
  EXPECT_FALSE(planned_course({-0.5, 0, 0}, kLimits));
  EXPECT_FALSE(planned_course({0.3, 0.3, 0}, kLimits));
  EXPECT_FALSE(planned_course({0.3, 0, 0.5}, kLimits));
}

TEST(Course, ComesNearToWhatCannotBeReached) {
  const PlanarPose left = followed({0.6, 0.08, 0}, 0.03);
  EXPECT_LT(std::abs(left.y), 0.06) << "nearer than straight on";
  EXPECT_LE(course_to({-0.1, 0.02, 0}, kLimits).length, 0) << "it has gone too far";
}

TEST(Course, OfTheMirroredTargetIsMirrored) {
  for (const PlanarPose& target : {PlanarPose{2, 0.4, 0.3}, {1.5, -0.2, 0.6}, {2.5, 1.2, 1.0}}) {
    const Course one = course_to(target, kLimits),
                 other = course_to({target.x, -target.y, -target.phi}, kLimits);
    EXPECT_NEAR(one.curvature, -other.curvature, 1e-9);
    EXPECT_NEAR(one.length, other.length, 1e-9);
  }
}

}  // namespace
}  // namespace mrroc::box_push
