// Contract of every platform's kernel with the effector driver (edp/platform/platform.hpp), as a test suite. A new kernel
// uses it in three lines, in a test that links with mrroc_platform_contract:
//
//   #include "test/contract/platform_contract.hpp"
//   std::unique_ptr<edp::Platform> make() { return std::make_unique<MyPlatform>(); }
//   INSTANTIATE_TEST_SUITE_P(MyPlatform, PlatformContract, testing::Values(make), platform_name);
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

#include "edp/platform/platform.hpp"

namespace mrroc::contract {

/// Makes the platform.
using MakePlatform = std::unique_ptr<edp::Platform> (*)();

/// Names the tests after the platform.
inline std::string platform_name(const testing::TestParamInfo<MakePlatform>& info) {
  return std::string(info.param()->properties().name);
}

/// Every test goes over all estimators or trackers of the platform. Seeded.
class PlatformContract : public testing::TestWithParam<MakePlatform> {
 protected:
  PlatformContract() : platform_(GetParam()()), q_(platform_->properties()) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  /// @return what SYNCHRO finds of a platform of 400 N at the origin
  [[nodiscard]] static edp::StandingStill standing();
  /// @return measurements of a platform that stands since then  @param stage  1, 2, 3...
  [[nodiscard]] static edp::StageReading rest(int stage);
  /// @return finite measurements that need not have anything to do with one another
  edp::StageReading random_stage(int stage);
  /// @return a position that need not have anything to do with the measurements  @param stage  of the newest stage
  MapPose random_map(int stage);
  /// @return a motion of a few centimetres between two stages  @param stage  of the newest stage
  OdometryReading random_odometry(int stage);
  /// @return a state like one that an estimator gives
  edp::EstimatorResult random_state();
  /// @return points of a way with the platform's speeds, that begins anywhere near the state
  std::array<PathPoint, kHorizonPoints> random_reference(const edp::EstimatorResult& x);

  std::unique_ptr<edp::Platform> platform_;
  const edp::PlatformProperties& q_;
  std::mt19937_64 random_{20261125};
};

}  // namespace mrroc::contract
