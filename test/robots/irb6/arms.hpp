// Shared parts of the IRb-6's suites: both arms with both parameter sets, and random poses of them.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include "robots/irb6/arm.hpp"

namespace mrroc::irb6::test {

#ifdef MRROC_SANITIZED
inline constexpr int kCases = 5'000;
#else
inline constexpr int kCases = 50'000;
#endif

inline constexpr double kPi = std::numbers::pi;

/// One kinematic model of an arm.
struct ArmCase {
  const char* name;
  ParameterSet set;
  TrackRule rule{TrackRule::kept};
};

/// A suite over both arms and their models. Seeded, so that every failure repeats.
class Irb6 : public testing::TestWithParam<ArmCase> {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

  /// @return motors anywhere within the limits [rad]
  AxisVector random_motors() {
    AxisVector m(arm_.axes());
    for (int k = 0; k < m.size(); ++k) m[k] = uniform(arm_.axis(k).motor.lower, arm_.axis(k).motor.upper);
    return m;
  }
  /// @return joints anywhere within the motor limits
  AxisVector random_joints() { return arm_.joints_from_motors(random_motors()); }

  const std::unique_ptr<Arm> owner_ =
      make_arm(GetParam().name, model_number(GetParam().set, GetParam().rule));
  const Arm& arm_ = *owner_;
  const int first_ = arm_.parameters().first();  ///< index of q1
  std::mt19937_64 random_{20240601};
};

inline std::string arm_case_name(const testing::TestParamInfo<ArmCase>& info) {
  constexpr std::array kRules{"", "_last_axis_kept", "_column_kept"};
  return std::string(info.param.name).substr(5) +
         (info.param.set == ParameterSet::nominal ? "_nominal" : "_calibrated") +
         kRules[static_cast<std::size_t>(info.param.rule)];
}

/// The models in which a pose decides all axes but the track.
inline const auto kTrackKept = testing::Values(
    ArmCase{"irb6_postument", ParameterSet::nominal}, ArmCase{"irb6_postument", ParameterSet::calibrated},
    ArmCase{"irb6_track", ParameterSet::nominal}, ArmCase{"irb6_track", ParameterSet::calibrated});
/// The models that move the track.
inline const auto kTrackActive =
    testing::Values(ArmCase{"irb6_track", ParameterSet::nominal, TrackRule::last_axis_kept},
                    ArmCase{"irb6_track", ParameterSet::calibrated, TrackRule::last_axis_kept},
                    ArmCase{"irb6_track", ParameterSet::nominal, TrackRule::column_kept},
                    ArmCase{"irb6_track", ParameterSet::calibrated, TrackRule::column_kept});

/// @return the largest difference of two poses over position [m] and elements of the matrix
inline double difference(const Pose& a, const Pose& b) {
  return std::max((a.p - b.p).cwiseAbs().maxCoeff(), (a.R - b.R).cwiseAbs().maxCoeff());
}

/// @return whether all motors are within their limits
inline bool motors_legal(const Arm& arm, const AxisVector& joints, double tolerance = 1e-9) {
  const AxisVector m = arm.motors_from_joints(joints);
  for (int k = 0; k < m.size(); ++k)
    if (!(m[k] >= arm.axis(k).motor.lower - tolerance && m[k] <= arm.axis(k).motor.upper + tolerance))
      return false;
  return true;
}

/// @return whether all joints and motors are within their limits
inline bool legal(const Arm& arm, const AxisVector& joints) {
  for (int k = 0; k < joints.size(); ++k)
    if (!arm.axis(k).joint.contains(joints[k])) return false;
  return motors_legal(arm, joints);
}

/// @return pose of E with the tool pointing straight down, x of E along x of the base
inline Pose tool_down(double x, double y, double z) {
  Pose T_0E;
  T_0E.R = Vector3(1, -1, -1).asDiagonal();
  T_0E.p << x, y, z;
  return T_0E;
}

}  // namespace mrroc::irb6::test
