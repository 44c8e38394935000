#include "tasks/press/press.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/script_port.hpp"

namespace mrroc::press {
namespace {

using X = Arm::X;

X image(double Fz, double force = 4) {
  X x;
  x.c.value = force;
  x.e.F_a[Axis::z] = Fz;
  return x;
}

int macrosteps(const Motion<Arm>& row, double Fz) {
  X x = image(Fz);
  ScriptPort<Arm> port(std::vector<X>(1000, x));
  static_cast<void>(move(row, x, port));
  return static_cast<int>(port.decisions().size());
}

TEST(Press, ApproachEndsWhenItPushesAndNotBefore) {
  EXPECT_TRUE(kPress[0].f_tau(image(3.7)));
  EXPECT_FALSE(kPress[0].f_tau(image(3.5)));
  EXPECT_FALSE(kPress[0].f_tau(image(-4)));
}

TEST(Press, TheForceIsAParameter) {
  Config config = Config::parse("[task]\nforce = 7.5\n", "test");
  EXPECT_EQ(read_force(config), 7.5);
  EXPECT_EQ(read_force(Config()), 4);
  for (const double wrong : {0.9, 10.1, -4.0}) {
    Config bad;
    bad.set("task.force=" + std::to_string(wrong));
    EXPECT_THROW(static_cast<void>(read_force(bad)), ConfigError) << wrong;
  }
  const X x = image(7, 7.5);
  EXPECT_TRUE(kPress[0].f_tau(x));
  EXPECT_FALSE(kPress[0].f_tau(image(6.7, 7.5)));
  const AxisCommand approach = kPress[0].f_ce(x).arm.frame.z;
  EXPECT_DOUBLE_EQ(approach.velocity / approach.mobility, 7.5);
  EXPECT_EQ(kPress[2].f_ce(x).arm.frame.z.force, 7.5);
  for (const mp::TaskFigure& f : figures({{}}, config))
    if (f.info.key != "approach_peak_N") {
      EXPECT_NEAR((f.info.low + f.info.high) / 2, 7.5, 1e-12) << f.info.key;
    }
}

TEST(Press, EveryOtherBehaviourTakesItsTimeWhateverTheForce) {
  for (const double Fz : {0.0, 10.0}) {
    EXPECT_EQ(macrosteps(kPress[1], Fz), 150);
    EXPECT_EQ(macrosteps(kPress[2], Fz), 100);
    EXPECT_EQ(macrosteps(kPress[3], Fz), 50);
  }
}

TEST(Press, CommandsWhatTheTableSays) {
  const auto z = [](int row) { return kPress[static_cast<std::size_t>(row)].f_ce({}).arm.frame.z; };
  EXPECT_EQ(z(0), z(1));
  EXPECT_DOUBLE_EQ(z(0).velocity / z(0).mobility, 4) << "where a guarded motion settles";
  EXPECT_EQ(z(2), c(4, 20, 0.005));
  EXPECT_LT(z(3).velocity, 0);
  for (const auto& row : kPress)
    for (const Axis a : kAxes)
      if (a != Axis::z) {
        EXPECT_EQ(row.f_ce({}).arm.frame[a], u()) << row.name;
      }
}

TEST(Press, FiguresAreThePeakAndTheEndOfTheApproach) {
  mp::ArmTrace rows;
  const auto add = [&](int m, double t, double Fz) {
    mp::ArmRow& row = rows.emplace_back();
    row.m = m;
    row.t = t;
    row.F[Axis::z] = Fz;
  };
  add(1, 0, 0);
  add(1, 1, 6);
  for (double t = 1; t < 3; t += 0.1) add(2, t, t < 1.9 ? 5 : 4);
  for (double t = 3; t < 5; t += 0.1) add(3, t, 3.9);
  add(4, 6, 9);
  const auto f = figures({rows}, Config());
  EXPECT_EQ(std::get<double>(figure(f, "approach_peak_N")), 6);
  EXPECT_EQ(std::get<double>(figure(f, "approach_settled_N")), 4);
  EXPECT_NEAR(std::get<double>(figure(f, "hold_N")), 3.9, 1e-12);
  EXPECT_TRUE(std::isnan(std::get<double>(figure(figures({{}}, Config()), "approach_peak_N"))));
}

TEST(Press, ItsNumbersAreThoseOfTheTutorial) {
  const auto z = [](std::size_t row, double force) { return kPress[row].f_ce(image(0, force)).arm.frame.z; };
  for (const double force : {4.0, 8.0}) {
    EXPECT_EQ(z(0, force), g(0.0025 * force, 5, 0.0025));
    EXPECT_EQ(z(2, force), c(force, 20, 0.005));
    EXPECT_EQ(z(3, force), u(-0.02));
    EXPECT_FALSE(kPress[0].f_tau(image(0.9 * force, force)));
    EXPECT_TRUE(kPress[0].f_tau(image(0.9 * force + 1e-9, force)));
  }
  for (std::size_t k = 0; k < kPress.size(); ++k) {
    EXPECT_EQ(kPress[k].m, static_cast<int>(k) + 1);
    for (const double Fz : {-1.0, 5.0})
      EXPECT_EQ(kPress[k].f_ce(image(Fz)).instruction, Instruction::set_get);
  }
}

TEST(Press, AForceIsAsWantedWithinTwoAndAHalfPerCentAndItsPeakIsNotJudged) {
  for (const mp::TaskFigure& f : figures({{}}, Config::parse("[task]\nforce = 8\n", "test")))
    if (f.info.key == "approach_peak_N") {
      EXPECT_EQ(mp::wanted(f.info), "");
    } else {
      EXPECT_NEAR(f.info.low, 7.8, 1e-12) << f.info.key;
      EXPECT_NEAR(f.info.high, 8.2, 1e-12) << f.info.key;
    }
}

TEST(Press, TheHeldForceIsThatOfItsLastSecondAndThePeakThatOfBothApproaches) {
  mp::ArmTrace rows;
  const auto fill = [&](int m, double from, double Fz) {
    for (double t = from; t < from + 1; t += 0.1) {
      mp::ArmRow& row = rows.emplace_back();
      row.m = m;
      row.t = t;
      row.F[Axis::z] = Fz;
    }
  };
  fill(1, 0, 1);
  fill(2, 1, 9);
  fill(2, 2, 3);
  fill(3, 3, 20);
  fill(3, 4, 5);
  const auto f = figures({rows}, Config());
  EXPECT_EQ(std::get<double>(figure(f, "approach_peak_N")), 9);
  EXPECT_NEAR(std::get<double>(figure(f, "approach_settled_N")), 3, 1e-12);
  EXPECT_NEAR(std::get<double>(figure(f, "hold_N")), 5, 1e-12);
}

}  // namespace
}  // namespace mrroc::press
