#include "tasks/calibrate_cell/cell/kinematic_sets.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "robots/catalogue.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr SetNumbers kNominal{0, 0};

Config cell(const std::string& synchro = "known_pose") {
  Config c = Config::parse(config(), "calibrate_cell.toml");
  for (const char* arm : kKeys) c.set("robots." + std::string(arm) + ".synchro=" + synchro);
  complete(c);
  return c;
}

/// An arm that has another set than its driver believes, and what that driver measures.
struct Arm {
  Arm(const Config& config, std::size_t arm, int set)
      : type(robots::read_type(config, kKeys.at(arm), robots::catalogue(), kModels.at(arm))),
        real(type.make(set)),
        believed(type.make(0)) {
    const auto start = config.list("robots." + std::string(kKeys.at(arm)) + ".start_joints", std::nullopt,
                                   {-10, 10}, "rad, m");
    joints = Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
    if (config.text("robots." + std::string(kKeys.at(arm)) + ".synchro", "") == "known_pose")
      offset = believed->motors_from_joints(joints) - real->motors_from_joints(joints);
    else
      offset = AxisVector::Zero(joints.size());
  }
  [[nodiscard]] Pose measured(const Pose& T_0E) const {
    const Pose& T_WE = type.driver.T_WE;
    const AxisVector q = real->inverse(T_0E * T_WE.inverse(), joints).joints;
    return believed->forward_from_motors(real->motors_from_joints(q) + offset) * T_WE;
  }

  const robots::RobotType& type;
  std::unique_ptr<edp::Robot> real, believed;
  AxisVector joints, offset;
};

/// Rows of arms with these sets that touch the balls, whose drivers believe the nominal ones.
/// @param noise  of each touch [m]
std::vector<mp::ArmTrace> touched(const Config& config, const SetNumbers& sets, double noise = 0) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<mp::ArmTrace> traces(kArms);
  for (std::size_t k = 0; k < kArms; ++k) {
    const Arm arm(config, k, sets.at(k));
    const ProbePlan plan = read_plan(config, kKeys.at(k));
    const Matrix3 R = (arm.type.make(0)->forward(arm.joints) * arm.type.driver.T_WE).R;
    for (std::size_t n = 0; n < touches(plan); ++n) {
      Vector3 p = plan.balls[n / kTouchesPerBall] -
                  (plan.ball_radius + plan.tip_radius) * in_base(direction(n), R) +
                  plan.tip_radius * R.col(2);
      for (double& x : p) x += noise * normal(random);
      mp::ArmRow row;
      row.m = kFeel;
      traces[k].push_back(row);
      row.m = kMeasure;
      row.pose = angle_axis_from_pose(arm.measured({R, p}));
      for (int reading = 0; reading < plan.readings; ++reading) traces[k].push_back(row);
    }
  }
  return traces;
}

TEST(KinematicSets, AreThoseOfTheArmsWhicheverTheirDriversBelieve) {
  for (const char* synchro : {"known_pose", "homing"}) {
    const Config c = cell(synchro);
    for (const SetNumbers& sets : {SetNumbers{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
      const SetsVerdict verdict = fit_sets(touched(c, sets), c);
      EXPECT_TRUE(verdict.told_apart) << synchro;
      const SetsFit& chosen = verdict.fits.at(verdict.chosen);
      EXPECT_EQ(chosen.sets, sets) << synchro << '\n' << describe(verdict);
      ASSERT_TRUE(chosen.found);
      const PoseDistance off = distance(chosen.found->T_12.T_AB, relation(believed_bases(c)));
      EXPECT_LT(off.mm, 1e-3);
      EXPECT_LT(off.deg, 1e-3);
      EXPECT_EQ(chosen.names[0], sets[0] == 0 ? "nominal" : "calibrated");
      EXPECT_EQ(describe(verdict).find("cannot be told apart"), std::string::npos);
    }
  }
}

TEST(KinematicSets, StayAsBelievedAndThisIsSaidWhenTouchesDoNotTellThemApart) {
  const Config c = cell();
  constexpr double kNoise = 0.003;  // [m]
  const SetsVerdict verdict = fit_sets(touched(c, {1, 1}, kNoise), c);
  EXPECT_FALSE(verdict.told_apart);
  EXPECT_EQ(verdict.fits.at(verdict.chosen).sets, kNominal);
  EXPECT_NE(describe(verdict).find("cannot be told apart"), std::string::npos);
}

TEST(KinematicSets, AreJudgedByTheSimulators) {
  Config c = cell();
  c.set("sim.robots.arm2.kinematics=calibrated");
  EXPECT_EQ(true_sets(c), (SetNumbers{0, 1}));
  const SetsVerdict verdict = fit_sets(touched(c, kNominal), c);
  mp::TaskFigures figures;
  add_figures(figures, verdict, true_sets(c));
  EXPECT_EQ(std::get<double>(mp::figure(figures, "sets_wrong")), 1);
  EXPECT_LT(std::get<double>(mp::figure(figures, "sets_rms_mm")), 1e-3);
  EXPECT_GT(std::get<double>(mp::figure(figures, "other_sets_rms_mm")), 0.1);
}

TEST(KinematicSets, HaveNoMisfitWhenNothingWasTouched) {
  const Config c = cell();
  const SetsVerdict verdict = fit_sets(std::vector<mp::ArmTrace>(kArms), c);
  EXPECT_FALSE(verdict.told_apart);
  EXPECT_FALSE(verdict.fits.at(verdict.chosen).found);
  mp::TaskFigures figures;
  add_figures(figures, verdict, kNominal);
  EXPECT_TRUE(std::isnan(std::get<double>(mp::figure(figures, "sets_wrong"))));
}

}  // namespace
}  // namespace mrroc::calibrate_cell
