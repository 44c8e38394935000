#include "bench/round_trip.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "robots/irb6/arm.hpp"

namespace mrroc::bench {
namespace {

using irb6::Arm;
using std::numbers::pi;

constexpr double kPoseError = 1e-9;
constexpr double kOtherBranch = 1e-6;  // [rad, m] more than this is another solution, not rounding
constexpr double kLimitRounding = 1e-9;

/// Random poses of one kinematic model.
class Trips {
 public:
  Trips(const Arm& arm, RoundTrips& result)
      : arm_(arm),
        first_(arm.parameters().first()),
        random_(1 + static_cast<unsigned>(arm.model())),
        result_(result) {}

  void run(long poses) {
    for (long k = 0; k < poses; ++k) {
      const AxisVector q = random_joints();
      const Pose T = arm_.forward(q);
      for (const bool flipped : {false, true})
        for (const bool bent : {false, true})
          for (const bool turned : {false, true})
            if (const auto solution = other_solution(q, flipped, bent, turned))
              result_.failures += !returns(T, *solution);
      AxisVector other = random_joints();
      if (first_ == 1) other[0] = q[0];  // or the arm need not reach so far
      result_.failures += !lies_within_the_limits(T, other);
    }
    result_.poses += poses;
  }

 private:
  AxisVector random_joints() {
    AxisVector motors(arm_.axes());
    for (int k = 0; k < motors.size(); ++k) {
      const edp::Range legal = arm_.axis(k).motor;
      motors[k] = std::uniform_real_distribution<>(legal.lower, legal.upper)(random_);
    }
    return arm_.joints_from_motors(motors);
  }

  /// The solution of the same pose on another branch.
  /// @param flipped  the other sign of sin q5
  /// @param bent     the other bend of the elbow
  /// @param turned   turned round, leaning over the back
  /// @return none when the arm is too short for it
  std::optional<AxisVector> other_solution(const AxisVector& q, bool flipped, bool bent, bool turned) const {
    const irb6::Lengths& a = arm_.parameters().lengths;
    AxisVector s = q;
    double theta2 = q[first_ + 1];
    double theta3 = theta2 + q[first_ + 2] + pi / 2;
    double theta4 = theta3 + q[first_ + 3];
    if (flipped || bent) {
      // From the shoulder to the pitch axis of the wrist; it changes sides of W with the hand.
      const double hand = flipped ? 2 * a.d5 : 0;
      const double E = a.a2 * std::cos(theta2) + a.a3 * std::cos(theta3) + hand * std::cos(theta4);
      const double F = a.a2 * std::sin(theta2) + a.a3 * std::sin(theta3) + hand * std::sin(theta4);
      const double reach = std::hypot(E, F);
      const double c = (a.a2 * a.a2 + reach * reach - a.a3 * a.a3) / (2 * a.a2 * reach);
      if (!(std::abs(c) <= 1)) return {};
      // Law of cosines; a bend is the angle from the lower to the upper arm, usually positive.
      const double bend = (std::sin(theta3 - theta2) < 0) == bent ? 1 : -1;
      theta2 = std::atan2(F, E) - bend * std::acos(c);
      theta3 = std::atan2(F - a.a2 * std::sin(theta2), E - a.a2 * std::cos(theta2));
    }
    if (flipped) {
      theta4 += pi;
      s[first_ + 4] = -s[first_ + 4];
      s[first_ + 5] += pi;
    }
    if (turned) {
      s[first_] += pi;
      theta2 = pi - theta2;
      theta3 = pi - theta3;
      theta4 = pi - theta4;
      s[first_ + 4] += pi;
    }
    s[first_ + 1] = theta2;
    s[first_ + 2] = theta3 - theta2 - pi / 2;
    s[first_ + 3] = theta4 - theta3;
    return s;
  }

  bool returns(const Pose& T, const AxisVector& joints) {
    const edp::InverseSolution s = solve(T, joints);
    return s.reached && (s.joints - joints).cwiseAbs().maxCoeff() <= kOtherBranch;
  }

  bool lies_within_the_limits(const Pose& T, const AxisVector& near) {
    const edp::InverseSolution s = solve(T, near);
    const AxisVector motors = arm_.motors_from_joints(s.joints);
    for (int k = 0; k < motors.size(); ++k) {
      const edp::Range legal = arm_.axis(k).motor;
      if (!(motors[k] >= legal.lower - kLimitRounding && motors[k] <= legal.upper + kLimitRounding))
        return false;
    }
    return s.reached;
  }

  /// reached is false also when the pose is not the one asked for.
  edp::InverseSolution solve(const Pose& T, const AxisVector& near) {
    edp::InverseSolution s = arm_.inverse(T, near);
    const Pose back = arm_.forward(s.joints);
    const double error = std::max((back.p - T.p).cwiseAbs().maxCoeff(), (back.R - T.R).cwiseAbs().maxCoeff());
    if (!(error <= kPoseError)) s.reached = false;
    result_.largest = std::max(result_.largest, error);
    ++result_.solutions;
    return s;
  }

  const Arm& arm_;
  int first_;
  std::mt19937_64 random_;
  RoundTrips& result_;
};

}  // namespace

RoundTrips run_round_trips(long poses) {
  std::vector<std::unique_ptr<Arm>> arms;
  for (const char* name : {"irb6_postument", "irb6_track"})
    for (int model = 0; std::unique_ptr<Arm> arm = irb6::make_arm(name, model); ++model)
      arms.push_back(std::move(arm));
  RoundTrips result;
  const auto n = static_cast<long>(arms.size());
  for (const std::unique_ptr<Arm>& arm : arms) Trips(*arm, result).run((poses + n - 1) / n);
  return result;
}

}  // namespace mrroc::bench
