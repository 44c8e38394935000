#include "tasks/press/press.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/script_port.hpp"

namespace mrroc::press {
namespace {

using X = Arm::X;

X image(double Fz) {
  X x;
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

}  // namespace
}  // namespace mrroc::press
