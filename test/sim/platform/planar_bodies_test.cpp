// Bodies that rub against one another and against walls.
#include "sim/platform/planar_bodies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>

namespace mrroc::sim {
namespace {

constexpr double kH = 0.001;
constexpr double kMass = 50, kPressed = 200, kAlong = 120;  // [kg], [N], [N]

Room a_room() { return {.lower = {-20, -20}, .upper = {20, 20}, .obstacles = {}}; }

PlanarBody a_body(std::optional<double> grip) {
  return {.mass = kMass, .inertia = 1e6, .length = 1, .width = 1, .grip = grip};
}

/// @return coefficient with which something rubs that gets that speed in a time while it is pressed and pushed along
double coefficient(double speed, double time) { return (kAlong - kMass * speed / time) / kPressed; }

/// A body that lies against the wall where x is largest, pressed against it and pushed along it.
double against_wall(std::optional<double> grip) {
  PlanarBodies bodies(a_room());
  const int body = bodies.add(a_body(grip), {.x = 19.5});
  constexpr int kSettles = 200, kSlides = 500;
  double begun = 0;
  for (int n = 0; n < kSettles + kSlides; ++n) {
    if (n == kSettles) begun = bodies.state(body).vy;
    bodies.push(body, {.x = kPressed, .y = n < kSettles ? 0 : kAlong});
    bodies.integrate(kH);
  }
  EXPECT_NEAR(bodies.state(body).x, 19.5, 0.01);
  return coefficient(bodies.state(body).vy - begun, kSlides * kH);
}

/// Two bodies of which the first one is pressed against the other one, which a wall holds.
double against_body(std::optional<double> grip, std::optional<double> other) {
  PlanarBodies bodies(a_room());
  const int body = bodies.add(a_body(grip), {.x = 18.5});
  PlanarBody held = a_body(other);
  held.mass = 1e6;
  const int second = bodies.add(held, {.x = 19.5});
  constexpr int kSettles = 200, kSlides = 500;
  for (int n = 0; n < kSettles + kSlides; ++n) {
    bodies.push(body, {.x = kPressed, .y = n < kSettles ? 0 : kAlong});
    bodies.push(second, {.x = kPressed});
    bodies.integrate(kH);
  }
  return coefficient(bodies.state(body).vy, kSlides * kH);
}

TEST(PlanarBodies, ABoxRubsWithItsGripAgainstAWallAndAgainstAPlatform) {
  for (const double grip : {0.0, 0.2, 0.5}) {
    EXPECT_NEAR(against_wall(grip), grip, 0.02);
    EXPECT_NEAR(against_body(grip, std::nullopt), grip, 0.02);
    EXPECT_NEAR(against_body(std::nullopt, grip), grip, 0.02);
  }
}

TEST(PlanarBodies, OfTwoBoxesTheSmallerGripCounts) {
  for (const auto& [one, other] : std::array<std::array<double, 2>, 3>{{{0.1, 0.5}, {0.5, 0.1}, {0.4, 0.4}}})
    EXPECT_NEAR(against_body(one, other), std::min(one, other), 0.02);
}

TEST(PlanarBodies, PlatformsRubAsTheyDidBeforeThereWereBoxes) {
  EXPECT_NEAR(against_wall(std::nullopt), kOutlineFriction, 0.02);
  EXPECT_NEAR(against_body(std::nullopt, std::nullopt), kOutlineFriction * kOutlineFriction, 0.02);
}

}  // namespace
}  // namespace mrroc::sim
