#include "tasks/guide/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::guide {
namespace {

using std::numbers::pi;

const Points kSquare{{0, 0}, {0.06, 0}, {0.06, 0.06}, {0, 0.06}};

Points circle(double radius, int pieces = 720) {
  Points points;
  for (int k = 0; k < pieces; ++k)
    points.emplace_back(radius * std::cos(2 * pi * k / pieces), radius * std::sin(2 * pi * k / pieces));
  return points;
}

/// A figure eight, which crosses itself at the origin.
Curve eight() {
  Points points;
  for (int k = 0; k < 720; ++k) {
    const double a = 2 * pi * k / 720;
    points.emplace_back(0.06 * std::sin(a), 0.03 * std::sin(2 * a));
  }
  return {points, true, 0};
}

TEST(Curve, IsMeasuredByItsLength) {
  const Curve line({{0, 0}, {0.03, 0}, {0.1, 0}}, false, 0);
  EXPECT_NEAR(line.length(), 0.1, 1e-12);
  EXPECT_NEAR(line.at(0.04).point.x(), 0.04, 1e-12);
  EXPECT_NEAR(line.at(0.2).s, 0.1, 1e-12) << "clipped to the curve";
  const Curve round(circle(0.04), true, 0);
  EXPECT_NEAR(round.length(), 2 * pi * 0.04, 1e-5);
  EXPECT_NEAR((round.at(1.25 * round.length()).point - Point(0, 0.04)).norm(), 0, 1e-5) << "goes round";
  EXPECT_NEAR(round.at(-0.25 * round.length()).point.y(), -0.04, 1e-5);
}

TEST(Curve, EndsTellHowFarBeyondThemAToolIs) {
  const Curve line({{0, 0}, {0.1, 0}}, false, 0);
  const auto beyond = [&](double x) { return line.nearest(Point(x, 0.002), 0.05).beyond; };
  EXPECT_EQ(beyond(0.05), 0);
  EXPECT_NEAR(beyond(0.103), 0.003, 1e-9);
  EXPECT_NEAR(beyond(-0.004), -0.004, 1e-9);
  EXPECT_EQ(Curve(circle(0.04), true, 0).nearest(Point(0.05, 0)).beyond, 0) << "a closed curve has no ends";
}

TEST(Curve, RoundsCornersByWhatIsAskedAndKeepsItsEnds) {
  const Curve angle({{0, 0}, {0.05, 0}, {0.05, 0.05}}, false, 0.003);
  EXPECT_EQ(angle.at(0).point, Point(0, 0));
  EXPECT_LT((angle.at(angle.length()).point - Point(0.05, 0.05)).norm(), 1e-9);
  double widest = 0, narrowest = 1;
  for (double s = 0; s < angle.length(); s += 1e-4) {
    const Point p = angle.at(s).point;
    widest = std::max(widest, std::min(std::abs(p.y()), std::abs(p.x() - 0.05)));
    narrowest = std::min(narrowest, angle.radius(s));
  }
  EXPECT_LT(widest, 0.0011) << "off the corner by 0.35 of the rounding at most";
  EXPECT_GT(narrowest, 0.0015);
  const Curve straight({{0, 0}, {0.05, 0}}, false, 0.003);
  for (double s = 0; s < 0.05; s += 0.001) EXPECT_NEAR(straight.at(s).point.y(), 0, 1e-12);
}

TEST(Curve, RefusesWhatCannotBeAFixture) {
  EXPECT_THROW(Curve({{0, 0}, {0.05, 0}, {0, 0}}, false, 0.003), SharpCorner) << "it turns back";
  EXPECT_THROW(Curve(kSquare, true, 0), SharpCorner) << "corners that nobody rounds";
  EXPECT_THROW(Curve({{0, 0}, {0.004, 0}}, false, 0), std::invalid_argument);
  EXPECT_THROW(Curve({{0.1, 0.1}}, false, 0), std::invalid_argument);
  EXPECT_THROW(Curve({}, true, 0), std::invalid_argument);
  try {
    std::ignore = Curve({{0, 0}, {0.05, 0.02}, {0, 0}}, false, 0.003);
  } catch (const SharpCorner& e) {
    EXPECT_LT((e.where() - Point(0.05, 0.02)).norm(), 0.004) << "the place is told";
  }
}

/// A tool goes along the curve within a tube in which nearest places are unique.
void expect_continuous(const Curve& curve, double tube, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-1, 1);
  CurvePlace before = curve.at(0);
  double off = 0, walked = 0;
  Point p = before.point, p_before = p;
  for (double s = 0; s < 1.5 * curve.length() && (curve.closed() || s < curve.length()); s += 2e-4) {
    const CurvePlace on = curve.at(s);
    off = std::clamp(off + 1e-4 * part(random), -tube, tube);
    p = on.point + off * Point(-on.tangent.y(), on.tangent.x());
    const CurvePlace now = curve.nearest(p, before.s);
    double way = now.s - before.s;
    if (curve.closed()) way -= curve.length() * std::round(way / curve.length());
    // Near the centre of a bend a place goes faster than the tool, by 1 / (1 - off / radius).
    ASSERT_LT(std::abs(way), 4 * (p - p_before).norm() + 3e-4) << "no jump at " << s;
    ASSERT_GT(before.tangent.dot(now.tangent), 0.5) << "nor does the frame turn at once at " << s;
    ASSERT_NEAR((p - now.point).norm(), std::abs(off), 2e-4);
    walked += way;
    before = now;
    p_before = p;
  }
  EXPECT_NEAR(walked, curve.closed() ? 1.5 * curve.length() : curve.length(), 2e-3)
      << "it stays on its branch";
}

TEST(Curve, NearestPlaceIsContinuousAroundCorners) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_continuous(Curve(kSquare, true, 0.003), 0.0012, seed);
  expect_continuous(Curve({{0, 0}, {0.05, 0}, {0.05, 0.05}, {0.08, 0.02}}, false, 0.004), 0.0005, 1);
}

TEST(Curve, NearestPlaceStaysOnItsBranchWhereTheCurveCrossesItself) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_continuous(eight(), 0.002, seed);
}

TEST(Curve, NearestPlaceOfAllIsNoFartherThanAnyOther) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.08, 0.08);
  const Curve curve = eight();
  for (int n = 0; n < 200; ++n) {
    const Point p(place(random), place(random));
    const double distance = (curve.nearest(p).point - p).norm();
    for (double s = 0; s < curve.length(); s += 1e-3)
      ASSERT_LE(distance, (curve.at(s).point - p).norm() + 1e-6);
  }
}

}  // namespace
}  // namespace mrroc::guide
