#include "tasks/guide/law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "ecp/solo.hpp"
#include "test/tasks/guide/led_arm.hpp"

namespace mrroc::guide {
namespace {

using std::numbers::pi;

Curve square() { return {{{-0.03, -0.03}, {0.03, -0.03}, {0.03, 0.03}, {-0.03, 0.03}}, true, 0.004}; }
Curve ellipse() {
  Points points;
  for (int n = 0; n < 720; ++n)
    points.emplace_back(0.05 * std::cos(pi * n / 360), 0.035 * std::sin(pi * n / 360));
  return {points, true, 0};
}
Curve line() { return {{{-0.06, 0}, {0.06, 0}}, false, 0}; }

Fixture fixture_of(int kind, const Pose& T_0F) {
  if (kind == 0) return {T_0F, line()};
  if (kind == 1) return {T_0F, std::array{0.12, 0.08}};
  return {T_0F, kind == 2 ? square() : ellipse()};
}

TEST(Law, TheForceOfAWallAndItsSlopeBeginAtZero) {
  const Law law;
  EXPECT_EQ(wall_force(law, 0), 0);
  EXPECT_NEAR(wall_force(law, 1e-6), 0, 1e-5);
  double before = 0;
  for (double d = 1e-5; d < 0.02; d += 1e-5) {
    const double F = wall_force(law, d);
    EXPECT_LT(F, before) << "against the depth, and the more the deeper";
    EXPECT_LE(before - F, law.wall_stiffness * 1e-5 * 1.0001) << "never stiffer than that";
    EXPECT_EQ(wall_force(law, -d), -F);
    before = F;
  }
}

TEST(Law, TheForceOfAWallIsTheSlopeOfItsEnergySoThatAllOfItComesBackAndNoMore) {
  const Law law;
  double energy = 0;
  for (int n = 0; n < 10'000; ++n) energy -= wall_force(law, 1e-6 * n + 5e-7) * 1e-6;
  EXPECT_NEAR(energy, wall_energy(law, 0.01), 1e-6 * energy);
}

TEST(Law, ALittleOfAFixtureIsNearlyNone) {
  const Law law;
  const Fixture f = fixture_of(0, {});
  const TaskFrameCommand none = rows(law, f, {.y = 0.005}, 0), little = rows(law, f, {.y = 0.005}, 1e-6);
  EXPECT_EQ(none.y, c(-0.0, law.free_inertia, law.free_mobility));
  EXPECT_NEAR(little.y.force, 0, 1e-3);
  EXPECT_NEAR(little.y.mobility, law.free_mobility, 1e-5);
  EXPECT_EQ(rows(law, f, {}, 1).x, c(-0.0, law.free_inertia, law.free_mobility))
      << "along it the tool is free";
  for (const Axis a : {Axis::ax, Axis::ay, Axis::az}) EXPECT_EQ(little[a], u()) << "it does not turn";
}

TEST(Law, InNarrowBendsAndJustBeforeThemTheToolIsDampedAlongTheFixture) {
  const Law law;
  const Fixture square = fixture_of(2, {});
  const double corner = square.stand({0.03, -0.03, 0}, {}).s, side = square.stand({0, -0.03, 0}, {}).s;
  ASSERT_LT(square.bend(corner), law.bend / 2);
  EXPECT_EQ(rows(law, square, {.s = side}, 1).x.mobility, law.free_mobility);
  EXPECT_NEAR(rows(law, square, {.s = corner}, 1).x.mobility,
              law.free_mobility * square.bend(corner) / law.bend, 1e-9);
  EXPECT_LT(rows(law, square, {.s = corner - Curve::kNear}, 1).x.mobility, law.free_mobility / 1.5);
  EXPECT_EQ(rows(law, square, {.s = corner}, 0).x.mobility, law.free_mobility) << "nothing holds it";
}

TEST(Law, AToolThatNobodyHoldsIsMovedNoFasterThanAsked) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  const Law law;
  for (int n = 0; n < 1000; ++n) {
    const Standing s{
        .y = 0.1 * (part(random) - 0.5), .z = 0.1 * (part(random) - 0.5), .beyond = {0.05 * part(random), 0}};
    const TaskFrameCommand frame = rows(law, fixture_of(0, {}), s, part(random), 0.03);
    for (const Axis a : {Axis::x, Axis::y, Axis::z}) {
      EXPECT_EQ(frame[a].b, Behaviour::contact);
      EXPECT_LE(std::abs(frame[a].force * frame[a].mobility), 0.03 * 1.000001);
      EXPECT_LE(std::abs(frame[a].force), law.most_force);
    }
  }
}

/// Where a hand wants to be that is led along for so long [s], at that speed and so deep into the walls, and pushes across.
Vector3 pushed(const Fixture& fixture, double speed, double depth, double led, const Vector3& across) {
  if (const Curve* curve = fixture.curve(); curve && curve->closed()) {
    const Point p = curve->at(speed * led).point;
    return fixture.T_0F() * Vector3(p.x(), p.y(), 0) + fixture.axes(speed * led) * across;
  }
  const double swing = std::sin(led * speed / 0.06);
  if (!fixture.is_plane()) return fixture.T_0F() * (Vector3((0.06 + depth) * swing, 0, 0) + across);
  return fixture.T_0F() *
         Vector3((0.06 + depth) * swing, (0.04 + depth) * std::sin(1.4 * led * speed / 0.06), across.z());
}

/// A random hand on a random fixture: it leads along, pushes across by some force and against walls, and trembles.
struct RandomCase {
  Setup k;
  LeadingHand hand;
  double push{}, tremor{};
  Vector3 start{Vector3::Zero()};

  explicit RandomCase(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double a, double b) {
      return std::uniform_real_distribution<double>(a, b)(random);
    };
    const Pose T_0F{rotation_from_angle_axis({between(-1, 1), between(-1, 1), between(-1, 1)}),
                    {0.9, 0.1, 1}};
    k.fixture = fixture_of(static_cast<int>(seed % 4), T_0F);
    k.law.stiffness = between(5000, 30'000);
    k.T_WE = {rotation_from_angle_axis({0, 0, between(-1, 1)}), {0, 0, 0.25}};
    push = between(0, 10);
    tremor = between(5e-5, 1e-3);
    hand.stiffness = between(300, 2000);
    hand.damping = between(0.2, 0.7) * std::sqrt(hand.stiffness);
    hand.mass = between(0.4, 2.5);
    const double frequency = between(4, 12), speed = between(0.01, 0.06), phase = between(0, 6);
    const double depth = between(0, 0.02);
    const Vector3 shaken = Vector3(between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
    // Around a corner a hand pushes across the plane only: sideways it would be on the wrong side of the bend.
    const double sideways = seed % 4 == 2 ? 0 : 1;
    const double off = push * (1 / hand.stiffness + 1 / k.law.stiffness);
    hand.wanted = [=, fixture = k.fixture, trembles = std::numbers::sqrt2 * tremor](double t) {
      const double led = std::max(0.0, t - 3), angle = phase + 2 * pi * t / 3;
      const Vector3 across =
          off * smooth((t - 3) / 2) * Vector3(0, sideways * std::cos(angle), std::sin(angle));
      return Vector3(pushed(fixture, speed, depth, led, across) +
                     trembles * std::sin(2 * pi * frequency * t) * shaken);
    };
    start = hand.wanted(0) + 0.01 * T_0F.R.col(2);
  }
};

/// Executes all rows.
LedArm lead(const RandomCase& c) {
  LedArm arm(c.k, c.start, c.hand);
  arm.until = 12;
  Arm::X x;
  arm.read(x);
  x.c.k = std::make_shared<const Setup>(c.k);
  EXPECT_EQ(ecp::execute_rows<Arm>(std::span<const Motion<Arm>>(kGuide), x, arm), Outcome::terminated);
  return arm;
}

/// Does the same with 200 hands.
template <class Expect>
void with_random_hands(Expect expect) {
  for (unsigned seed = 0; seed < 200 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const RandomCase c(seed);
    expect(c, lead(c));
  }
}

TEST(RandomHands, GetOffTheFixtureInProportionToTheirForceAndNoFurther) {
  with_random_hands([](const RandomCase& c, const LedArm& arm) {
    std::optional<double> s;
    // The force that counts is the mean over the time constant of the fixture: it is a spring with a damper.
    const double T = 1 / (c.k.law.stiffness * c.k.law.mobility);
    Vector3 F = Vector3::Zero();
    double off_force = 0, force_force = 0;
    for (const LedStep& step : arm.steps) {
      F += LedArm::kDt / T * (step.F - F);
      if (step.m < kEnter || step.m > kGuided) continue;
      const Standing now = c.k.fixture.stand(step.p, s);
      s = now.s;
      if (step.m != kGuided) continue;
      const Vector3 local = c.k.fixture.axes(now.s).transpose() * F;
      const double across = c.k.fixture.is_plane() ? std::abs(local.z()) : std::hypot(local.y(), local.z());
      off_force += now.off() * across;
      force_force += across * across;
      ASSERT_LT(now.off(), across / c.k.law.stiffness + 5e-4) << "at " << across << " N";
    }
    if (c.push > 3) {
      EXPECT_NEAR(c.k.law.stiffness * off_force / force_force, 1, 0.2);
    }
  });
}

TEST(RandomHands, NeverGetMoreEnergyFromFixtureAndWallsThanTheyGave) {
  with_random_hands([](const RandomCase& c, const LedArm& arm) {
    double given = 0, stored = -1;
    for (const LedStep& step : arm.steps) {
      if (step.m != kGuided) continue;
      if (stored < 0) {  // what the springs have at the beginning, the inertia of law (28) with them
        const Standing now = c.k.fixture.stand(step.p, {});
        stored = 0.5 * c.k.law.stiffness * now.off() * now.off() +
                 0.5 * c.k.law.free_inertia * step.v.squaredNorm();
      }
      given += LedArm::kDt * step.F.dot(step.v);
      ASSERT_GT(given, -stored - 1e-4);
    }
    EXPECT_GT(given, 0);
  });
}

TEST(RandomHands, AreTakenAndLetGoWithoutAJump) {
  with_random_hands([](const RandomCase& c, const LedArm& arm) {
    double fastest = 0;
    for (std::size_t k = 1; k < arm.steps.size(); ++k) {
      const LedStep &before = arm.steps[k - 1], &now = arm.steps[k];
      if (now.m == kEnter || now.m == kLeave) fastest = std::max(fastest, (now.v - before.v).norm());
    }
    // A tremor of 12 Hz changes the speed of a free tool by itself.
    const double trembles = std::pow(2 * pi * 12, 2) * std::numbers::sqrt2 * c.tremor * LedArm::kDt;
    EXPECT_LT(fastest, 0.01 + 1.5 * trembles) << "change of the speed in a step [m/s]";
  });
}

}  // namespace
}  // namespace mrroc::guide
