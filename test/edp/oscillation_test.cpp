#include "edp/oscillation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
const AxisSet kAll("111111");

/// A swinging force on one axis.
struct Signal {
  double mean{5}, swing{1}, frequency{12};
  double factor{1};  // of the swing per period
  double noise{0.1};
};

/// @return steps until the observer speaks, or -1
int steps_until_told(const Signal& s, Axis axis = Axis::z, double seconds = 3, AxisSet watched = kAll,
                     std::optional<Fault>* fault = nullptr) {
  OscillationObserver observer({}, kDt);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, axis < Axis::ax ? s.noise : s.noise / 10);
  for (int k = 0; k * kDt < seconds; ++k) {
    const double t = k * kDt;
    Wrench F;
    const double swing = s.swing * std::pow(s.factor, t * s.frequency);
    F[axis] = s.mean + swing / 2 * std::sin(2 * std::numbers::pi * s.frequency * t) + noise(random);
    if (const auto told = observer.step(F, watched)) {
      if (fault) *fault = told;
      return k;
    }
  }
  return -1;
}

TEST(Oscillation, GrowingSwingsAreToldWithAxisAndFrequency) {
  for (const Axis axis : kAxes)
    for (const double frequency : {5., 9., 20., 40.}) {
      const double scale = axis < Axis::ax ? 1 : 0.1;
      std::optional<Fault> fault;
      const Signal s{5 * scale, 0.5 * scale, frequency, 1.3};
      const int steps = steps_until_told(s, axis, 5, kAll, &fault);
      ASSERT_GE(steps, 0) << frequency << " Hz, axis " << static_cast<int>(axis);
      EXPECT_EQ(fault->code, FaultCode::contact_unstable);
      EXPECT_EQ(fault->axis, static_cast<int>(axis));
      const std::string text(fault->text.view());
      EXPECT_NEAR(std::stod(text.substr(text.find(" at ") + 4)), frequency, 0.1 * frequency) << text;
      EXPECT_NEAR(std::stod(text.substr(text.find("Hz, ") + 4)), 1.3, 0.15) << text;
      EXPECT_LT(fault->value, 2 * std::pow(1.3, 5) * scale)
          << "it is told before the swing has grown far beyond its bound";
    }
}

TEST(Oscillation, OfTheGearsIsToldAsSuch) {
  for (const double gears : {0., 10., 30.}) {
    OscillationObserver observer({.gears = gears}, kDt);
    std::optional<Fault> fault;
    for (int k = 0; k < 1500 && !fault; ++k) {
      Wrench F;
      F[Axis::z] = 5 + std::pow(1.001, k) * std::sin(2 * std::numbers::pi * 11 * k * kDt);
      fault = observer.step(F, kAll);
    }
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->text.view().find("gears give way") != std::string_view::npos, gears == 10) << gears;
  }
}

TEST(Oscillation, IsToldWithIAndBOfItsAxis) {
  TaskFrameCommand rows;
  rows.y = c(3, 8, 0.0125);
  rows.z = g(0.02, 5, 0.025);
  Fault swings{
      .code = FaultCode::contact_unstable, .axis = static_cast<int>(Axis::z), .text = "along z of E"};
  EXPECT_EQ(with_law(swings, rows).text.view(), "along z of E; I = 5, B = 0.025");
  swings.axis = static_cast<int>(Axis::y);
  EXPECT_EQ(with_law(swings, rows).text.view(), "along z of E; I = 8, B = 0.0125");
  swings.text = std::string(160, 'a');
  EXPECT_EQ(with_law(swings, rows).text.view().size(), 159U) << "what does not fit is cut off";
}

/// Swings between given extrema, each over its own number of steps: half a cosine.
struct Swings {
  std::vector<double> extremum;
  std::vector<int> steps;  // to the next one

  /// @return force in step k, and the number of the half
  [[nodiscard]] std::pair<double, std::size_t> at(int k) const {
    std::size_t n = 0;
    for (; n + 2 < extremum.size() && k > steps[n]; ++n) k -= steps[n];
    const double part = (1 - std::cos(std::numbers::pi * k / steps[n])) / 2;
    return {extremum[n] + part * (extremum[n + 1] - extremum[n]), n};
  }
};

TEST(Oscillation, WhatIsToldAreTheTimesAndSwingsBetweenExtremaWhenPeriodsBecomeShorter) {
  for (const double change : {0.94, 1.06}) {
    Swings s{{5}, {}};
    double swing = 0.5, half = change < 1 ? 55 : 25;
    for (int n = 0; n < 40; ++n) {
      s.extremum.push_back(5 + (n % 2 == 0 ? swing : 0));
      s.steps.push_back(static_cast<int>(std::lround(half)));
      swing *= 1.15;
      half = std::clamp(change * half, 20., 60.);
    }
    OscillationObserver observer({}, kDt);
    for (int k = 0;; ++k) {
      const auto [force, n] = s.at(k);
      Wrench F;
      F[Axis::y] = force;
      const std::optional<Fault> told = observer.step(F, kAll);
      if (!told) {
        ASSERT_LT(k, 1500);
        continue;
      }
      double time = 0;
      for (std::size_t back = 1; back <= 8; ++back) time += kDt * s.steps[n - back];
      const auto size = [&](std::size_t half_no) {
        return std::abs(s.extremum[half_no + 1] - s.extremum[half_no]);
      };
      EXPECT_NEAR(told->value, (size(n - 1) + size(n - 2)) / 2, 1e-9);
      const double first = (size(n - 7) + size(n - 8)) / 2;
      const std::string text(told->text.view());
      EXPECT_NEAR(std::stod(text.substr(text.find(" at ") + 4)), 4 / time, 0.051) << text;
      EXPECT_NEAR(std::stod(text.substr(text.find("Hz, ") + 4)), std::cbrt(told->value / first), 0.0051)
          << text;
      break;
    }
  }
}

TEST(Oscillation, OnlySwingsFrom4To60HzAreTold) {
  const auto told = [](double frequency) {
    constexpr double kShort = 1e-4;  // so that periods are not rounded
    OscillationObserver observer({}, kShort);
    for (double t = 0; t < 3; t += kShort) {
      Wrench F;
      F[Axis::x] = 10 + 8 * std::sin(2 * std::numbers::pi * frequency * t);
      if (observer.step(F, kAll)) return true;
    }
    return false;
  };
  for (const double frequency : {3.95, 60.5}) EXPECT_FALSE(told(frequency)) << frequency;
  for (const double frequency : {4.05, 59.5}) EXPECT_TRUE(told(frequency)) << frequency;
}

/// @return whether swings are told that change by a factor from period to period, from a first one on
bool told(Axis axis, double first, double factor, int periods) {
  Swings s{{0}, {}};
  double swing = first;
  for (int n = 0; n < 2 * periods + 2; ++n) {
    s.extremum.push_back(s.extremum.back() + (n % 2 == 0 ? swing : -swing));
    s.steps.push_back(20);  // 12.5 Hz
    swing *= std::sqrt(factor);
  }
  OscillationObserver observer({}, kDt);
  for (int k = 0; k < 40 * periods; ++k) {
    Wrench F;
    F[axis] = 40 * first + s.at(k).first;
    if (observer.step(F, kAll)) return true;
  }
  return false;
}

/// @return whether swings above a level are told that fall so many of 12 steps, and rise for the others
bool told_of_halves(double level, int fall) {
  Swings s{{level, level}, {20}};
  double swing = 2.05;
  for (int n = 0; n < 8; ++n, swing *= 1.15)
    for (const bool up : {true, false}) {
      s.extremum.push_back(up ? level + swing : level);
      s.steps.push_back(up ? 12 - fall : fall);
    }
  OscillationObserver observer({}, kDt);
  for (int k = 0; k < 20 + 12 * 8; ++k) {
    Wrench F;
    F[Axis::x] = s.at(k).first;
    if (observer.step(F, kAll)) return true;
  }
  return false;
}

TEST(Oscillation, AForceThatJumpsBackWhileContactIsKeptIsNone) {
  for (const int fall : {1, 2}) EXPECT_FALSE(told_of_halves(3, fall)) << fall;
  for (const int fall : {3, 6, 9}) EXPECT_TRUE(told_of_halves(3, fall)) << fall;
  for (const int rise : {1, 2}) EXPECT_FALSE(told_of_halves(3, 12 - rise)) << rise;
  EXPECT_TRUE(told_of_halves(0.2, 1)) << "contact is lost: it bounces";
  EXPECT_TRUE(told_of_halves(-1, 1)) << "so it does where the force changes its sign";
}

TEST(Oscillation, APeriodThatLastsMoreThanTwiceAsLongAsAnotherIsNoneOfAnOscillation) {
  const auto is_told = [](int other_half) {
    Swings s{{0}, {}};
    for (int n = 0; n < 24; ++n) {
      s.extremum.push_back(n % 2 == 0 ? 10 : 0);
      s.steps.push_back((n + 1) / 2 % 2 == 0 ? 20 : other_half);  // every second period, from peak to peak
    }
    OscillationObserver observer({}, kDt);
    for (int k = 0; s.at(k).second + 1 < s.steps.size(); ++k) {
      Wrench F;
      F[Axis::y] = 20 + s.at(k).first;
      if (observer.step(F, kAll)) return true;
    }
    return false;
  };
  EXPECT_TRUE(is_told(20)) << "an even one";
  EXPECT_TRUE(is_told(39));
  EXPECT_TRUE(is_told(11));
  EXPECT_FALSE(is_told(41));
  EXPECT_FALSE(is_told(9));
}

TEST(Oscillation, SwingsOfWhichOneIsMuchSmallerThanTheOneBeforeAreNoOscillation) {
  // Two halves of a period, and the same swing in the end as in the beginning.
  const auto is_told = [](double second) {
    Swings s{{0}, {}};
    bool up = true;
    for (const double swing : {10., 10., 10., second, second, 10., 10., 10., 10., 8., 8., 6., 6.}) {
      s.extremum.push_back(s.extremum.back() + (up ? swing : -swing));
      s.steps.push_back(20);  // 12.5 Hz
      up = !up;
    }
    OscillationObserver observer({}, kDt);
    for (int k = 0; s.at(k).second + 1 < s.steps.size(); ++k) {
      Wrench F;
      F[Axis::x] = 100 + s.at(k).first;
      if (observer.step(F, kAll)) return true;
    }
    return false;
  };
  EXPECT_TRUE(is_told(10));
  EXPECT_TRUE(is_told(14.2)) << "0.704 of it";
  EXPECT_FALSE(is_told(14.4)) << "0.694 of it";
  EXPECT_FALSE(is_told(30));
}

TEST(Oscillation, TheWayToTheFirstExtremumIsNoSwing) {
  for (const int begin : {0, 5, 10, 15, 25, 33}) {
    OscillationObserver observer({}, kDt);
    for (int k = begin; k < 400; ++k) {
      Wrench F;
      F[Axis::z] = 30 + 8 * std::pow(0.96, k / 40.) * std::sin(2 * std::numbers::pi * k / 40);
      ASSERT_FALSE(observer.step(F, kAll)) << "it decays, seen from step " << begin;
    }
  }
}

TEST(Oscillation, AForceThatJumpsAndCreepsBackSwingsAsOftenAsItJumps) {
  constexpr int kHalf = 20;  // steps: 12.5 Hz
  OscillationObserver observer({}, kDt);
  std::optional<Fault> fault;
  double swing = 8;
  for (int k = 0; k < 20 * kHalf && !fault; ++k) {
    if (k % kHalf == 0) swing *= -1.1;
    Wrench F;
    F[Axis::z] = 60 + swing / 2 * (1 - 0.002 * (k % kHalf));
    fault = observer.step(F, kAll);
  }
  ASSERT_TRUE(fault);
  const std::string text(fault->text.view());
  EXPECT_NEAR(std::stod(text.substr(text.find(" at ") + 4)), 12.5, 0.2) << text;
}

TEST(Oscillation, SmallSwingsMustGrowByATenthAndLargeOnesHardlyDecay) {
  for (const Axis axis : kAxes) {
    const double least = axis < Axis::ax ? 2 : 0.2;
    EXPECT_TRUE(told(axis, 1.1 * least, 1.12, 6)) << "below twice the least";
    EXPECT_FALSE(told(axis, 1.1 * least, 1.08, 6));
    EXPECT_FALSE(told(axis, 0.4 * least, 1.12, 6)) << "too small";
    EXPECT_TRUE(told(axis, 6 * least, 0.98, 8));
    EXPECT_FALSE(told(axis, 6 * least, 0.96, 8));
  }
}

TEST(Oscillation, ItIsToldWhenTheForceComesDownFromAPeak) {
  for (const double mean : {5., -5.}) {
    OscillationObserver observer({}, kDt);
    double before = 0;
    bool told = false;
    for (int k = 0; k < 2000 && !told; ++k) {
      const double t = k * kDt;
      Wrench F;
      F[Axis::z] = mean * (1 + 0.05 * std::pow(1.2, 10 * t) * std::sin(2 * std::numbers::pi * 10 * t));
      told = observer.step(F, kAll).has_value();
      EXPECT_TRUE(!told || std::abs(F[Axis::z]) < std::abs(before));
      before = F[Axis::z];
    }
    EXPECT_TRUE(told);
  }
}

TEST(Oscillation, LargeSwingsThatDoNotDieAwayAreTold) {
  EXPECT_GE(steps_until_told({.mean = 10, .swing = 15}), 0);
  EXPECT_LT(steps_until_told({.mean = 10, .swing = 15, .frequency = 12}), 6 / (12 * kDt))
      << "four periods say it";
  EXPECT_EQ(steps_until_told({.mean = 10, .swing = 15, .factor = 0.9}), -1);
}

TEST(Oscillation, NothingIsToldOfHarmlessForces) {
  EXPECT_EQ(steps_until_told({.swing = 1.5}), -1) << "a small steady swing";
  EXPECT_EQ(steps_until_told({.swing = 0, .noise = 0.12}, Axis::z, 60), -1) << "noise";
  EXPECT_EQ(steps_until_told({.swing = 20, .frequency = 2}), -1) << "a person who leads the arm to and fro";
  EXPECT_EQ(steps_until_told({.swing = 20, .factor = 0.6}), -1) << "an impact that rings";
  EXPECT_EQ(steps_until_told({.swing = 1.5, .frequency = 8, .factor = 1.03}, Axis::z, 1), -1) << "a tremor";
  EXPECT_EQ(steps_until_told({.swing = 20, .frequency = 2, .factor = 1.1}), -1)
      << "a push that becomes stronger";
}

TEST(Oscillation, TouchOfATremblingHandIsNoGrowth) {
  OscillationObserver observer({}, kDt);
  for (int k = 0; k < 3000; ++k) {
    const double t = k * kDt, since = t - 3;
    Wrench F;
    F[Axis::z] = 0.4 * std::sin(2 * std::numbers::pi * 8 * t);
    if (since > 0) F[Axis::z] += 1 + 5 * std::exp(-12 * since) * std::sin(2 * std::numbers::pi * 7 * since);
    ASSERT_FALSE(observer.step(F, kAll)) << t;
  }
}

TEST(Oscillation, RandomStepsOfForceAreNotSwings) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> level(0, 4);
  std::uniform_int_distribution<int> length(5, 200);
  std::normal_distribution<double> noise(0, 0.1);
  OscillationObserver observer({}, kDt);
  for (int run = 0; run < 300; ++run) {
    const double force = level(random);
    for (int k = length(random); k > 0; --k) {
      Wrench F;
      F[Axis::x] = force + noise(random);
      ASSERT_FALSE(observer.step(F, kAll)) << "run " << run;
    }
  }
}

TEST(Oscillation, AxesThatAreNotWatchedAreForgotten) {
  EXPECT_EQ(steps_until_told({.swing = 15}, Axis::z, 3, AxisSet("011011")), -1);
  OscillationObserver observer({}, kDt);
  for (int k = 0; k < 3000; ++k) {
    Wrench F;
    F[Axis::z] = 20 * std::sin(2 * std::numbers::pi * 10 * k * kDt);
    // Every third period the law is another one.
    EXPECT_FALSE(observer.step(F, k % 150 == 0 ? AxisSet() : kAll)) << k;
  }
}

TEST(Oscillation, ForceActsOnGuardedAndContactAxesOnly) {
  EXPECT_EQ(force_axes({u(1), g(0.01, 5, 0.0025), c(1, 20, 0.005), u(), g(0.1, 1, 0), c(0, 0.5, 0.025)}),
            AxisSet("100110"));
}

TEST(Oscillation, BoundsThatMakeNoSenseAreNotUsable) {
  EXPECT_TRUE(is_usable({}));
  EXPECT_TRUE(is_usable({.force = std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(is_usable({.force = 0}));
  EXPECT_FALSE(is_usable({.torque = -1}));
  EXPECT_FALSE(is_usable({.growth = std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(is_usable({.periods = 1}));
  EXPECT_FALSE(is_usable({.periods = kMostPeriods + 1}));
  EXPECT_FALSE(is_usable({.lowest = 20, .highest = 10}));
}

}  // namespace
}  // namespace mrroc::edp
