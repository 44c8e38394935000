// The regulator that knows its drive, on a drive that is integrated finely: what it follows without an error, what it
// learns of its load, and how it takes over.
#include "edp/compensating_regulator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "edp/regulator.hpp"
#include "robots/motor.hpp"

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
constexpr double kIncrements = 400;  // of a radian
constexpr CompensationCoefficients kCoefficients{.bandwidth = 60, .observer = 200};

/// Time constant: 36 ms.
DriveModel model() {
  DriveModel m;
  m.resistance = 2;
  m.inertia = 2e-4;
  return m;
}

/// A drive with a load, and the regulator's view of it.
class Drive {
 public:
  explicit Drive(const DriveModel& m, double held = 0) : load(held), m_(m) {}

  /// The shaft under a duty cycle for one step.
  void turn(double pwm) {
    constexpr int kFine = 400;
    for (int k = 0; k < kFine; ++k) {
      const double current = (pwm / kPwmScale * m_.supply - m_.torque_constant * speed) / m_.resistance;
      const double before = speed;
      speed += kDt / kFine * (m_.torque_constant * current - load) / m_.inertia;
      position += kDt / kFine * (before + speed) / 2;
    }
  }
  /// One step of regulator and drive. @param r  set increment @return the duty cycle
  double step(CompensatingRegulator& regulator, double r, double gravity_feed_forward = 0) {
    const double pwm = regulator.step(r, error(), gravity_feed_forward);
    turn(pwm);
    set += r;
    return pwm;
  }
  [[nodiscard]] double error() const { return set - kIncrements * position; }

  double load;        // that the drive has to hold [N m]
  double position{};  // [rad]
  double speed{};     // [rad/s]
  double set{};       // [increments]

 private:
  DriveModel m_;
};

CompensatingRegulator regulator(const DriveModel& m = model(),
                                const CompensationCoefficients& c = kCoefficients) {
  return {c, m, kIncrements, kDt};
}

TEST(CompensatingRegulator, FollowsAKnownDriveHalfAStepBehindFromTheFirstStepOn) {
  for (const double r : {0.3, -4.0}) {
    Drive drive(model());
    CompensatingRegulator own = regulator();
    for (int k = 0; k < 300; ++k) {
      drive.step(own, r);
      ASSERT_NEAR(drive.error(), r / 2, 0.02 * std::abs(r)) << k;
      ASSERT_NEAR(kIncrements * drive.speed * kDt, r, 0.02 * std::abs(r)) << k;
    }
  }
}

TEST(CompensatingRegulator, AKnownLoadMovesNothing) {
  for (const double load : {0.02, -0.05}) {
    Drive drive(model(), load);
    CompensatingRegulator own = regulator();
    for (int k = 0; k < 200; ++k) {
      EXPECT_NEAR(drive.step(own, 0, load), load * model().pwm_per_torque(), 1e-6);
      ASSERT_NEAR(drive.error(), 0, 1e-6);
    }
  }
}

TEST(CompensatingRegulator, AnUnknownLoadIsLearnt) {
  for (const double load : {0.02, -0.05}) {
    Drive drive(model(), load);
    CompensatingRegulator own = regulator();
    double most = 0, pwm = 0;
    for (int k = 0; k < 500; ++k) {
      pwm = drive.step(own, 0);
      most = std::max(most, std::abs(drive.error()));
    }
    EXPECT_GT(most, 0.5) << "it was not known";
    EXPECT_NEAR(drive.error(), 0, 1e-4);
    EXPECT_NEAR(pwm, load * model().pwm_per_torque(), 1e-3);
    for (int k = 0; k < 500; ++k) drive.step(own, 0.5);
    EXPECT_NEAR(drive.error(), 0.25, 0.01) << "and moves on with it";
  }
}

// A shaft that stands beside its set position, the model exact: both poles of the loop are where they are wanted.
TEST(CompensatingRegulator, AnErrorFadesWithTheDoublePoleOfItsBandwidth) {
  Drive drive(model());
  drive.set = 2;
  CompensatingRegulator own = regulator();
  std::vector<double> e{drive.error()};
  for (int k = 0; k < 60; ++k) {
    drive.step(own, 0);
    e.push_back(drive.error());
  }
  const double z = std::exp(-kCoefficients.bandwidth * kDt);
  for (std::size_t k = 0; k + 2 < e.size(); ++k)
    EXPECT_NEAR(e[k + 2] - 2 * z * e[k + 1] + z * z * e[k], 0, 2e-4) << k;
  EXPECT_LT(e[1], e[0]);
}

TEST(CompensatingRegulator, PolesOfLoopAndObserverAreThoseOfItsCoefficients) {
  const CompensationGains g = regulator().gains();
  const double steps = model().time_constant() / kDt;
  EXPECT_NEAR(g.alpha, std::exp(-1 / steps), 1e-12);
  EXPECT_NEAR(g.beta, (1 - g.alpha) * steps, 1e-12);
  EXPECT_NEAR(g.gain, model().speed_per_pwm() * kIncrements * kDt, 1e-12);
  Eigen::Matrix3d A;
  A << 1, g.beta, (1 - g.beta) * g.gain, 0, g.alpha, (1 - g.alpha) * g.gain, 0, 0, 1;
  const Eigen::Matrix2d loop =
      A.topLeftCorner<2, 2>() - A.topRightCorner<2, 1>() * Eigen::RowVector2d(g.k_p, g.k_v);
  const double z = std::exp(-kCoefficients.bandwidth * kDt);
  EXPECT_NEAR(loop.trace(), 2 * z, 1e-9);
  EXPECT_NEAR(loop.determinant(), z * z, 1e-9);
  const Eigen::Matrix3d off =
      A * (Eigen::Matrix3d::Identity() - Eigen::Vector3d(g.l_p, g.l_v, g.l_d) * Eigen::RowVector3d(1, 0, 0));
  const double y = std::exp(-kCoefficients.observer * kDt);
  EXPECT_NEAR(off.trace(), 3 * y, 1e-9);
  EXPECT_NEAR(off.determinant(), y * y * y, 1e-9);
  EXPECT_NEAR((off * off).trace(), 3 * y * y, 1e-9);
}

TEST(CompensatingRegulator, AsksForFourFifthsOfTheLargestCurrentAtMostAndForNoMoreThanTheDriveLimits) {
  DriveModel least = model(), limited = model();
  least.max_current = 5;
  limited.current_limit = 4;
  for (const DriveModel& m : {least, limited})
    for (const double side : {1.0, -1.0}) {
      EXPECT_NEAR(regulator(m).step(0, 1000 * side, 0), side * 4 * m.resistance * kPwmScale / m.supply, 1e-9);
      EXPECT_EQ(regulator().step(0, 3000 * side, 0), side * kMaxPwm) << "without a limit of the current";
      Drive drive(m);
      drive.set = 3000 * side;
      CompensatingRegulator own = regulator(m);
      EXPECT_FALSE(own.at_limit());
      for (int k = 0; k < 200; ++k) {
        const double idle = drive.speed * m.torque_constant * kPwmScale / m.supply;
        const double pwm = drive.step(own, 0);
        ASSERT_LE(std::abs(pwm - idle) * m.supply / kPwmScale / m.resistance, 4 * 1.02) << k;
        if (k == 0) {
          EXPECT_TRUE(own.at_limit());
        }
      }
      own.restart();
      EXPECT_FALSE(own.at_limit()) << "braked";
    }
}

// Friction is told by where the set position goes, so that regulators with and without it differ by it alone.
TEST(CompensatingRegulator, FrictionIsCompensatedFromTheSetMotion) {
  DriveModel rubs = model();
  rubs.friction = 0.01;
  rubs.presliding = 0.02;
  CompensatingRegulator with = regulator(rubs), without = regulator();
  const double all = rubs.friction * rubs.pwm_per_torque(), within = rubs.presliding * kIncrements;
  const auto difference = [&](double r) { return with.step(r, r / 2, 0) - without.step(r, r / 2, 0); };
  EXPECT_NEAR(difference(2), all * (2 / within) / (1 + 2 / within), 1e-9) << "it builds up";
  double now = 0;
  for (int k = 0; k < 100; ++k) now = difference(2);
  EXPECT_NEAR(now, all, 1e-3);
  EXPECT_NEAR(difference(0), all, 1e-3) << "and stays while it stands";
  for (int k = 0; k < 100; ++k) now = difference(-2);
  EXPECT_NEAR(now, -all, 1e-3);
}

TEST(CompensatingRegulator, GoesOnWithTheDutyCycleThatItFindsAndTheLoadThatThisHeld) {
  const double load = 0.04, held = load * model().pwm_per_torque();
  Drive drive(model(), load);
  CompensatingRegulator own = regulator();
  own.resume(0, 0, held);
  for (int k = 0; k < 300; ++k) {
    ASSERT_NEAR(drive.step(own, 0), held, 1e-6);
    ASSERT_NEAR(drive.error(), 0, 1e-6);
  }
  for (const double r : {-1.0, 0.5})
    for (const double e : {-0.3, 0.7})
      for (const double pwm : {-20.0, 35.0}) {
        CompensatingRegulator joined = regulator();
        joined.resume(r, e, pwm);
        EXPECT_NEAR(joined.step(r, e, 0.01), pwm, 1e-9) << "whatever it would have asked for";
      }
}

// In motion: the speed of the shaft is that of the set position, and nothing has to be made up for.
TEST(CompensatingRegulator, GoesOnInMotionWithoutAJolt) {
  Drive drive(model());
  CompensatingRegulator first = regulator();
  for (int k = 0; k < 200; ++k) drive.step(first, 2);
  const double behind = drive.error() + 2;  // after the step, of what was measured in it
  const double pwm = drive.step(first, 2);
  CompensatingRegulator next = regulator();
  next.resume(2, behind, pwm);
  for (int k = 0; k < 200; ++k) {
    ASSERT_NEAR(drive.step(next, 2), pwm, 0.3) << k;
    ASSERT_NEAR(drive.error(), 1, 0.1) << k;
  }
}

TEST(CompensatingRegulator, TakesOverFromOneWithOtherCoefficientsWithAllThatItKnows) {
  const double load = 0.04;
  Drive drive(model(), load);
  CompensatingRegulator slow = regulator(model(), {.bandwidth = 30, .observer = 100});
  double pwm = 0;
  for (int k = 0; k < 1000; ++k) pwm = drive.step(slow, 0.5);
  CompensatingRegulator fast = regulator();
  fast.resume(slow, pwm + 8);
  EXPECT_NEAR(fast.step(0.5, drive.error(), 0), pwm + 8, 1e-9);
  double difference = 8;
  CompensatingRegulator again = regulator();
  again.resume(slow, pwm + 8);
  for (int k = 0; k < 20; ++k) {
    // The same error again and again: what is left of the difference is nine tenths after each step.
    const double now = again.step(0.5, drive.error(), 0) - pwm;
    if (k > 0) {
      EXPECT_LT(std::abs(now), difference) << k;
    }
    difference = std::abs(now) + 0.8;
  }
  for (int k = 0; k < 500; ++k) drive.step(fast, 0.5);
  EXPECT_NEAR(drive.error(), 0.25, 0.01);
}

// A tenth of the difference is left out in each step: no jolt after the exchange either.
TEST(CompensatingRegulator, TheDifferenceFromTheOneBeforeFadesStepByStepAndIsGoneAfterSixty) {
  Drive quiet(model(), 0.04);
  CompensatingRegulator slow = regulator(model(), {.bandwidth = 30, .observer = 100});
  double pwm = 0;
  for (int k = 0; k < 1000; ++k) pwm = quiet.step(slow, 0.5);
  Drive pushed = quiet;
  CompensatingRegulator same = regulator(), other = regulator();
  same.resume(slow, pwm);
  other.resume(slow, pwm + 8);
  std::vector<double> difference;
  for (int k = 0; k < 60; ++k) difference.push_back(pushed.step(other, 0.5) - quiet.step(same, 0.5));
  EXPECT_NEAR(difference[0], 8, 1e-9);
  for (int k = 1; k < 4; ++k) {
    EXPECT_LT(difference[k], difference[k - 1]) << k;
    EXPECT_GT(difference[k], 0.6 * difference[k - 1]) << k;
  }
  EXPECT_NEAR(difference[59], 0, 0.1);
}

TEST(CompensatingRegulator, AfterTheBrakesItKnowsItsLoadAndTakesTheShaftWhereItIs) {
  const double load = 0.04, held = load * model().pwm_per_torque();
  Drive drive(model(), load);
  CompensatingRegulator own = regulator();
  for (int k = 0; k < 500; ++k) drive.step(own, 0);
  own.restart();
  drive.position += 1 / kIncrements;  // the brakes let it slip
  drive.speed = 0;
  const double first = own.step(0, drive.error(), 0);
  EXPECT_NEAR(first, held - own.gains().k_p, 1e-3) << "no more than the error of one increment";
}

TEST(CompensatingRegulator, TakesOverFromAnotherKindAlikeWhateverItHasDoneBefore) {
  DriveModel rough = model();
  rough.friction = 0.03;
  Drive drive(rough, 0.04);
  CompensatingRegulator used = regulator(rough), fresh = regulator(rough);
  for (int k = 0; k < 200; ++k) drive.step(used, 1.5 - 0.02 * k);
  for (CompensatingRegulator* const own : {&used, &fresh}) own->resume(1, 2, 30);
  for (int k = 0; k < 100; ++k)
    ASSERT_EQ(used.step(0.1 * k - 3, 0.3, 0.01), fresh.step(0.1 * k - 3, 0.3, 0.01)) << k;
}

TEST(CompensatingRegulator, TakesOverAtRestWithoutAPreferenceForADirection) {
  DriveModel rough = model();
  rough.friction = 0.03;
  CompensatingRegulator forth = regulator(rough), back = regulator(rough);
  forth.resume(0, 0, 0);
  back.resume(0, 0, 0);
  for (int k = 0; k < 50; ++k)
    ASSERT_NEAR(forth.step(0.1 * k, 0.5, 0), -back.step(-0.1 * k, -0.5, 0), 1e-9) << k;
}

TEST(CompensatingRegulator, TheDifferenceFromTheOneBeforeFadesSlowly) {
  CompensatingRegulator own = regulator();
  own.resume(regulator(), 60);
  double before = own.step(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    const double now = own.step(0, 0, 0);
    EXPECT_GT(now, 0.6 * before) << "no jolt";
    before = now;
  }
}

TEST(CompensatingRegulator, BrakesEndTheDifferenceFromTheOneBefore) {
  CompensatingRegulator own = regulator();
  own.resume(regulator(), 60);
  EXPECT_NEAR(own.step(0, 0, 0), 60, 1e-9);
  own.restart();
  EXPECT_FALSE(own.at_limit());
  EXPECT_NEAR(own.step(0, 0, 0), 0, 1e-9) << "it stands where it is set to be, without a load";
}

TEST(CompensatingRegulator, ResetForgetsEverything) {
  Drive drive(model(), 0.04);
  CompensatingRegulator own = regulator();
  for (int k = 0; k < 200; ++k) drive.step(own, 1.5);
  own.resume(1, 2, 30);
  own.reset();
  CompensatingRegulator fresh = regulator();
  fresh.reset();
  for (int k = 0; k < 20; ++k) ASSERT_EQ(own.step(0.1 * k, 0.3, 0.01), fresh.step(0.1 * k, 0.3, 0.01)) << k;
}

TEST(DriveModelDefaults, AreThoseOfMotorsOfWhichNothingElseIsSaid) {
  constexpr DriveModel kModel;
  constexpr robots::MotorParameters kMotor;
  EXPECT_EQ(kModel.presliding, kMotor.presliding);
  EXPECT_EQ(kModel.torque_constant, kMotor.torque_constant);
  EXPECT_EQ(kModel.supply, kMotor.supply);
  EXPECT_EQ(kModel.current_limit, kMotor.current_limit);
  EXPECT_GT(kModel.resistance * kModel.inertia, 0) << "a regulator divides by them";
}

}  // namespace
}  // namespace mrroc::edp
