#include "ecp/generators/polyline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/fault.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

constexpr double kStep = 0.02;

MotionLimits some_limits() {
  MotionLimits limits{Coordinates(6), Coordinates(6)};
  limits.velocity << 250, 200, 250, 150, 250, 250;
  limits.acceleration << 1000, 1500, 2000, 1000, 1200, 1800;
  return limits;
}

struct Case {
  Coordinates from;
  std::vector<ViaPoint> list;
};

Case random_case(RandomList& random) {
  Case c{random.pose(6, 200), {}};
  const int n = random.whole(1, 6);
  for (int k = 0; k < n; ++k) {
    // Some lines are short, some go on nearly straight.
    const Coordinates before = k == 0 ? c.from : c.list.back().pose;
    Coordinates pose = before + random.pose(6, random.whole(0, 1) == 1 ? 5 : 200);
    if (k > 0 && random.whole(0, 2) == 0)
      pose = before + 0.3 * (before - (k == 1 ? c.from : c.list[c.list.size() - 2].pose)) + random.pose(6, 1);
    c.list.push_back({pose, random.between(0.05, 1), random.between(0.1, 1), random.whole(0, 3) > 0});
  }
  return c;
}

/// @return distance from the nearest of the lines
double aside(const Case& c, const Coordinates& q) {
  double least = 1e9;
  Coordinates from = c.from;
  for (const ViaPoint& via : c.list) {
    const Coordinates way = via.pose - from;
    const double share = way.norm() > 0 ? std::clamp((q - from).dot(way) / way.squaredNorm(), 0., 1.) : 0;
    least = std::min(least, (q - from - share * way).norm());
    from = via.pose;
  }
  return least;
}

TEST(Polyline, StaysOnItsLinesFromTheFirstPoseToTheLast) {
  RandomList random(1);
  for (int k = 0; k < 200; ++k) {
    const Case c = random_case(random);
    const Polyline curve(c.from, c.list, some_limits(), kStep);
    EXPECT_EQ(curve.at(0), c.from);
    EXPECT_EQ(curve.at(-1), c.from);
    EXPECT_EQ(curve.at(curve.duration() + 1), c.list.back().pose);
    EXPECT_NEAR((curve.at(curve.duration() * (1 - 1e-9)) - c.list.back().pose).norm(), 0, 1e-4) << "a jump";
    for (double t = 0; t < curve.duration(); t += kStep / 3) EXPECT_LT(aside(c, curve.at(t)), 1e-6);
  }
}

TEST(Polyline, PassesEveryPoseOfItsList) {
  RandomList random(2);
  for (int k = 0; k < 50; ++k) {
    const Case c = random_case(random);
    const Polyline curve(c.from, c.list, some_limits(), kStep);
    for (const ViaPoint& via : c.list) {
      double nearest = 1e9;
      for (double t = 0; t <= curve.duration() + 1e-3; t += 1e-3)
        nearest = std::min(nearest, (curve.at(t) - via.pose).norm());
      EXPECT_LT(nearest, 0.7);
    }
  }
}

TEST(Polyline, KeepsToSpeedsAndToWhatAMacrostepMayChangeThem) {
  RandomList random(3);
  for (int k = 0; k < 200; ++k) {
    Case c = random_case(random);
    const double v = random.between(0.1, 1), a = random.between(0.2, 1);
    for (ViaPoint& via : c.list) via.velocity = v, via.acceleration = a;
    const MotionLimits limits = some_limits();
    const Polyline curve(c.from, c.list, limits, kStep);
    Coordinates before = Coordinates::Zero(6);
    const int steps = static_cast<int>(std::ceil(curve.duration() / kStep));
    for (int s = 0; s <= steps; ++s) {
      const Coordinates speed = (curve.at((s + 1) * kStep) - curve.at(s * kStep)) / kStep;
      EXPECT_LE(share_of(speed, limits.velocity), v * (1 + 1e-9));
      // A corner and both its ramps may be in two macrosteps; and the next corner soon after it.
      EXPECT_LE(share_of(speed - before, limits.acceleration), a * 3 * kStep * (1 + 1e-9));
      before = speed;
    }
  }
}

TEST(Polyline, OneLineTakesItsTimeAtFullSpeedAndOneRamp) {
  const MotionLimits limits{Coordinates::Constant(2, 100), Coordinates::Constant(2, 400)};
  Coordinates to(2);
  to << 200, -50;
  EXPECT_NEAR(Polyline(Coordinates::Zero(2), {{to, 1, 1}}, limits, kStep).duration(), 2 + 0.25, 1e-12);
  EXPECT_NEAR(Polyline(Coordinates::Zero(2), {{to, 0.5, 1}}, limits, kStep).duration(), 4 + 0.125, 1e-12);
  // Too short for full speed.
  EXPECT_NEAR(Polyline(Coordinates::Zero(2), {{to / 200, 1, 1}}, limits, kStep).duration(), 0.1, 1e-12);
}

TEST(Polyline, AWayInShortPiecesTakesNoLongerThanInOne) {
  RandomList random(4);
  for (int k = 0; k < 50; ++k) {
    const Coordinates from = random.pose(6, 100), to = random.pose(6, 100);
    std::vector<ViaPoint> pieces;
    const int n = random.whole(2, 30);
    for (int part = 1; part <= n; ++part)
      pieces.push_back({from + (to - from) * (static_cast<double>(part) / n), 0.7, 0.8, true});
    const double whole = Polyline(from, {{to, 0.7, 0.8}}, some_limits(), kStep).duration();
    EXPECT_NEAR(Polyline(from, pieces, some_limits(), kStep).duration(), whole, 1e-9);
  }
}

TEST(Polyline, StopsWhereItIsToldTo) {
  const MotionLimits limits{Coordinates::Constant(1, 100), Coordinates::Constant(1, 400)};
  const auto time = [&](bool pass) {
    return Polyline(Coordinates::Zero(1),
                    {{Coordinates::Constant(1, 100), 1, 1, pass}, {Coordinates::Constant(1, 200), 1, 1}},
                    limits, kStep)
        .duration();
  };
  EXPECT_NEAR(time(true), 2.25, 1e-12);
  EXPECT_NEAR(time(false), 2.5, 1e-12);
}

TEST(Polyline, APoseThatIsGivenTwiceIsPassedAsIfItWereGivenOnceAndStopsWhereOneOfBothDoes) {
  const MotionLimits limits{Coordinates::Constant(2, 100), Coordinates::Constant(2, 400)};
  const auto at = [](double x, double y) -> Coordinates { return Eigen::Vector2d(x, y); };
  const auto time = [&](const std::vector<ViaPoint>& list) {
    return Polyline(at(0, 0), list, limits, kStep).duration();
  };
  const ViaPoint corner{at(100, 0), 1, 1, true}, stop{at(100, 0), 1, 1, false}, end{at(100, 100), 1, 1};
  const double passing = time({corner, end}), stopping = time({stop, end});
  EXPECT_LT(passing, stopping - 0.01);
  EXPECT_NEAR(time({corner, corner, end}), passing, 1e-12);
  EXPECT_NEAR(time({corner, corner, corner, end}), passing, 1e-12);
  EXPECT_NEAR(time({corner, stop, end}), stopping, 1e-12);
  EXPECT_NEAR(time({stop, corner, end}), stopping, 1e-12);
  EXPECT_NEAR(time({corner, end, end}), passing, 1e-12);
}

TEST(Polyline, NoMotionTakesNoTime) {
  const Coordinates here = Coordinates::Constant(6, 0.3);
  const Polyline curve(here, {{here, 1, 1, true}, {here}}, some_limits(), kStep);
  EXPECT_EQ(curve.duration(), 0);
  EXPECT_EQ(curve.at(0), here);
}

TEST(Polyline, RefusesListsThatCannotBeMeant) {
  const Coordinates here = Coordinates::Zero(6);
  const auto make = [&](const std::vector<ViaPoint>& list) {
    return Polyline(here, list, some_limits(), kStep);
  };
  EXPECT_THROW(make({}), FaultError);
  EXPECT_THROW(make({{Coordinates::Zero(5)}}), FaultError);
  EXPECT_THROW(make({{here, 0}}), FaultError);
  EXPECT_THROW(make({{here, 0.5, NAN}}), FaultError);
}

}  // namespace
}  // namespace mrroc::ecp
