// Thresholds of the pen's automaton from both sides, and the filters before it.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <deque>
#include <numeric>
#include <random>

#include "test/vsp/pen.hpp"

namespace mrroc::vsp {
namespace {

using enum PenState;
using test::kDt;
using test::Pen;

const Vector3 kDown{std::numbers::pi, 0, 0};

double mean(const std::deque<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

TEST(TrendOfAnySignal, IsTheMeanOfTheMeansOfT) {
  std::mt19937 random(2);
  std::normal_distribution<> n;
  for (const std::size_t samples : {1U, 2U, 7U, 125U, 250U}) {
    Trend trend(samples);
    for (int run = 0; run < 2; ++run) {  // it forgets what was before
      trend.begin(0.3 * run);
      std::deque<double> x(samples, 0.3 * run), means(samples, 0.3 * run);
      EXPECT_NEAR(trend.value(), 0.3 * run, 1e-12);
      EXPECT_EQ(trend.rate(), 0);
      for (int k = 0; k < 600; ++k) {
        const double before = mean(means);
        x.push_back(n(random));
        x.pop_front();
        means.push_back(mean(x));
        means.pop_front();
        trend.add(x.back());
        ASSERT_NEAR(trend.value(), mean(means), 1e-9) << samples << ' ' << k;
        ASSERT_NEAR(trend.rate(), mean(means) - before, 1e-9) << samples << ' ' << k;
      }
    }
  }
}

TEST(TrendOfAnySignal, HasForgottenEverythingWhenItBeginsAnew) {
  Trend trend(7);
  for (int k = 0; k < 10; ++k) trend.add(k * k);
  trend.begin(3);
  EXPECT_EQ(trend.rate(), 0);
  EXPECT_EQ(trend.value(), 3);
  Trend fresh(7);
  fresh.begin(3);
  for (int k = 0; k < 20; ++k) {
    trend.add(k % 5);
    fresh.add(k % 5);
    ASSERT_EQ(trend.value(), fresh.value());
    ASSERT_EQ(trend.rate(), fresh.rate());
  }
}

TEST(TrendOfAnySignal, HasAtLeastOneSampleAndAtMostThoseThatFit) {
  Trend none(0), many(Trend::kMost + 5), most(Trend::kMost);
  for (Trend* const t : {&none, &many, &most}) t->begin(0);
  for (int k = 0; k < 700; ++k) {
    for (Trend* const t : {&none, &many, &most}) t->add(k * k);
    EXPECT_EQ(none.value(), k * k);
    EXPECT_EQ(many.value(), most.value());
  }
}

// Bayes: the paper is a plane through all points, each of its weight, with a slope that is known beforehand.
TEST(TouchedPlaneOfAnyPoints, IsTheLikeliestOne) {
  std::mt19937 random(4);
  std::uniform_real_distribution<> at(-0.1, 0.1), off(-0.001, 0.001);
  const PlaneParameters k{.slope = 0.03, .roughness = 0.0004, .correlation = 0.2, .memory = 3};
  TouchedPlane plane(k);
  for (int run = 0; run < 2; ++run) {
    const Vector3 first(0.1 + run, 0.2, 0.3);
    Matrix3 H = Matrix3::Zero();
    Vector3 g = Vector3::Zero();
    H(1, 1) = H(2, 2) = 1 / (k.slope * k.slope);
    Matrix3 points = Matrix3::Zero();
    for (int n = 0; n < 80; ++n) {
      const double dt = 0.002 * (1 + n % 3);
      const Vector3 p = n == 0 ? first : Vector3(first + Vector3(at(random), at(random), off(random)));
      plane.add(p, dt);
      ASSERT_TRUE(plane.known());
      const Vector3 s(1, p.x() - first.x(), p.y() - first.y());
      const double forget = std::exp(-dt / k.memory),
                   weight = dt / (k.correlation * std::pow(k.roughness, 2));
      points = forget * points + weight * s * s.transpose();
      g = forget * g + weight * (p.z() - first.z()) * s;
      const Matrix3 covariance = (H + points).inverse();
      const Vector3 there(first.x() + at(random), first.y() + at(random), 9);
      const Vector3 r(1, there.x() - first.x(), there.y() - first.y());
      ASSERT_NEAR(plane.depth(there), first.z() + r.dot(covariance * g), 1e-9);
      ASSERT_NEAR(plane.deviation(there), std::sqrt(r.dot(covariance * r)), 1e-9);
    }
    plane.forget();
    EXPECT_FALSE(plane.known());
  }
}

TEST(PenFilters, FollowASteppedForceAndSpeedWithTheirTimeConstants) {
  for (const double dt : {0.002, 0.004}) {
    const PenStateParameters k{.dt = dt, .v_filter = 0.02, .F_filter = 0.008, .paper = {}};
    PenStateSensor sensor(k);
    StepSample s;
    const auto take = [&](double advance, double F) {
      s.T_0E[2] += advance;
      s.F_a[Axis::z] = F;
      sensor.step(s);
      return sensor.reading();
    };
    take(0, 1);
    double v = 0, F = 1;
    for (int n = 0; n < 60; ++n) {
      v += (0.1 - v) * dt / 0.02;
      F += (3 - F) * dt / 0.008;
      const SensorReading r = take(0.1 * dt, 3);
      EXPECT_NEAR(r.value[1], v, 1e-9) << n;
      EXPECT_NEAR(r.value[2], F, 1e-9) << n;
    }
  }
}

TEST(PenFilters, ThatAreFasterThanAStepFollowAtOnce) {
  Pen pen(kDown, {.v_filter = 0.001, .F_filter = 0.001, .paper = {}});
  pen.move(0.1, 3, kDt);
  const SensorReading r = pen.sensor.reading();
  EXPECT_NEAR(r.value[1], 0.1, 1e-9);
  EXPECT_NEAR(r.value[2], 3, 1e-9);
}

TEST(PenJump, IsMoreThanFiveMillimetresInAStep) {
  for (const double sign : {1.0, -1.0}) {
    Pen fast, jumped;
    fast.move(sign * 0.0049 / kDt, 2, kDt);
    EXPECT_NE(fast.sensor.reading().value[1], 0);
    jumped.move(sign * 0.0051 / kDt, 2, kDt);
    const SensorReading r = jumped.sensor.reading();
    EXPECT_EQ(r.value[1], 0) << "no motion";
    EXPECT_EQ(r.value[2], 2) << "the force has always been so";
    EXPECT_TRUE(r.valid);
  }
}

TEST(PenThreshold, AnArmHasSettledWhenItWasSlowForHalfASecond) {
  const auto lowers = [](double drift, double seconds) {
    Pen pen(kDown, {}, kDt);
    pen.move(drift, 0, seconds);
    pen.move(0.01, 0, 0.3);
    return pen.sensor.state() == lowering;
  };
  EXPECT_FALSE(lowers(0, 0.48));
  EXPECT_TRUE(lowers(0, 0.52));
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(lowers(sign * 0.0014, 0.6));
    EXPECT_FALSE(lowers(sign * 0.0016, 0.9));
  }
}

TEST(PenThreshold, LoweringIsFasterThanFiveMillimetresASecond) {
  Pen slow, fast;
  slow.move(0.0049, 0, 1);
  EXPECT_EQ(slow.sensor.state(), above_paper);
  fast.move(0.0051, 0, 1);
  EXPECT_EQ(fast.sensor.state(), lowering);
}

// Trends follow within half a second.
TEST(PenThreshold, LoweringEndsWhenItTurnsBackOrRests) {
  const auto after = [](double v, double seconds) {
    Pen pen;
    pen.move(0.01, 0, 0.6);
    EXPECT_EQ(pen.sensor.state(), lowering);
    pen.move(v, 0, seconds);
    return pen.sensor.state();
  };
  EXPECT_EQ(after(-0.0028, 0.9), lowering);
  EXPECT_EQ(after(-0.0032, 0.9), above_paper);
  EXPECT_EQ(after(0.0016, 3), lowering);
  EXPECT_EQ(after(-0.0016, 3), lowering);
  EXPECT_EQ(after(0.0014, 3), above_paper);
  EXPECT_EQ(after(-0.0014, 3), above_paper);
  EXPECT_EQ(after(0, 0.8), lowering) << "at rest for less than half a second after the trend has settled";
  EXPECT_EQ(after(0, 1.0), above_paper);
}

TEST(PenThreshold, AnImpactRaisesTheForceByFiveQuartersOfANewton) {
  const auto hit = [](double F) {
    Pen pen;
    pen.move(0.01, 0, 0.6);
    pen.move(0.01, F, 0.06);
    return pen.sensor.state() == paper_surface;
  };
  // The filter lets 98 % through within the impact's time.
  EXPECT_FALSE(hit(1.26));
  EXPECT_TRUE(hit(1.29));
}

// While the hand pulls to and fro the force must rise by two amplitudes more.
TEST(PenThreshold, AnImpactInATremorIsLarger) {
  const auto hit = [](double F) {
    Pen pen;
    pen.move(0.01, 0, 0.6);
    pen.go([](double) { return 0.01; }, [](double t) { return 0.5 * std::sin(2 * std::numbers::pi * 8 * t); },
           0.5);
    EXPECT_EQ(pen.sensor.state(), lowering);
    pen.move(0.01, F, 0.06);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_FALSE(hit(1.9));
  EXPECT_TRUE(hit(2.6));
}

TEST(PenThreshold, AStopBrakesToAQuarterAndPressesByEightTenths) {
  const auto stopped = [](double v, double F) {
    Pen pen;
    pen.move(0.01, 0, 0.8);
    EXPECT_EQ(pen.sensor.state(), lowering);
    pen.go([v](double) { return v; }, [F](double t) { return F * std::min(1.0, t / 0.6); }, 2);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_TRUE(stopped(0.0024, 0.85));
  EXPECT_FALSE(stopped(0.0024, 0.75));
  EXPECT_FALSE(stopped(0.0027, 0.85));
}

// A hand that held the pen back while it was lowered need not press as much in the end.
TEST(PenThreshold, AStopIsJudgedFromTheLeastForceOfTheLowering) {
  const auto stopped = [](double held_back) {
    Pen pen;
    pen.go([](double) { return 0.01; }, [=](double t) { return -held_back * std::min(1.0, t / 0.4); }, 1.2);
    EXPECT_EQ(pen.sensor.state(), lowering);
    pen.go([](double) { return 0.0024; },
           [=](double t) { return -held_back + (0.4 + held_back) * std::min(1.0, t / 0.6); }, 2);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_FALSE(stopped(0.35));
  EXPECT_TRUE(stopped(0.5));
}

TEST(PenThreshold, AForceOfTwelveTenthsAtRestIsThePaper) {
  const auto pressed = [](double v, double F) {
    Pen pen;
    pen.move(v, F, 1.5);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_FALSE(pressed(0, 1.19));
  EXPECT_TRUE(pressed(0, 1.22));
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(pressed(sign * 0.0014, 2));
    EXPECT_FALSE(pressed(sign * 0.0016, 2));
  }
}

// How long it takes grows by what must be waited for.
TEST(PenThreshold, TimesAreWaitedFor) {
  const auto pressing = [](double time) {
    Pen pen(kDown, {.rest_force_time = time, .paper = {}});
    int steps = 0;
    for (; pen.sensor.state() != paper_surface && steps < 2000; ++steps) pen.step(3);
    return kDt * steps;
  };
  EXPECT_NEAR(pressing(0.5) - pressing(0.2), 0.3, 1.5 * kDt);
  const auto resting = [](double time) {
    Pen pen(kDown, {.rest_time = time, .paper = {}}, 1);
    pen.move(0.01, 0, 0.6);
    int steps = 0;
    for (; pen.sensor.state() == lowering && steps < 2000; ++steps) pen.step(0);
    return kDt * steps;
  };
  EXPECT_NEAR(resting(0.7) - resting(0.3), 0.4, 1.5 * kDt);
}

class OnPaper : public testing::Test {
 protected:
  OnPaper() {
    pen_.touch();
    pen_.rest(1, 3);
    EXPECT_EQ(pen_.sensor.state(), paper_surface);
  }
  Pen pen_;
};

TEST_F(OnPaper, ThePenLiftsOffWhenItIsHigherThanTheLiftHeight) {
  pen_.move(-0.01, 0, 0.21);
  EXPECT_EQ(pen_.sensor.state(), paper_surface);
  EXPECT_EQ(pen_.lift_offs_read, 0);
  pen_.move(-0.01, 0, 0.03);
  EXPECT_EQ(pen_.lift_offs_read, 1);
  EXPECT_EQ(pen_.sensor.state(), above_paper);
}

TEST_F(OnPaper, ThePenSinksByTwoMillimetresAtMost) {
  pen_.move(0.01, 1, 0.19);
  EXPECT_EQ(pen_.sensor.state(), paper_surface);
  pen_.move(0.01, 1, 0.03);
  EXPECT_EQ(pen_.sensor.state(), lowering) << "what it touched was not the paper";
}

TEST_F(OnPaper, APenThatSinksSlowlyIsFollowed) {
  pen_.move(0.0045, 1, 1);
  EXPECT_EQ(pen_.sensor.state(), paper_surface);
}

TEST_F(OnPaper, AbovePaperThatIsKnownTheTouchHeightDecides) {
  const auto lowered_to = [this](double height) {
    Pen pen = pen_;
    pen.move(-0.01, 0, 1);
    pen.rest(0, 0.6);
    pen.move(0.01, 0, 1 - height / 0.01);
    EXPECT_EQ(pen.sensor.state(), lowering) << height;
    pen.rest(0, 0.2);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_TRUE(lowered_to(0.0011));
  EXPECT_FALSE(lowered_to(0.0014));
}

TEST_F(OnPaper, AtTheTouchHeightThePenMustHaveBraked) {
  const auto lowers_on = [this](double v) {
    Pen pen = pen_;
    pen.move(-0.01, 0, 1);
    pen.rest(0, 0.6);
    pen.move(0.01, 0, 0.8);
    pen.move(v, 0, 0.0018 / v);
    return pen.sensor.state();
  };
  EXPECT_EQ(lowers_on(0.0032), lowering);
  EXPECT_EQ(lowers_on(0.0028), paper_surface);
}

// Five centimetres aside a sheet that nobody has touched there may be a millimetre higher or lower, and three times that.
TEST_F(OnPaper, AsideOfWhereItWasTouchedThePaperMayBeHigherByThreeDeviations) {
  const auto hit_at = [this](double height) {
    Pen pen = pen_;
    pen.move(-0.01, 0, 1);
    pen.go([](double) { return 0; },
           [&pen](double t) {
             pen.aside = 0.05 * t;
             return 0;
           },
           1);
    pen.rest(0, 0.6);
    pen.move(0.01, 0, 1 - height / 0.01);
    EXPECT_EQ(pen.sensor.state(), lowering);
    pen.move(0.01, 3, 0.02);
    return pen.sensor.state() == paper_surface;
  };
  EXPECT_TRUE(hit_at(0.0039));
  EXPECT_FALSE(hit_at(0.0046));
}

}  // namespace
}  // namespace mrroc::vsp
