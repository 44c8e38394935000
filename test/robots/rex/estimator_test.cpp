// Both estimators of Rex on a platform of their model's structure and on another one.
#include <gtest/gtest.h>

#include <ctime>
#include <memory>
#include <string>

#include "robots/rex/ekf.hpp"
#include "robots/rex/mhe.hpp"
#include "test/heap.hpp"
#include "test/robots/rex/estimator_rig.hpp"

namespace mrroc::rex::test {
namespace {

std::unique_ptr<edp::Estimator> make(const std::string& kind) {
  if (kind == "mhe") return std::make_unique<Mhe>();
  return std::make_unique<Ekf>();
}

class Estimators : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<edp::Estimator> estimator = make(GetParam());
};

std::string name_of(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Rex, Estimators, testing::Values("mhe", "ekf"), name_of);

Run winding_run() { return {.drive = winding(0.6, 0.9), .duration = 20}; }

void report(const std::string& name, const std::vector<Sample>& run) {
  const Slip slip = mean_slip(run, run.back().time / 2);
  testing::Test::RecordProperty(name + "_mu_x", std::to_string(slip.mu_x));
  testing::Test::RecordProperty(name + "_mu_y", std::to_string(slip.mu_y));
  testing::Test::RecordProperty(name + "_split", std::to_string(slip.split));
  testing::Test::RecordProperty(name + "_position_rms_mm", std::to_string(1e3 * position_rms(run)));
  testing::Test::RecordProperty(name + "_in_ellipse", std::to_string(share_in_ellipse(run)));
}

TEST_P(Estimators, FindFrictionOfTheirOwnModel) {
  const Slip grounds[]{
      {0.7, 0.6, 0}, {0.35, 0.3, 0}, {0.9, 0.9, 0}, {0.525, 0.45, 1.0 / 3}, {0.525, 0.45, -1.0 / 3}};
  for (const Slip& ground : grounds) {
    Run run = winding_run();
    run.truth.friction = ground;
    const auto samples = drive(*estimator, run);
    report("own_model", samples);
    const Slip found = mean_slip(samples, 10);
    EXPECT_NEAR(found.mu_x, ground.mu_x, 0.02);
    EXPECT_NEAR(found.mu_y, ground.mu_y, 0.02);
    EXPECT_NEAR(found.split, ground.split, 0.02);
    EXPECT_LT(position_rms(samples), 0.005);
    EXPECT_GE(share_in_ellipse(samples), 0.8);
    for (const Sample& s : samples) ASSERT_TRUE(s.result.health.ok && !s.result.health.solver_failed);
  }
}

}  // namespace
}  // namespace mrroc::rex::test
