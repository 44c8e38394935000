// What the estimator of a platform is given, and what is made of its results.
#include "edp/platform/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mrroc::edp::test {
namespace {

/// Tells what it is given, and gives what it is told.
struct Script {
  EstimatorResult result;
  bool takes_odometry{true}, takes_map{true};
  std::vector<StageReading> stages;
  std::vector<std::int64_t> odometry, map;  // steps
  int begun{};
};
class ScriptedEstimator : public Estimator {
 public:
  explicit ScriptedEstimator(Script& script) : script_(&script) {}
  void begin(const StandingStill& /*found*/) noexcept override { ++script_->begun; }
  void add(const StageReading& reading) noexcept override { script_->stages.push_back(reading); }
  bool add(const OdometryReading& reading) noexcept override {
    script_->odometry.push_back(reading.step);
    return script_->takes_odometry;
  }
  bool add(const MapPose& pose) noexcept override {
    script_->map.push_back(pose.step);
    return script_->takes_map;
  }
  EstimatorResult step() noexcept override { return script_->result; }

 private:
  Script* script_;
};

class ObserverTest : public ::testing::Test {
 protected:
  ObserverTest() {
    script.result.estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
    script.result.slip = {0.5, 0.4, 0.1};
    script.result.slip_sd = {0.1, 0.1, 0.1};
    parameters.nominal = {0.7, 0.6, 0};
    parameters.adapt = true;
    make();
  }
  void make() {
    observer.emplace(std::make_unique<ScriptedEstimator>(script), parameters);
    step_ = 0;
    stand();
  }
  /// Begins anew.
  void stand() {
    StandingStill found;
    found.step = step_;
    found.theta = {1, 2, 3, 4};
    observer->begin(found);
  }
  /// One more stage. @return the fault
  std::optional<Fault> step() {
    step_ += kPlatformSteps;
    return observer->step({.step = step_}, step_);
  }
  FaultCode fault() {
    const auto found = step();
    return found ? found->code : FaultCode::none;
  }
  static PlatformCommand with_map(std::int64_t at, bool valid = true) {
    PlatformCommand c;
    c.map = {.step = at, .valid = valid, .p = {1, 2, 3}, .covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    return c;
  }
  static PlatformCommand with_odometry(std::int64_t at, bool valid = true) {
    PlatformCommand c;
    c.odometry.step_before = at - 1;
    c.odometry.step = at;
    c.odometry.valid = valid;
    c.odometry.A = {1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0};
    for (std::size_t k = 0; k < 6; ++k) c.odometry.covariance[7 * k] = 1e-4;
    return c;
  }

  Script script;
  PlatformDriverParameters parameters;
  std::optional<Observer> observer;
  std::int64_t step_{};
};

TEST_F(ObserverTest, FillsInTheStagesThatWereMissed) {
  EXPECT_EQ(script.begun, 1);
  StageReading stage{.step = 4 * kPlatformSteps, .theta = {5, 6, 7, 8}};
  stage.yaw = 0.8;
  stage.imu_valid = true;
  ASSERT_FALSE(observer->step(stage, stage.step));
  ASSERT_EQ(script.stages.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto part = static_cast<double>(k + 1);
    EXPECT_EQ(script.stages[k].step, static_cast<std::int64_t>(k + 1) * kPlatformSteps);
    for (std::size_t w = 0; w < kWheels; ++w)
      EXPECT_NEAR(script.stages[k].theta[w], static_cast<double>(w + 1) + part, 1e-12);
    EXPECT_NEAR(script.stages[k].yaw, 0.8, 1e-12) << "there was none at the beginning";
  }
  stage.step = 6 * kPlatformSteps;
  stage.yaw = 1.0;
  ASSERT_FALSE(observer->step(stage, stage.step));
  ASSERT_EQ(script.stages.size(), 6U);
  EXPECT_NEAR(script.stages[4].yaw, 0.9, 1e-12);
  EXPECT_NEAR(script.stages[5].yaw, 1.0, 1e-12);
}

TEST_F(ObserverTest, LosesTheEstimateWhenTooManyStagesAreMissed) {
  ASSERT_FALSE(observer->step({.step = Observer::kMissed * kPlatformSteps}, 0));
  const std::int64_t late = (2 * Observer::kMissed + 1) * kPlatformSteps;
  const auto fault = observer->step({.step = late}, late);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::estimate_lost);
  EXPECT_EQ(fault->axis, -1);
  EXPECT_EQ(fault->value, Observer::kMissed + 1);
  EXPECT_EQ(fault->limit, Observer::kMissed);
  EXPECT_EQ(script.stages.size(), static_cast<std::size_t>(Observer::kMissed));
}

TEST_F(ObserverTest, GivesEveryMeasurementOnceAndOlderOnesNot) {
  observer->note(with_map(3));
  observer->note(with_odometry(4));
  ASSERT_FALSE(step());
  EXPECT_EQ(script.map, (std::vector<std::int64_t>{3}));
  EXPECT_EQ(script.odometry, (std::vector<std::int64_t>{4}));
  observer->note(with_map(3));
  observer->note(with_odometry(4));
  ASSERT_FALSE(step());
  EXPECT_EQ(script.map.size() + script.odometry.size(), 2U) << "they are the same";
  observer->note(with_map(2));
  observer->note(with_odometry(3));
  ASSERT_FALSE(step());
  EXPECT_EQ(script.map.size() + script.odometry.size(), 2U) << "they were delayed";
  EXPECT_EQ(observer->rejected(), 0);
  observer->note(with_map(9, false));
  observer->note(with_odometry(9, false));
  ASSERT_FALSE(step());
  EXPECT_EQ(script.map.size() + script.odometry.size(), 2U) << "there are none";
  observer->note(with_map(8));
  observer->note(with_map(6));
  observer->note(with_odometry(9));
  observer->note(with_odometry(7));
  ASSERT_FALSE(step());
  EXPECT_EQ(script.map, (std::vector<std::int64_t>{3, 8})) << "the newer one waits already";
  EXPECT_EQ(script.odometry, (std::vector<std::int64_t>{4, 9}));
  EXPECT_EQ(observer->late_map(), 0);
  EXPECT_EQ(observer->late_odometry(), 0);
}

TEST_F(ObserverTest, CountsWhatCannotBeUsedAndWhatIsLate) {
  observer->note(with_map(100'000));
  observer->note(with_odometry(100'000));
  ASSERT_FALSE(step());
  EXPECT_EQ(observer->rejected(), 2) << "from the future";
  EXPECT_TRUE(script.map.empty());
  EXPECT_TRUE(script.odometry.empty());
  observer->reject();
  EXPECT_EQ(observer->rejected(), 3);
  script.takes_map = script.takes_odometry = false;
  for (std::int64_t k = 1; k <= 2; ++k) {
    observer->note(with_map(k));
    observer->note(with_odometry(k));
    ASSERT_FALSE(step());
    EXPECT_EQ(observer->late_map(), k);
    EXPECT_EQ(observer->late_odometry(), k);
  }
}

TEST_F(ObserverTest, GivesAMapPoseToSynchroOnce) {
  observer->note(with_map(3));
  EXPECT_EQ(observer->take_map(5).value().step, 3);
  EXPECT_FALSE(observer->take_map(5));
  observer->note(with_map(7));
  EXPECT_FALSE(observer->take_map(6)) << "of a step that is to come";
  EXPECT_EQ(observer->rejected(), 1);
  EXPECT_FALSE(observer->take_map(7)) << "dropped";
}

TEST_F(ObserverTest, AResultThatCannotBeUsedLeavesTheLastOne) {
  EXPECT_FALSE(observer->known());
  script.result.estimate.p.x = 1;
  script.result.health.iterations = 4;
  ASSERT_FALSE(step());
  EXPECT_TRUE(observer->known());
  EXPECT_EQ(observer->health().iterations, 4);
  const EstimatorResult good = script.result;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int failures = 0;
  const auto spoils = [&](auto change) {
    script.result = good;
    script.result.estimate.p.y = 7;
    script.result.health.iterations = 9;
    change(script.result);
    ASSERT_FALSE(step());
    EXPECT_EQ(observer->result().estimate.p.y, 0);
    EXPECT_EQ(observer->health().iterations, 9) << "of the newest step";
    EXPECT_EQ(observer->failures(), ++failures);
    script.result = good;
    ASSERT_FALSE(step());
  };
  spoils([&](EstimatorResult& r) { r.health.ok = false; });
  spoils([&](EstimatorResult& r) { r.estimate.p.x = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.p.y = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.p.phi = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.v.vx = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.v.vy = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.v.w = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.theta[3] = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.theta_dot[0] = nan; });
  spoils([&](EstimatorResult& r) { r.estimate.covariance[8] = nan; });
  spoils([&](EstimatorResult& r) { r.slip.mu_x = nan; });
  spoils([&](EstimatorResult& r) { r.slip.mu_y = nan; });
  spoils([&](EstimatorResult& r) { r.slip.split = nan; });
  spoils([&](EstimatorResult& r) { r.slip_sd.mu_x = nan; });
  spoils([&](EstimatorResult& r) { r.slip_sd.mu_y = nan; });
  spoils([&](EstimatorResult& r) { r.slip_sd.split = nan; });
  spoils([&](EstimatorResult& r) { r.mass = nan; });
  spoils([&](EstimatorResult& r) { r.centre.x = nan; });
  spoils([&](EstimatorResult& r) { r.centre.y = nan; });
}

TEST_F(ObserverTest, FiveFailuresInSuccessionLoseTheEstimate) {
  script.result.health.solver_failed = true;
  for (int k = 1; k < Observer::kFailures; ++k) ASSERT_FALSE(step()) << k;
  EXPECT_TRUE(observer->known()) << "the result can be used all the same";
  script.result.health.solver_failed = false;
  ASSERT_FALSE(step());
  script.result.health.solver_failed = true;
  for (int k = 1; k < Observer::kFailures; ++k) ASSERT_FALSE(step()) << k;
  const auto fault = step();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::estimate_lost);
  EXPECT_EQ(fault->value, 5);
  EXPECT_EQ(fault->limit, 5);
  EXPECT_EQ(fault->axis, -1);
  EXPECT_EQ(observer->failures(), 9);
  stand();
  EXPECT_FALSE(observer->known());
  EXPECT_FALSE(step()) << "it begins anew";
}

TEST_F(ObserverTest, OnlyMapPosesThatWereAddedMayContradictIt) {
  script.result.health.inconsistent = true;
  for (int k = 0; k < 2 * Observer::kInconsistent; ++k) ASSERT_FALSE(step()) << "without a pose";
  const auto contradictions = [&](int n) {
    for (int k = 0; k < n; ++k) {
      observer->note(with_map(step_ + 1));
      if (const auto fault = step()) return std::pair(k + 1, *fault);
    }
    return std::pair(0, Fault{});
  };
  EXPECT_EQ(contradictions(Observer::kInconsistent - 1).first, 0);
  script.result.health.inconsistent = false;
  EXPECT_EQ(contradictions(1).first, 0) << "one agrees";
  script.result.health.inconsistent = true;
  script.takes_map = false;
  EXPECT_EQ(contradictions(2 * Observer::kInconsistent).first, 0) << "late ones";
  script.takes_map = true;
  const auto [after, fault] = contradictions(100);
  EXPECT_EQ(after, Observer::kInconsistent);
  EXPECT_EQ(fault.code, FaultCode::estimate_lost);
  EXPECT_EQ(fault.value, Observer::kInconsistent);
  EXPECT_EQ(fault.limit, Observer::kInconsistent);
  EXPECT_EQ(fault.axis, -1);
  stand();
  EXPECT_EQ(contradictions(Observer::kInconsistent - 1).first, 0);
}

TEST_F(ObserverTest, APositionThatIsTooUncertainInAnyDirectionIsLost) {
  const auto lost = [&](double xx, double yy, double xy) {
    make();
    script.result.estimate.covariance = {xx, xy, 0, xy, yy, 0, 0, 0, 1};
    return fault() == FaultCode::estimate_lost;
  };
  EXPECT_FALSE(lost(0.249, 0.249, 0));
  EXPECT_TRUE(lost(0.251, 0.01, 0));
  EXPECT_TRUE(lost(0.01, 0.251, 0));
  EXPECT_FALSE(lost(0.249, 0.01, 0));
  // Along the diagonal: 0.2 + 0.06.
  EXPECT_TRUE(lost(0.2, 0.2, 0.06));
  EXPECT_TRUE(lost(0.2, 0.2, -0.06));
  EXPECT_FALSE(lost(0.2, 0.2, 0.04));
  // 0.15 +- sqrt(0.08^2 + 0.06^2)
  EXPECT_FALSE(lost(0.23, 0.07, 0.0599));
  EXPECT_TRUE(lost(0.23, 0.07, 0.0602));
  make();
  script.result.estimate.covariance = {1, 0, 0, 0, 0.01, 0, 0, 0, 1};
  const auto told = step();
  ASSERT_TRUE(told);
  EXPECT_EQ(told->value, 1);
  EXPECT_EQ(told->limit, Observer::kLost);
  EXPECT_EQ(told->axis, -1);
}

TEST_F(ObserverTest, TheEstimatedSlipIsUsedFromWhereItIsCertainUntilItIsUncertain) {
  const auto adapts = [&](double sd, std::size_t which) {
    script.result.slip_sd = {0.01, 0.01, 0.01};
    (which == 0   ? script.result.slip_sd.mu_x
     : which == 1 ? script.result.slip_sd.mu_y
                  : script.result.slip_sd.split) = sd;
    EXPECT_FALSE(step());
    EXPECT_EQ(observer->slip().mu_x, observer->adapting() ? 0.5 : 0.7);
    EXPECT_EQ(observer->slip().mu_y, observer->adapting() ? 0.4 : 0.6);
    EXPECT_EQ(observer->slip().split, observer->adapting() ? 0.1 : 0);
    return observer->adapting();
  };
  for (std::size_t k = 0; k < 3; ++k) {
    make();
    EXPECT_FALSE(adapts(0.15, k));
    EXPECT_TRUE(adapts(0.149, k));
    EXPECT_TRUE(adapts(0.299, k));
    EXPECT_FALSE(adapts(0.3, k));
    EXPECT_FALSE(adapts(0.2, k));
    EXPECT_TRUE(adapts(0.1, k));
    stand();
    EXPECT_FALSE(observer->adapting());
    EXPECT_EQ(observer->slip().mu_x, 0.7);
  }
  parameters.adapt = false;
  make();
  EXPECT_FALSE(adapts(0.1, 0));
}

TEST_F(ObserverTest, ASlipThatNoGroundHasIsNotUsedAndMoreFrictionThanTheNominalNeither) {
  const auto adapts = [&](const Slip& slip) {
    make();
    script.result.slip = slip;
    EXPECT_FALSE(step());
    return observer->adapting();
  };
  EXPECT_TRUE(adapts({0.02, 0.02, 0.9}));
  EXPECT_TRUE(adapts({2, 2, -0.9}));
  EXPECT_EQ(observer->slip().mu_x, 0.7);
  EXPECT_EQ(observer->slip().mu_y, 0.6);
  EXPECT_EQ(observer->slip().split, -0.9);
  EXPECT_FALSE(adapts({0.0199, 0.5, 0}));
  EXPECT_FALSE(adapts({0.5, 0.0199, 0}));
  EXPECT_FALSE(adapts({2.01, 0.5, 0}));
  EXPECT_FALSE(adapts({0.5, 2.01, 0}));
  EXPECT_FALSE(adapts({0.5, 0.5, 0.91}));
  EXPECT_FALSE(adapts({0.5, 0.5, -0.91}));
}

TEST_F(ObserverTest, ADisplacementIsToldOnce) {
  script.result.displacement = {0.2, 0, 0};
  step();
  EXPECT_EQ(observer->result().displacement.x, 0.2);
  script.result.health.ok = false;
  step();
  EXPECT_EQ(observer->result().displacement.x, 0) << "what cannot be used has displaced nothing";
}

}  // namespace
}  // namespace mrroc::edp::test
