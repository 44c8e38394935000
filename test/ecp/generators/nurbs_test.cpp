#include "ecp/generators/nurbs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

Coordinates at(double x, double y) { return Eigen::Vector2d(x, y); }

NurbsShape random_shape(RandomList& random) {
  NurbsShape shape{.degree = random.whole(1, 5), .control = {}, .weights = {}, .knots = {}};
  const int points = shape.degree + random.whole(1, 8);
  for (int k = 0; k < points; ++k) {
    shape.control.push_back(random.pose(3, 1));
    shape.weights.push_back(random.between(0.2, 3));
  }
  return shape;
}

TEST(Nurbs, AQuarterOfACircleIsOneExactly) {
  const Nurbs curve({.degree = 2,
                     .control = {at(1, 0), at(1, 1), at(0, 1)},
                     .weights = {1, std::sqrt(0.5), 1},
                     .knots = {0, 0, 0, 1, 1, 1}},
                    2);
  for (double t = 0; t <= 2; t += 0.05) EXPECT_NEAR(curve.at(t).norm(), 1, 1e-14);
  EXPECT_NEAR((curve.at(1) - at(std::sqrt(0.5), std::sqrt(0.5))).norm(), 0, 1e-14);
}

TEST(Nurbs, OfDegreeThreeWithFourPointsIsABezierCurve) {
  RandomList random(1);
  std::vector<Coordinates> p;
  for (int k = 0; k < 4; ++k) p.push_back(random.pose(6, 1));
  const Nurbs curve({.degree = 3, .control = p, .weights = {}, .knots = {}}, 1);
  for (double u = 0; u <= 1; u += 0.0625) {
    const double w = 1 - u;
    const Coordinates bezier =
        w * w * w * p[0] + 3 * w * w * u * p[1] + 3 * w * u * u * p[2] + u * u * u * p[3];
    EXPECT_NEAR((curve.at(u) - bezier).norm(), 0, 1e-14);
  }
}

TEST(Nurbs, BeginsAndEndsInItsEndPointsAndStaysWithinItsHull) {
  RandomList random(2);
  for (int n = 0; n < 200; ++n) {
    const NurbsShape shape = random_shape(random);
    const Nurbs curve(shape, 3);
    EXPECT_NEAR((curve.at(0) - shape.control.front()).norm(), 0, 1e-14);
    EXPECT_EQ(curve.at(3), curve.at(100));
    EXPECT_NEAR((curve.at(3) - shape.control.back()).norm(), 0, 1e-12);
    for (double t = 0; t <= 3; t += 0.1)
      for (int axis = 0; axis < 3; ++axis) {
        double low = 1e9, high = -1e9;
        for (const Coordinates& c : shape.control) {
          low = std::min(low, c[axis]);
          high = std::max(high, c[axis]);
        }
        EXPECT_GE(curve.at(t)[axis], low - 1e-12);
        EXPECT_LE(curve.at(t)[axis], high + 1e-12);
      }
  }
}

TEST(Nurbs, OfDegreeTwoAndMoreHasNoKinks) {
  RandomList random(3);
  for (int n = 0; n < 100; ++n) {
    NurbsShape shape = random_shape(random);
    if (shape.degree < 2) continue;
    const Nurbs curve(shape, 1);
    const std::size_t inner = shape.control.size() - static_cast<std::size_t>(shape.degree);
    constexpr double h = 1e-6;
    for (std::size_t k = 1; k < inner; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(inner);
      const Coordinates before = (curve.at(t) - curve.at(t - h)) / h;
      const Coordinates behind = (curve.at(t + h) - curve.at(t)) / h;
      EXPECT_NEAR((behind - before).norm(), 0, 2e-2);
    }
  }
}

TEST(Nurbs, ItsKnotsMayBeginAnywhereAndLieUnevenly) {
  const std::vector<Coordinates> control{at(0, 0), at(1, 2), at(3, 3), at(4, 0)};
  const Nurbs curve({.degree = 1, .control = control, .weights = {}, .knots = {2, 2, 3, 6, 7, 7}}, 10);
  EXPECT_NEAR((curve.at(0) - control[0]).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.at(1) - at(0.5, 1)).norm(), 0, 1e-14) << "half of the first fifth";
  EXPECT_NEAR((curve.at(2) - control[1]).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.at(5) - at(2, 2.5)).norm(), 0, 1e-14);
  EXPECT_NEAR((curve.at(9) - at(3.5, 1.5)).norm(), 0, 1e-14);
  EXPECT_EQ(curve.at(-1), curve.at(0));
  EXPECT_EQ(curve.duration(), 10);
}

TEST(Nurbs, AHeavyPointDrawsTheCurveToItself) {
  const auto middle = [](double weight) {
    return Nurbs({.degree = 2,
                  .control = {at(0, 0), at(1, 1), at(2, 0)},
                  .weights = {1, weight, 1},
                  .knots = {}},
                 2)
        .at(1);
  };
  EXPECT_NEAR((middle(1) - at(1, 0.5)).norm(), 0, 1e-14);
  EXPECT_NEAR((middle(3) - at(1, 0.75)).norm(), 0, 1e-14) << "w / (w + 1)";
}

TEST(Nurbs, RefusesShapesThatAreNone) {
  const NurbsShape good{.degree = 2, .control = {at(0, 0), at(1, 0), at(1, 1)}, .weights = {}, .knots = {}};
  EXPECT_NO_THROW(Nurbs(good, 1));
  const auto refused = [&](auto change) {
    NurbsShape shape = good;
    change(shape);
    EXPECT_THROW(Nurbs(shape, 1), FaultError);
  };
  refused([](NurbsShape& s) { s.degree = 0; });
  refused([](NurbsShape& s) { s.degree = 3; });
  refused([](NurbsShape& s) { s.weights = {1, 0, 1}; });
  refused([](NurbsShape& s) { s.weights = {1, 1}; });
  refused([](NurbsShape& s) { s.knots = {0, 0, 0, 1, 1}; });
  refused([](NurbsShape& s) { s.knots = {0, 0, 1, 0, 1, 1}; });
  refused([](NurbsShape& s) { s.knots = {1, 1, 1, 1, 1, 1}; });
  refused([](NurbsShape& s) { s.control[1] = Coordinates::Constant(2, NAN); });
  for (const double bad : {-1.0, std::nan(""), double{INFINITY}}) {
    refused([&](NurbsShape& s) { s.weights = {1, bad, 1}; });
    EXPECT_THROW(Nurbs(good, bad), FaultError);
  }
  refused([](NurbsShape& s) { s.control[2] = Coordinates::Zero(3); });
  refused([](NurbsShape& s) { s.knots = {0, 0, 0, 1, 1, INFINITY}; });
  refused([](NurbsShape& s) {
    s.control.assign(8, at(0, 0));
    s.degree = 6;
  });
  EXPECT_NO_THROW(Nurbs({.degree = 5, .control = {8, at(0, 0)}, .weights = {}, .knots = {}}, 1));
  const std::vector<Coordinates> five(5, at(0, 0));
  EXPECT_NO_THROW(
      Nurbs({.degree = 2, .control = five, .weights = {}, .knots = {0, 0, 0, 0.5, 0.5, 1, 1, 1}}, 1));
  const std::vector<Coordinates> six(6, at(0, 0));
  EXPECT_THROW(
      Nurbs({.degree = 2, .control = six, .weights = {}, .knots = {0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1}}, 1),
      FaultError)
      << "it would break";
  EXPECT_THROW(Nurbs(good, 0), FaultError);
}

}  // namespace
}  // namespace mrroc::ecp
