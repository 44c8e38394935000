#include "ecp/generators/polynomials.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/fault.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

std::vector<Knot> random_knots(RandomList& random) {
  std::vector<Knot> knots{{random.between(-1, 1), random.pose(3, 1)}};
  const int n = random.whole(1, 8);
  for (int k = 0; k < n; ++k) knots.push_back({knots.back().t + random.between(0.2, 1.5), random.pose(3, 1)});
  return knots;
}

using Builder = CurvePtr (*)(const std::vector<Knot>&);
struct Kind {
  const char* name;
  Builder build;
  int continuous;  // derivatives that are
  int at_rest;     // derivatives that are zero at both ends
};
const std::vector<Kind> kKinds{
    {"linear", linear_spline, 0, 0}, {"cubic", cubic_spline, 2, 1}, {"quintic", quintic_spline, 4, 2}};

TEST(Splines, GoThroughEveryKnotAtItsTimeAndEndExactlyAtTheLast) {
  RandomList random(1);
  for (const Kind& kind : kKinds)
    for (int n = 0; n < 50; ++n) {
      const auto knots = random_knots(random);
      const CurvePtr curve = kind.build(knots);
      EXPECT_DOUBLE_EQ(curve->duration(), knots.back().t - knots.front().t);
      for (const Knot& k : knots)
        EXPECT_NEAR((curve->at(k.t - knots.front().t) - k.pose).norm(), 0, 1e-12) << kind.name;
      EXPECT_EQ(curve->at(curve->duration()), knots.back().pose);
      EXPECT_EQ(curve->at(-1), knots.front().pose);
    }
}

TEST(Splines, HaveTheirOrderOfContinuityAndNoMore) {
  RandomList random(2);
  for (const Kind& kind : kKinds) {
    double jump_behind = 0;
    for (int n = 0; n < 50; ++n) {
      const auto knots = random_knots(random);
      const CurvePtr curve = kind.build(knots);
      for (std::size_t k = 1; k + 1 < knots.size(); ++k) {
        const double t = knots[k].t - knots[0].t;
        const auto jump = [&](int order) {
          constexpr double h = 1e-9;
          return (curve->derivative(t + h, order) - curve->derivative(t - h, order)).norm();
        };
        for (int order = 0; order <= kind.continuous; ++order)
          EXPECT_NEAR(jump(order), 0, 1e-7 * std::pow(30, order)) << kind.name << ", derivative " << order;
        jump_behind = std::max(jump_behind, jump(kind.continuous + 1));
      }
    }
    EXPECT_GT(jump_behind, 0.1) << kind.name;
  }
}

TEST(Splines, BeginAndEndAtRest) {
  RandomList random(3);
  for (const Kind& kind : kKinds)
    for (int n = 0; n < 20; ++n) {
      const CurvePtr curve = kind.build(random_knots(random));
      for (int order = 1; order <= kind.at_rest; ++order) {
        EXPECT_NEAR(curve->derivative(0, order).norm(), 0, 1e-9) << kind.name;
        EXPECT_NEAR(curve->derivative(curve->duration(), order).norm(), 0, 1e-7) << kind.name;
      }
    }
}

TEST(Splines, BetweenTwoKnotsAreTheKnownPolynomials) {
  const std::vector<Knot> knots{{0, Coordinates::Zero(1)}, {2, Coordinates::Constant(1, 1)}};
  for (double s = 0; s <= 1; s += 0.125) {
    EXPECT_NEAR(linear_spline(knots)->at(2 * s)[0], s, 1e-12);
    EXPECT_NEAR(cubic_spline(knots)->at(2 * s)[0], s * s * (3 - 2 * s), 1e-12);
    EXPECT_NEAR(quintic_spline(knots)->at(2 * s)[0], s * s * s * (10 + s * (-15 + 6 * s)), 1e-12);
  }
}

TEST(Splines, StretchedAsSlowingSaysKeepTheLimits) {
  RandomList random(4);
  const MotionLimits limits{Coordinates::Constant(3, 0.4), Coordinates::Constant(3, 0.7)};
  for (const Builder build : {&cubic_spline, &quintic_spline})
    for (int n = 0; n < 30; ++n) {
      const auto knots = random_knots(random);
      const double factor = build(knots)->slowing(limits);
      const CurvePtr slow = build(stretched(knots, factor));
      double most = 0;
      for (double t = 0; t < slow->duration(); t += 1e-3) {
        const double v = share_of(slow->derivative(t, 1), limits.velocity);
        const double a = share_of(slow->derivative(t, 2), limits.acceleration);
        EXPECT_LE(v, 1);
        EXPECT_LE(a, 1);
        most = std::max({most, v, a});
      }
      if (factor > 1) {
        EXPECT_GT(most, 0.98) << "slower than needed";
      }
      EXPECT_NEAR(slow->slowing(limits), 1, 2e-3);
    }
}

TEST(Splines, AreNotSlowedWhereTheyAreSlowAlready) {
  const std::vector<Knot> knots{{3, Coordinates::Zero(2)}, {5, Coordinates::Constant(2, 1)}};
  const MotionLimits wide{Coordinates::Constant(2, 100), Coordinates::Constant(2, 100)};
  EXPECT_EQ(cubic_spline(knots)->slowing(wide), 1);
  EXPECT_NEAR(linear_spline(knots)->slowing({Coordinates::Constant(2, 0.25), Coordinates::Constant(2, 100)}),
              2, 0.01)
      << "twice too fast";
  EXPECT_NEAR(cubic_spline(knots)->slowing({Coordinates::Constant(2, 100), Coordinates::Constant(2, 0.375)}),
              2, 0.01)
      << "an acceleration of four times the limit";
}

TEST(Splines, StretchedBeginWhereTheyBeganAndLastLonger) {
  const Coordinates q = Coordinates::Constant(2, 1);
  const auto slow = stretched({{3, q}, {4, 2 * q}, {6, 3 * q}}, 2.5);
  ASSERT_EQ(slow.size(), 3U);
  EXPECT_EQ(slow[0].t, 3);
  EXPECT_EQ(slow[1].t, 5.5);
  EXPECT_EQ(slow[2].t, 10.5);
  EXPECT_EQ(slow[2].pose, 3 * q);
}

TEST(Splines, DerivativesAreThoseOfTheirPolynomials) {
  Polynomials::Coefficients c(1, 6);
  c << 1, 2, 3, 4, 5, 6;
  const Polynomials p({1, 3}, {c}, Coordinates::Constant(1, 0));
  const double t = 0.5;
  EXPECT_NEAR(p.derivative(t, 0)[0],
              1 + 2 * t + 3 * t * t + 4 * t * t * t + 5 * t * t * t * t + 6 * std::pow(t, 5), 1e-12);
  EXPECT_NEAR(p.derivative(t, 1)[0], 2 + 6 * t + 12 * t * t + 20 * t * t * t + 30 * t * t * t * t, 1e-12);
  EXPECT_NEAR(p.derivative(t, 3)[0], 24 + 120 * t + 360 * t * t, 1e-12);
  EXPECT_NEAR(p.derivative(t, 5)[0], 720, 1e-12);
  EXPECT_EQ(p.duration(), 2);
}

TEST(Splines, RefuseKnotsThatCannotBeMeant) {
  const Coordinates q = Coordinates::Zero(2);
  for (const Kind& kind : kKinds) {
    EXPECT_THROW(static_cast<void>(kind.build({})), FaultError);
    EXPECT_THROW(static_cast<void>(kind.build({{0, q}})), FaultError);
    EXPECT_THROW(static_cast<void>(kind.build({{0, q}, {0, q}})), FaultError);
    try {
      static_cast<void>(kind.build({{0, q}, {1, Coordinates::Zero(3)}}));
      ADD_FAILURE();
    } catch (const FaultError& e) {
      EXPECT_NE(std::string(e.what()).find("knot 1 has 3 numbers instead of 2"), std::string::npos)
          << e.what();
    }
    EXPECT_THROW(static_cast<void>(kind.build({{0, q}, {1, Coordinates::Constant(2, NAN)}})), FaultError);
    EXPECT_THROW(static_cast<void>(kind.build({{0, q}, {NAN, q}})), FaultError);
  }
}

TEST(ConstantVelocity, IsAStraightLineAtTheSpeedOfTheSlowestAxis) {
  Coordinates to(2);
  to << 0.3, -0.1;
  const MotionLimits limits{Coordinates::Constant(2, 1), Coordinates::Constant(2, 1)};
  const CurvePtr curve = constant_velocity(Coordinates::Zero(2), to, limits, 0.1);
  EXPECT_NEAR(curve->duration(), 3, 1e-12);
  EXPECT_NEAR((curve->at(1.5) - to / 2).norm(), 0, 1e-12);
  EXPECT_EQ(curve->at(3), to);
  const CurvePtr still = constant_velocity(to, to, limits, 1);
  EXPECT_LT(still->duration(), 1e-6);
  EXPECT_EQ(still->at(0), to);
  EXPECT_THROW(static_cast<void>(constant_velocity(to, to, limits, 1.01)), FaultError);
  EXPECT_THROW(static_cast<void>(constant_velocity(to, Coordinates::Zero(3), limits, 1)), FaultError);
  EXPECT_THROW(static_cast<void>(constant_velocity(Coordinates::Zero(3), Coordinates::Zero(3), limits, 1)),
               FaultError);
  EXPECT_THROW(static_cast<void>(constant_velocity(to, to, limits, 0)), FaultError);
}

TEST(Hold, Stays) {
  const Coordinates q = Coordinates::Constant(6, 0.7);
  const CurvePtr curve = hold(q, 2);
  for (const double t : {0.0, 0.3, 2.0, 5.0}) EXPECT_EQ(curve->at(t), q);
  EXPECT_EQ(curve->duration(), 2);
}

}  // namespace
}  // namespace mrroc::ecp
