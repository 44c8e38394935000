// The friction of a cube's face: it differs from face to face, holds a seated face, and lets it go on its way.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/face_friction.hpp"

namespace mrroc::sim {
namespace {

constexpr double kStep = 0.0005;
constexpr double kInertia = 1e-3;
constexpr double kQuarter = std::numbers::pi / 2;

std::array<FaceFriction, 6> faces(std::uint64_t seed) {
  FaceFrictionSpread spread;
  spread.seed = seed;
  return face_frictions(spread);
}

/// A face alone, under a torque.
struct Rig {
  explicit Rig(const FaceFriction& friction, double start = 0) : drive(friction), angle(start) {}
  void run(double torque, double seconds) {
    for (double t = 0; t < seconds; t += kStep) {
      const FaceDrive::Action a = drive.step(angle, speed, kStep);
      const double free = speed + kStep * (torque + a.torque) / kInertia;
      // Friction holds the wanted speed as far as it goes.
      const double change =
          std::clamp(a.speed - free, -kStep * a.positive / kInertia, kStep * a.negative / kInertia);
      speed = free + change;
      angle += kStep * speed;
    }
  }
  FaceDrive drive;
  double angle;
  double speed{};
};

TEST(FaceFriction, DiffersFromFaceToFaceAndRepeatsWithTheSeed) {
  const auto these = faces(3);
  const auto again = faces(3);
  const auto others = faces(4);
  for (std::size_t k = 0; k < these.size(); ++k) {
    EXPECT_EQ(these[k].breakaway, again[k].breakaway);
    EXPECT_NE(these[k].breakaway, others[k].breakaway);
    EXPECT_NE(these[k].jam_angle, these[(k + 1) % 6].jam_angle);
    EXPECT_GT(these[k].breakaway, these[k].kinetic) << "else it would not break away but crawl";
    EXPECT_LT(these[k].breakaway, 4) << "an arm can turn it";
  }
}

TEST(FaceFriction, HoldsTheSeatUpToTheBreakaway) {
  const FaceFriction f = faces(1)[0];
  for (const double sign : {1., -1.}) {
    Rig rig(f);
    rig.run(sign * 0.97 * f.breakaway, 1);
    EXPECT_LT(std::abs(rig.angle), 1e-3);
    rig.run(sign * 1.03 * f.breakaway, 0.5);
    EXPECT_GT(sign * rig.angle, 0.3);
  }
}

TEST(FaceFriction, TakesLessOnTheWayThanAtTheStart) {
  const FaceFriction f = faces(1)[0];
  Rig rig(f, 0.5);
  rig.run(0.95 * f.breakaway, 0.4);
  EXPECT_GT(rig.angle, 0.6);
}

TEST(FaceFriction, DrawsAFaceIntoItsSeatFromTwoDegreesOnBothSides) {
  for (const double seat : {0., kQuarter, -kQuarter, 2 * kQuarter})
    for (const double off : {0.035, -0.035}) {
      Rig rig(faces(2)[1], seat + off);
      rig.run(0, 1);
      EXPECT_NEAR(rig.angle, seat, 1e-4);
      EXPECT_TRUE(rig.drive.seated());
    }
}

TEST(FaceFriction, LeavesAFaceWhereItIsBetweenSeats) {
  Rig rig(faces(2)[1], 0.7);
  rig.run(0.5, 1);
  EXPECT_NEAR(rig.angle, 0.7, 1e-3);
  EXPECT_FALSE(rig.drive.seated());
}

TEST(FaceFriction, AJamStopsWhatTurnedElsewhere) {
  FaceFriction f = faces(1)[0];
  f.jam = 10;
  f.jam_angle = 0.7;
  Rig rig(f, 0.2);
  rig.run(4.5, 3);
  EXPECT_GT(rig.angle, 0.6);
  EXPECT_LT(rig.angle, 0.75);
}

TEST(FaceFriction, AFaceThatJamsGoesBackTheWayItCame) {
  FaceFriction f = faces(1)[0];
  f.jam = 10;
  f.jam_angle = 0.7;
  for (const int direction : {1, -1}) {
    Rig rig(f, 0.7 - direction * 0.5);
    rig.run(direction * 4.5, 3);
    EXPECT_LT(std::abs(rig.angle - 0.7), 0.06) << "it jams on both ways";
    rig.run(-direction * 3., 1);
    EXPECT_LT(direction * (rig.angle - 0.7), -0.3) << "with less torque than jams it";
  }
}

TEST(FaceFriction, AJamOfOneDirectionLetsAFacePassInTheOther) {
  FaceFriction f = faces(1)[0];
  f.jam = 10;
  f.jam_angle = 0.7;
  for (const int direction : {1, -1}) {
    f.jam_direction = direction;
    Rig with(f, 0.7 - direction * 0.5);
    with.run(direction * 4.5, 3);
    EXPECT_LT(direction * (with.angle - 0.7), 0.05);
    EXPECT_GT(direction * (with.angle - 0.7), -0.1);
    // From where it stands it can be turned back.
    with.run(-direction * 4.5, 0.5);
    EXPECT_LT(direction * (with.angle - 0.7), -0.3);
    Rig against(f, 0.7 + direction * 0.3);
    against.run(-direction * 4.5, 0.5);
    EXPECT_LT(direction * (against.angle - 0.7), -0.3);
  }
}

TEST(FaceFriction, AJamThatLoosensLetsTheFacePassAtALaterAttempt) {
  FaceFriction f = faces(1)[0];
  f.jam = 10;
  f.jam_angle = 0.7;
  f.jam_loosening = 0.9;
  Rig rig(f, 0.3);
  int attempts = 0;
  for (; rig.angle < 0.8 && attempts < 10; ++attempts) {
    for (int k = 0; k < 2000 && rig.angle > 0.5; ++k) rig.run(-4, kStep);
    for (int k = 0; k < 2000 && rig.angle < 0.8; ++k) rig.run(4, kStep);
  }
  EXPECT_EQ(attempts, 2) << "10 N m, then 1";
}

}  // namespace
}  // namespace mrroc::sim
