// Gravity compensation and bias, MG (44) (45).
#include "edp/force_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/base/random_pose.hpp"

namespace mrroc::edp {
namespace {

using mrroc::test::random_rotation;
using mrroc::test::random_vector;
using mrroc::test::uniform;

/// A sensor and the load on it, computed from the forces' lines of action and not by xi_F.
struct Wrist {
  ForceSensorParameters p;
  Wrench offset;

  explicit Wrist(std::mt19937_64& random) {
    p.T_WS = mrroc::test::random_pose(random, 0.1);
    p.weight = uniform(random, 1, 15);
    p.mass_centre = random_vector(random, 0.15);
    p.range = Wrench{{1e3, 1e3, 1e3, 1e3, 1e3, 1e3}};
    offset = mrroc::test::random_spatial<Wrench>(random, 2);
  }
  /// @param f force of the surroundings on the tool, in the base  @param at where it acts, in W
  [[nodiscard]] Wrench raw(const Matrix3& R_0W, const Vector3& f = Vector3::Zero(),
                           const Vector3& at = Vector3::Zero(), const Vector3& n = Vector3::Zero()) const {
    const Vector3 gravity = R_0W.transpose() * Vector3(0, 0, -p.weight);
    const Vector3 contact = R_0W.transpose() * f;
    const Vector3 o = p.T_WS.p;
    const Vector3 force = gravity + contact;
    const Vector3 moment =
        (p.mass_centre - o).cross(gravity) + (at - o).cross(contact) + R_0W.transpose() * n;
    return Wrench::from(p.T_WS.R.transpose() * force, p.T_WS.R.transpose() * moment) + offset;
  }
};

double largest(const Wrench& F) { return F.vector().cwiseAbs().maxCoeff(); }

TEST(ForceSensor, WithoutContactTheAdjustedForceIsZeroInEveryOrientation) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 200; ++run) {
    const Wrist wrist(random);
    ForceSensor sensor(wrist.p);
    const Matrix3 R_bias = random_rotation(random);
    sensor.take(wrist.raw(R_bias), true);
    sensor.bias(R_bias);
    for (int k = 0; k < 50; ++k) {
      const Matrix3 R_0W = random_rotation(random);
      sensor.take(wrist.raw(R_0W), false);
      ASSERT_LT(largest(sensor.adjusted(R_0W)), 1e-9);
    }
  }
}

TEST(ForceSensor, AdjustedForceIsWhatTheToolExerts) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 2000; ++run) {
    const Wrist wrist(random);
    ForceSensor sensor(wrist.p);
    const Matrix3 R_bias = random_rotation(random);
    sensor.take(wrist.raw(R_bias), true);
    sensor.bias(R_bias);
    const Matrix3 R_0W = random_rotation(random);
    const Vector3 f = random_vector(random, 10);
    const Vector3 n = random_vector(random, 1);
    const Vector3 at = random_vector(random, 0.2);
    sensor.take(wrist.raw(R_0W, f, at, n), false);
    const Vector3 f_W = R_0W.transpose() * f;
    const Wrench exerted = -Wrench::from(f_W, at.cross(f_W) + R_0W.transpose() * n);
    ASSERT_LT(largest(sensor.adjusted(R_0W) - exerted), 1e-9);
  }
}

TEST(ForceSensor, NewToolIsCompensatedFromItsBiasOn) {
  std::mt19937_64 random(3);
  Wrist wrist(random);
  const double w = wrist.p.weight;
  const Vector3 P = wrist.p.mass_centre;
  wrist.p.weight = 0;
  wrist.p.mass_centre.setZero();
  ForceSensor sensor(wrist.p);
  wrist.p.weight = w;
  wrist.p.mass_centre = P;
  const Matrix3 R_bias = random_rotation(random);
  sensor.take(wrist.raw(R_bias), true);
  sensor.set_tool(3, {0.1, -0.2, 0.05});
  sensor.set_tool(w, P);  // instead of that one
  sensor.bias(R_bias);
  for (int k = 0; k < 100; ++k) {
    const Matrix3 R_0W = random_rotation(random);
    sensor.take(wrist.raw(R_0W), false);
    ASSERT_LT(largest(sensor.adjusted(R_0W)), 1e-9);
  }
}

TEST(ForceSensor, ABiasTakesThePlaceOfTheOneBefore) {
  std::mt19937_64 random(5);
  Wrist wrist(random);
  ForceSensor sensor(wrist.p);
  for (int drift = 0; drift < 3; ++drift) {
    wrist.offset = mrroc::test::random_spatial<Wrench>(random, 2);
    const Matrix3 R_bias = random_rotation(random);
    sensor.take(wrist.raw(R_bias), false);
    sensor.take(wrist.raw(R_bias), true);
    sensor.bias(R_bias);
    for (int k = 0; k < 20; ++k) {
      const Matrix3 R_0W = random_rotation(random);
      sensor.take(wrist.raw(R_0W), false);
      ASSERT_LT(largest(sensor.adjusted(R_0W)), 1e-9) << drift;
    }
  }
}

TEST(ForceSensor, WithoutToolTheIdentificationSeesThePapersSigns) {
  // MG (40)-(42): w = 0 and P = 0 before a bias with z_W down; then z_W up, then x_W up with y, z horizontal.
  std::mt19937_64 random(4);
  Wrist wrist(random);
  const double w = wrist.p.weight;
  const Vector3 P = wrist.p.mass_centre;
  Wrist truth = wrist;
  ForceSensorParameters p = wrist.p;
  p.weight = 0;
  p.mass_centre.setZero();
  ForceSensor sensor(p);
  Matrix3 down, up, x_up;
  down << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  up = Matrix3::Identity();
  x_up << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  sensor.take(truth.raw(down), true);
  sensor.bias(down);
  sensor.take(truth.raw(up), false);
  const Wrench b = sensor.adjusted(up);
  sensor.take(truth.raw(x_up), false);
  const Wrench c = sensor.adjusted(x_up);
  const double weight = b[Axis::z] / 2;
  EXPECT_NEAR(weight, w, 1e-9);
  EXPECT_NEAR(-b[Axis::ay] / (2 * weight), P.x(), 1e-9);
  EXPECT_NEAR(b[Axis::ax] / (2 * weight), P.y(), 1e-9);
  EXPECT_NEAR(c[Axis::ay] / weight - b[Axis::ay] / (2 * weight), P.z(), 1e-9);
}

TEST(ForceSensor, BiasIsTheMeanOfTheReadingsAtRest) {
  ForceSensorParameters p;
  ForceSensor sensor(p);
  for (int k = 0; k < 1000; ++k) sensor.take({{40, 0, 0, 0, 0, 0}}, false);  // moving: does not count
  for (int k = 0; k < 20; ++k) sensor.take({{k % 2 ? 1. : 3., 0, 0, 0, 0, 0}}, true);
  sensor.bias(Matrix3::Identity());
  sensor.take({{2, 0, 0, 0, 0, 0}}, false);
  EXPECT_NEAR(sensor.adjusted(Matrix3::Identity())[Axis::x], 0, 1e-12);
}

TEST(ForceSensor, AveragesAsManyReadingsAsItIsTold) {
  for (int length = 1; length <= 4; ++length) {
    ForceSensorParameters p;
    p.average = length;
    ForceSensor sensor(p);
    for (int k = 0; k < 10; ++k) sensor.take({}, false);
    for (int k = 1; k <= length; ++k) {
      sensor.take({{0, 0, -8, 0, 0, 0}}, false);
      EXPECT_NEAR(sensor.adjusted(Matrix3::Identity())[Axis::z], 8. * k / length, 1e-12);
    }
  }
}

TEST(ForceSensor, BadReadingsAreLeftOutUntilTheyAreAFault) {
  using Health = ForceSensor::Health;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Axis a : kAxes)
    for (const double bad : {nan, inf, -inf, 1e6, -65.0 * 4}) {
      ForceSensorParameters p;
      p.fault_after = 3;
      ForceSensor sensor(p);
      EXPECT_EQ(sensor.take({{1, 1, 1, 1, 1, 1}}, false), Health::good);
      Wrench reading;
      reading[a] = bad;
      for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(sensor.take(reading, false), Health::skipped);
        EXPECT_EQ(sensor.take(reading, false), Health::skipped);
        EXPECT_EQ(sensor.adjusted(Matrix3::Identity())[a], -1) << "the last good reading stands";
        if (round == 0) {
          EXPECT_EQ(sensor.take({{1, 1, 1, 1, 1, 1}}, false), Health::good);
        }
      }
      EXPECT_EQ(sensor.take(reading, false), std::isfinite(bad) ? Health::saturated : Health::not_finite);
      EXPECT_EQ(sensor.diagnostic().component, static_cast<int>(a));
      EXPECT_TRUE(finite(sensor.adjusted(Matrix3::Identity())));
    }
}

TEST(ForceSensor, NoComponentBeingANumberIsASilentSensor) {
  using Health = ForceSensor::Health;
  ForceSensor sensor({});
  sensor.take({{1, 1, 1, 1, 1, 1}}, false);
  Wrench nothing;
  nothing.v.fill(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(sensor.take(nothing, false), Health::skipped);
  EXPECT_EQ(sensor.take(nothing, false), Health::skipped);
  EXPECT_EQ(sensor.take(nothing, false), Health::silent);
  EXPECT_EQ(sensor.diagnostic().component, -1);
  EXPECT_EQ(sensor.adjusted(Matrix3::Identity())[Axis::z], -1) << "the last good reading stands";
}

TEST(ForceSensor, AComponentThatNeverChangesIsStuck) {
  using Health = ForceSensor::Health;
  for (const Axis dead : kAxes) {
    std::mt19937_64 random(5);
    ForceSensorParameters p;
    p.stuck_after = 25;
    ForceSensor sensor(p);
    const auto reading = [&](bool stuck) {
      Wrench r = mrroc::test::random_spatial<Wrench>(random, 1);
      if (stuck) r[dead] = 0.5;
      return r;
    };
    for (int k = 0; k < 1000; ++k) ASSERT_EQ(sensor.take(reading(k % 25 != 0), false), Health::good);
    for (int k = 0; k < 25; ++k) sensor.take(reading(true), false);
    EXPECT_EQ(sensor.take(reading(true), false), Health::stuck);
    EXPECT_EQ(sensor.diagnostic().component, static_cast<int>(dead));
    EXPECT_EQ(sensor.take(reading(true), false), Health::stuck) << "and stays so";
    EXPECT_EQ(sensor.take(reading(false), false), Health::good) << "until it changes again";
  }
}

TEST(ForceSensor, EqualReadingsAreFineWhenNoNoiseIsExpected) {
  ForceSensor sensor({});
  for (int k = 0; k < 10'000; ++k) ASSERT_EQ(sensor.take({}, true), ForceSensor::Health::good);
}

TEST(ForceSensor, LowPassAnswersAStepWithItsTimeConstant) {
  for (const double corner : {10., 40., 100.}) {
    ForceSensorParameters p;
    p.low_pass = corner;
    const double dt = 0.002;
    ForceSensor sensor(p, dt);
    sensor.take({}, false);
    for (int k = 1; k <= 20; ++k) {
      sensor.take({{0, 0, -8, 0, 0, 0}}, false);
      const double expected = 8 * (1 - std::exp(-2 * M_PI * corner * dt * k));
      EXPECT_NEAR(sensor.adjusted(Matrix3::Identity())[Axis::z], expected, 1e-9);
    }
  }
}

TEST(ForceSensor, EveryMalfunctionHasANameOfItsOwn) {
  using Health = ForceSensor::Health;
  std::vector<FaultCode> codes;
  for (const Health h : {Health::silent, Health::not_finite, Health::saturated, Health::stuck}) {
    const std::optional<Fault> fault = sensor_fault(h, {2, 1.5, 3});
    ASSERT_TRUE(fault);
    EXPECT_EQ(class_of(fault->code), FaultClass::fatal);
    EXPECT_EQ(fault->axis, h == Health::silent ? -1 : 2);
    codes.push_back(fault->code);
  }
  std::ranges::sort(codes);
  EXPECT_EQ(std::ranges::adjacent_find(codes), codes.end());
  EXPECT_FALSE(sensor_fault(Health::good, {}));
  EXPECT_FALSE(sensor_fault(Health::skipped, {}));
}

}  // namespace
}  // namespace mrroc::edp
