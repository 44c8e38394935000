#include "ecp/generators/trapezoid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <kdl/velocityprofile_trap.hpp>
#include <optional>

#include "base/fault.hpp"
#include "test/ecp/generators/random_list.hpp"

namespace mrroc::ecp {
namespace {

constexpr double kStep = 0.02;

MotionLimits joint_limits() { return default_limits(Representation::joints, 6); }

struct Case {
  Coordinates from;
  std::vector<ViaPoint> list;
};

Case random_case(RandomList& random) {
  Case c{random.pose(6, 2), {}};
  const int n = random.whole(1, 6);
  for (int k = 0; k < n; ++k) {
    ViaPoint via{random.pose(6, 2), random.between(0.05, 1), random.between(0.02, 1),
                 random.whole(0, 1) == 1};
    if (random.whole(0, 3) == 0) via.pose[random.whole(0, 5)] = c.from[0];  // some axes hardly move
    c.list.push_back(via);
  }
  return c;
}

TEST(Trapezoid, ReachesEveryPoseExactlyAtAMacrostepAndEndsAtTheGoal) {
  RandomList random(1);
  for (int k = 0; k < 300; ++k) {
    const Case c = random_case(random);
    const Trapezoid curve(c.from, c.list, joint_limits(), kStep);
    EXPECT_EQ(curve.at(0), c.from);
    for (std::size_t via = 0; via < c.list.size(); ++via) {
      const double t = static_cast<double>(curve.arrivals()[via]) * kStep;
      EXPECT_EQ(curve.at(t), c.list[via].pose);
      EXPECT_NEAR((curve.at(t - 1e-9) - c.list[via].pose).norm(), 0, 1e-7) << "a jump before the pose";
    }
    EXPECT_EQ(curve.at(curve.duration() + 1), c.list.back().pose);
  }
}

TEST(Trapezoid, NeverExceedsTheLimitsBetweenMacrosteps) {
  RandomList random(2);
  int fast = 0, hard = 0;  // samples that use up what the section may
  for (int k = 0; k < 100; ++k) {
    const Case c = random_case(random);
    const Trapezoid curve(c.from, c.list, joint_limits(), kStep);
    std::size_t via = 0;
    const double h = kStep / 8;
    const auto steps = static_cast<int>(std::lround(curve.duration() / h));
    for (int s = 1; s < steps; ++s) {
      const double t = s * h;
      const auto arrival = [&] { return static_cast<double>(curve.arrivals()[via]) * kStep; };
      while (t > arrival() + 1e-12) ++via;
      // The fractions of the section; where the three samples lie on both sides of its end those of both count.
      double v = c.list[via].velocity, a = c.list[via].acceleration;
      if (t + h > arrival() - 1e-12 && via + 1 < c.list.size()) {
        v = std::max(v, c.list[via + 1].velocity);
        a = std::max(a, c.list[via + 1].acceleration);
      }
      if (via > 0 && t - h < static_cast<double>(curve.arrivals()[via - 1]) * kStep + 1e-12) {
        v = std::max(v, c.list[via - 1].velocity);
        a = std::max(a, c.list[via - 1].acceleration);
      }
      const Coordinates speed = (curve.at(t + h) - curve.at(t)) / h;
      const Coordinates change = (curve.at(t + h) - 2 * curve.at(t) + curve.at(t - h)) / (h * h);
      EXPECT_LE(share_of(speed, joint_limits().velocity), v * (1 + 1e-9));
      EXPECT_LE(share_of(change, joint_limits().acceleration), a * (1 + 1e-6));
      fast += share_of(speed, joint_limits().velocity) > 0.95 * v ? 1 : 0;
      hard += share_of(change, joint_limits().acceleration) > 0.99 * a ? 1 : 0;
    }
  }
  EXPECT_GT(fast, 1000);
  EXPECT_GT(hard, 1000);
}

/// @return the farthest way in the time T between two speeds; nothing when it is too short to change from one to the other
std::optional<double> farthest(double v0, double v1, double v, double a, double T) {
  if (T < std::abs(v1 - v0) / a) return {};
  const double peak = std::min(v, (v0 + v1 + a * T) / 2);
  const double up = (peak - v0) / a, down = (peak - v1) / a;
  return (v0 + peak) / 2 * up + peak * (T - up - down) + (peak + v1) / 2 * down;
}

TEST(Trapezoid, NoSectionCouldBeAMacrostepShorterBetweenTheSpeedsAtItsEnds) {
  constexpr double kFine = 0.001;  // short: a speed that is a little too low costs little time
  RandomList random(6);
  int passed = 0;
  for (int k = 0; k < 1000; ++k) {
    const Case c = random_case(random);
    const Trapezoid curve(c.from, c.list, joint_limits(), kFine);
    const auto time = [&](std::size_t via) { return static_cast<double>(curve.arrivals()[via]) * kFine; };
    const auto speed = [&](double t) -> Coordinates {
      constexpr double h = 1e-8;
      return (curve.at(t + h) - curve.at(t - h)) / (2 * h);
    };
    for (std::size_t via = 0; via < c.list.size(); ++via) {
      const double begin = via == 0 ? 0 : time(via - 1), T = time(via) - begin;
      if (T <= kFine) continue;
      const Coordinates from = via == 0 ? c.from : c.list[via - 1].pose;
      const bool last = via + 1 == c.list.size();
      const Coordinates v0 = via == 0 ? Coordinates(Coordinates::Zero(6)) : speed(begin);
      const Coordinates v1 = last ? Coordinates(Coordinates::Zero(6)) : speed(time(via));
      passed += v0.norm() > 0.1 && v1.norm() > 0.1 ? 1 : 0;
      bool slowest = false;  // there is an axis that needs all of the time
      for (int axis = 0; axis < 6; ++axis) {
        const double d = c.list[via].pose[axis] - from[axis], sense = d < 0 ? -1 : 1;
        const double v = c.list[via].velocity * joint_limits().velocity[axis];
        const double a = c.list[via].acceleration * joint_limits().acceleration[axis];
        const auto way = farthest(sense * v0[axis], sense * v1[axis], v, a, T - kFine);
        slowest = slowest || !way || *way < sense * d + 1e-6;
      }
      EXPECT_TRUE(slowest) << "case " << k << ", section " << via;
    }
  }
  EXPECT_GT(passed, 50);
}

TEST(Trapezoid, AMotionOfOneAxisTakesTheTimeThatKdlSays) {
  RandomList random(3);
  for (int k = 0; k < 200; ++k) {
    const double goal = random.between(-3, 3), v = random.between(0.1, 1), a = random.between(0.1, 1);
    const MotionLimits limits{Coordinates::Constant(1, 1), Coordinates::Constant(1, 1)};
    const Trapezoid curve(Coordinates::Zero(1), {{Coordinates::Constant(1, goal), v, a}}, limits, kStep);
    KDL::VelocityProfile_Trap reference(v, a);
    reference.SetProfile(0, goal);
    EXPECT_GE(curve.duration(), reference.Duration() - 1e-9);
    EXPECT_LT(curve.duration(), reference.Duration() + kStep);
    // A macrostep that is a fraction of the time leaves nothing to round: both are the same motion.
    const double fits = reference.Duration() / 64;
    const Trapezoid same(Coordinates::Zero(1), {{Coordinates::Constant(1, goal), v, a}}, limits, fits);
    for (int s = 0; s <= 128; ++s) EXPECT_NEAR(same.at(s * fits / 2)[0], reference.Pos(s * fits / 2), 1e-6);
  }
}

TEST(Trapezoid, AtASlowerFractionItTakesLongerByThat) {
  const MotionLimits limits{Coordinates::Constant(1, 2), Coordinates::Constant(1, 4)};
  const auto time = [&](double v, double a) {
    return Trapezoid(Coordinates::Zero(1), {{Coordinates::Constant(1, 10), v, a}}, limits, 1e-4).duration();
  };
  EXPECT_NEAR(time(1, 1), 10 / 2. + 2 / 4., 1e-4);
  EXPECT_NEAR(time(0.5, 1), 10 / 1. + 1 / 4., 1e-4);
  EXPECT_NEAR(time(1, 0.5), 10 / 2. + 2 / 2., 1e-4);
}

TEST(Trapezoid, BeforeItsBeginningItIsThere) {
  const Coordinates from = Coordinates::Constant(2, 0.5), to = Coordinates::Constant(2, 1.5);
  const Trapezoid curve(from, {{to, 1, 1}}, {Coordinates::Ones(2), Coordinates::Ones(2)}, kStep);
  EXPECT_EQ(curve.at(-1), from);
  EXPECT_EQ(curve.at(0), from);
  EXPECT_EQ(curve.at(curve.duration()), to);
  const double half = curve.duration() / 2;
  EXPECT_NEAR(curve.at(half)[0], 1, 1e-9) << "the way out is as the way in";
  for (double t = 0; t < half; t += 0.01) EXPECT_NEAR(curve.at(half + t)[1] + curve.at(half - t)[1], 2, 1e-6);
}

TEST(Trapezoid, AxesAreSynchronised) {
  RandomList random(4);
  const Coordinates from = random.pose(6, 2), to = random.pose(6, 2);
  const Trapezoid curve(from, {{to, 0.5, 0.1}}, joint_limits(), kStep);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_NE(curve.at(curve.duration() - kStep)[axis], to[axis]) << "this one is there too early";
    EXPECT_NE(curve.at(kStep)[axis], from[axis]);
  }
}

TEST(Trapezoid, APassedPoseDoesNotStopAxesThatGoOn) {
  Coordinates from = Coordinates::Zero(2), middle(2), to(2);
  middle << 0.5, 0.3;
  to << 1.0, 0.0;
  const MotionLimits limits{Coordinates::Constant(2, 1), Coordinates::Constant(2, 2)};
  const auto speed_at_middle = [&](bool pass) -> Coordinates {
    const Trapezoid curve(from, {{middle, 1, 1, pass}, {to, 1, 1}}, limits, kStep);
    const double t = static_cast<double>(curve.arrivals()[0]) * kStep;
    return (curve.at(t + 1e-6) - curve.at(t - 1e-6)) / 2e-6;
  };
  EXPECT_NEAR(speed_at_middle(false).norm(), 0, 1e-4);
  EXPECT_NEAR(speed_at_middle(true)[0], 0.5, 1e-4) << "as fast as on the mean from rest to rest";
  EXPECT_NEAR(speed_at_middle(true)[1], 0, 1e-4) << "this axis turns round";
}

TEST(Trapezoid, PassingIsNeverSlowerThanStoppingAndFasterOnAWayWithoutTurns) {
  RandomList random(5);
  const auto time = [](Case c, bool pass) {
    for (ViaPoint& via : c.list) via.pass = pass;
    return Trapezoid(c.from, c.list, joint_limits(), kStep).duration();
  };
  double passing = 0, stopping = 0;
  for (int k = 0; k < 100; ++k) {
    const Case any = random_case(random);
    const double rounding = kStep * static_cast<double>(any.list.size());
    EXPECT_LE(time(any, true), time(any, false) + rounding);
    Case onward{Coordinates::Zero(6), {}};
    for (int n = 0; n < 5; ++n) {
      const Coordinates before = n == 0 ? onward.from : onward.list.back().pose;
      onward.list.push_back({before + Coordinates::Constant(6, 0.3) + random.pose(6, 0.1), 0.5, 0.1});
    }
    passing += time(onward, true);
    stopping += time(onward, false);
  }
  EXPECT_LT(passing, 0.9 * stopping);
}

TEST(Trapezoid, NoMotionTakesNoTime) {
  const Coordinates here = Coordinates::Constant(6, 0.3);
  const Trapezoid curve(here, {{here}}, joint_limits(), kStep);
  EXPECT_EQ(curve.duration(), 0);
  EXPECT_EQ(curve.at(0), here);
}

TEST(Trapezoid, RefusesListsThatCannotBeMeant) {
  const Coordinates here = Coordinates::Zero(6);
  const auto make = [&](std::vector<ViaPoint> list) {
    return Trapezoid(here, std::move(list), joint_limits(), kStep);
  };
  EXPECT_THROW(make({}), FaultError);
  EXPECT_THROW(make({{Coordinates::Zero(5)}}), FaultError);
  EXPECT_THROW(make({{here, 0}}), FaultError);
  EXPECT_THROW(make({{here, 1.1}}), FaultError);
  EXPECT_THROW(make({{here, 0.5, NAN}}), FaultError);
  EXPECT_THROW(make({{Coordinates::Constant(6, NAN)}}), FaultError);
  EXPECT_THROW(make({{here, 0.5, 0}}), FaultError);
  EXPECT_THROW(make({{here, 0.5, 1.1}}), FaultError);
  EXPECT_THROW(make({{here}, {Coordinates::Zero(7)}}), FaultError) << "also behind the first one";
  EXPECT_NO_THROW(make({{here, 1, 1}}));
}

TEST(Trapezoid, RefusesABeginningLimitsAndATimeThatCannotBeMeant) {
  const Coordinates here = Coordinates::Zero(6), one = Coordinates::Ones(6);
  const auto refused = [&](const Coordinates& from, const MotionLimits& limits, double step = kStep) {
    try {
      check_list(from, {{here}}, limits, step);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_trajectory);
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused(here, {one, one}));
  Coordinates broken = here, none = one, below = one;
  broken[3] = INFINITY;
  none[5] = 0;
  below[0] = -1;
  EXPECT_TRUE(refused(broken, {one, one}));
  for (const Coordinates& bad : {Coordinates(Coordinates::Ones(5)), broken, none, below}) {
    EXPECT_TRUE(refused(here, {bad, one})) << bad.transpose();
    EXPECT_TRUE(refused(here, {one, bad})) << bad.transpose();
  }
  for (const double step : {0.0, -kStep, std::nan("")}) EXPECT_TRUE(refused(here, {one, one}, step)) << step;
}

}  // namespace
}  // namespace mrroc::ecp
