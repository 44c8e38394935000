#include "ecp/map/map_agent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/script_port.hpp"

namespace mrroc::ecp {
namespace {

using X = MapAgent::X;

/// a_1 drives along a circle; every fifth macrostep there is a reading of it.
class Circle {
 public:
  explicit Circle(unsigned seed) : random_(seed) {}

  static PlanarPose at(std::int64_t step) {
    const double s = 0.002 * static_cast<double>(step) * 0.5;
    return {std::sin(s), 1 - std::cos(s), wrap_angle(s)};
  }
  /// Image of macrostep i.
  X image(std::int64_t i, const PlanarPose& error = {}) {
    X x;
    PlatformEstimate& e = x.T.estimate;
    e.step = 10 * (i - 2);
    if (e.step > 0) {
      e.p = at(e.step);
      e.v = {0.5, 0, 0.5};
      e.covariance = {1e-5, 0, 0, 0, 1e-5, 0, 0, 0, 1e-5};
    } else {
      e = {};
    }
    const std::int64_t n = (10 * (i - 1) - 10) / 50;
    std::normal_distribution<double> noise;
    x.V = {50 * n, true, at(50 * n)};
    x.V.p.x += 0.005 * noise(random_) + error.x;
    x.V.p.y += 0.005 * noise(random_) + error.y;
    x.V.p.phi += 0.01 * noise(random_) + error.phi;
    return x;
  }

 private:
  std::mt19937 random_;
};

/// Executes the program on images. @return reports that were told, one per macrostep
std::vector<MapReport> run(std::vector<X> images) {
  images.back().T.finished = true;
  ScriptPort<MapAgent> port(std::move(images));
  X x;
  std::ignore = run_map_program(x, port);
  std::vector<MapReport> told;
  for (const auto& d : port.decisions()) told.push_back(d.y.T.map);
  return told;
}

TEST(MapAgent, PassesPlausibleReadingsOnInTheMacrostepInWhichItSeesThem) {
  Circle circle(1);
  X x = circle.image(7);
  x.i = 7;
  const MapSaid said = kLocate.f_cT(x);
  EXPECT_TRUE(said.map.pose.valid);
  EXPECT_EQ(said.map.pose.step, 50);
  EXPECT_GT(said.map.pose.covariance[0], 0);
}

TEST(MapAgent, BelievesNearlyAllReadingsWithTheNoiseThatItKnows) {
  Circle circle(2);
  std::vector<X> images;
  for (std::int64_t i = 1; i < 2000; ++i) images.push_back(circle.image(i));
  const auto told = run(images);
  EXPECT_LE(told.back().rejected, 4) << "of 400";
}

TEST(MapAgent, RejectsOutliersAndCountsThem) {
  Circle circle(3);
  std::vector<X> images;
  int outliers = 0;
  for (std::int64_t i = 1; i < 1000; ++i) {
    const bool wrong = i > 100 && (i / 5) % 10 == 0;
    images.push_back(circle.image(i, wrong ? PlanarPose{0.3, 0.2, 0} : PlanarPose{}));
    if (wrong && i % 5 == 2) ++outliers;
  }
  const auto told = run(images);
  EXPECT_NEAR(told.back().rejected, outliers, 2);
  for (const MapReport& r : told) {
    if (!r.pose.valid) continue;
    const PlanarPose is = Circle::at(r.pose.step);
    EXPECT_LT(std::hypot(r.pose.p.x - is.x, r.pose.p.y - is.y), 0.05);
  }
}

TEST(MapAgent, BelievesAMapThatHasJumpedAfterTwoRejectionsThatAgree) {
  Circle circle(4);
  std::vector<X> images;
  for (std::int64_t i = 1; i < 400; ++i)
    images.push_back(circle.image(i, i > 200 ? PlanarPose{0.4, 0, 0} : PlanarPose{}));
  const auto told = run(images);
  EXPECT_EQ(told.back().rejected, 2);
  const auto jumped = std::find_if(told.begin(), told.end(), [](const MapReport& r) {
    return r.pose.valid && r.pose.p.x - Circle::at(r.pose.step).x > 0.3;
  });
  ASSERT_NE(jumped, told.end());
  EXPECT_EQ(jumped->rejected, 2);
}

// One reading in 20: between two of them lies more than a_1's estimates that are remembered.
TEST(MapAgent, BelievesAMapThatHasJumpedHoweverRarelyItIsSeen) {
  for (const std::int64_t every : {2, 4, 20}) {
    Circle circle(5);
    std::vector<X> images;
    for (std::int64_t i = 1; i < 1200; ++i) {
      images.push_back(circle.image(i, i > 200 ? PlanarPose{0.4, 0, 0} : PlanarPose{}));
      images.back().V.seen = images.back().V.step / 50 % every == 0;
    }
    const auto told = run(images);
    const auto jumped = std::find_if(told.begin(), told.end(), [](const MapReport& r) {
      return r.pose.valid && r.pose.p.x - Circle::at(r.pose.step).x > 0.3;
    });
    ASSERT_NE(jumped, told.end()) << every;
    EXPECT_EQ(jumped->rejected, 2) << every;
  }
}

TEST(MapAgent, WrongReadingsInARowThatDisagreeOpenNoGate) {
  Circle circle(6);
  std::vector<X> images;
  for (std::int64_t i = 1; i < 200; ++i) {
    const double side = (i / 5) % 2 == 0 ? 0.4 : -0.4;
    images.push_back(circle.image(i, i > 100 && i < 160 ? PlanarPose{side, side, 0} : PlanarPose{}));
  }
  for (const MapReport& r : run(images)) {
    if (!r.pose.valid) continue;
    const PlanarPose is = Circle::at(r.pose.step);
    EXPECT_LT(std::hypot(r.pose.p.x - is.x, r.pose.p.y - is.y), 0.05) << r.pose.step;
  }
}

// Its position is wrong by more and more, and its covariance does not say so; its speed is wrong by 0.15 m/s only.
TEST(MapAgent, BelievesReadingsThatGoOnWhileTheEstimateDrifts) {
  Circle circle(7);
  std::vector<X> images;
  for (std::int64_t i = 1; i < 400; ++i) {
    images.push_back(circle.image(i));
    PlatformEstimate& e = images.back().T.estimate;
    if (i <= 200) continue;
    e.p.y += 0.003 * static_cast<double>(i - 200);
    e.v.vy += 0.15;
  }
  EXPECT_LE(run(images).back().rejected, 1);
}

TEST(MapAgent, MeasuresAReadingFromAnOlderOneByTheSpeedsBetweenThem) {
  MapMemory c;
  c.estimate[0] = {.step = 120, .p = {7, 7, 1}, .v = {1, 0, 0}};
  c.estimate[1] = {.step = 110, .p = {5, 5, 1}, .v = {1, 0, 0}};
  c.estimate[2] = {.step = 100, .p = {3, 3, 1}, .v = {0.5, 0, 0}};
  const MotionCapture before{100, true, {0, 0, 0}};
  EXPECT_LT(distance({150, true, {0.09, 0, 0}}, before, c), 1e-9) << "20 ms at 0.5 m/s, 80 ms at 1 m/s";
  EXPECT_GT(distance({150, true, {0.19, 0, 0}}, before, c), kGate);
  EXPECT_GT(distance({150, true, {0.09, 0, 0}}, {90, true, {}}, c), 1e9) << "speeds before 100 are not known";
  EXPECT_GT(distance({150, true, {0.09, 0, 0}}, {100, false, {}}, c), 1e9) << "it was not seen";
}

TEST(MapAgent, SaysThatThePositionIsLostAndComesBack) {
  Circle circle(5);
  std::vector<X> images;
  for (std::int64_t i = 1; i < 400; ++i) {
    images.push_back(circle.image(i));
    images.back().V.seen = i < 100 || i > 300;
  }
  ScriptPort<MapAgent> port(images);
  X x;
  EXPECT_EQ(run_map_program(x, port), Outcome::aborted);
  std::vector<int> behaviours;
  for (const auto& d : port.decisions()) {
    if (behaviours.empty() || behaviours.back() != d.m) behaviours.push_back(d.m);
    if (d.m == 2 && d.y.T.map.pose.valid) {
      EXPECT_GT(d.y.T.map.pose.step, 2500) << "of the last macrostep of it";
    }
  }
  EXPECT_EQ(behaviours, (std::vector<int>{1, 2, 1}));
}

TEST(MapAgent, CarriesTheEstimateOnToTheReadingsStep) {
  MapMemory c;
  c.estimate[0] = {.step = 100, .p = {1, 0, std::numbers::pi / 2}, .v = {1, 0, 0}};
  const PlatformEstimate e = estimate_at(c, 150);
  EXPECT_NEAR(e.p.y, 0.1, 1e-12);
  EXPECT_NEAR(e.p.x, 1, 1e-12);
  EXPECT_EQ(estimate_at({}, 150).step, 0);
}

TEST(MapAgent, TheHeadingsDifferenceIsWrapped) {
  const double pi = std::numbers::pi;
  MotionCapture reading{50, true, {0, 0, pi - 0.001}};
  PlatformEstimate e;
  e.step = 50;
  e.p.phi = -pi + 0.001;
  e.covariance = {1e-5, 0, 0, 0, 1e-5, 0, 0, 0, 1e-5};
  EXPECT_LT(distance(reading, e, {}), 0.1);
}

}  // namespace
}  // namespace mrroc::ecp
