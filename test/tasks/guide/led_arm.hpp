// An ideal arm in the hand of an operator: it moves as law MG (28) says, its answers come as late as over the links.
#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <vector>

#include "base/representation.hpp"
#include "edp/control_law.hpp"
#include "tasks/guide/guide.hpp"

namespace mrroc::guide {

/// A hand with a mass, as sim::Hand has it: muscles pull it to where it wants to be, a grip holds the tool.
struct LeadingHand {
  double stiffness{1000}, damping{30}, mass{1};  // [N/m], [N s/m], [kg]
  double grip_stiffness{4000}, grip_damping{40};
  std::function<Vector3(double)> wanted;  // place over time [s], [m]
  Vector3 p{Vector3::Zero()}, v{Vector3::Zero()}, wanted_before{Vector3::Zero()};

  /// @return force on the tool [N]
  Vector3 step(double t, double dt, const Vector3& tool, const Vector3& velocity) {
    const Vector3 goal = wanted(t);
    const Vector3 muscles = stiffness * (goal - p) + damping * ((goal - wanted_before) / dt - v);
    Vector3 force = grip_stiffness * (p - tool) + grip_damping * (v - velocity);
    wanted_before = goal;
    v += dt / mass * (muscles - force);
    p += dt * v;
    return force;
  }
};

/// What was in a step.
struct LedStep {
  int m{};
  Vector3 p{Vector3::Zero()}, v{Vector3::Zero()}, F{Vector3::Zero()};  // tool, and the hand's force on it
};

/// Port of kGuide.
class LedArm {
 public:
  static constexpr double kDt = 0.002;

  LedArm(const Setup& k, const Vector3& tool, LeadingHand hand)
      : hand_(std::move(hand)), T_WE_(k.T_WE), T_0W_{Matrix3::Identity(), tool - k.T_WE.p} {
    hand_.p = hand_.wanted_before = tool;
  }

  void dispatch(const Motion<Arm>& motion, const Arm::Y& y) {
    m_ = motion.m;
    commands_.push_back(y.e);
  }
  Outcome wait() {
    execute(commands_.front());
    commands_.pop_front();
    return ++i_ < 20'000 ? Outcome::terminated : Outcome::aborted;
  }
  void read(Arm::X& x) {
    x.i = i_;
    const Pose T_0E = T_0W_ * T_WE_;
    const Vector6 r = angle_axis_from_pose(T_0E);
    std::ranges::copy(r, x.e.T_0E.begin());
    x.e.position_known = true;
    x.e.F_a = F_;
    x.T.go_on[0] = t() > until;
  }
  [[nodiscard]] double t() const { return kDt * static_cast<double>(steps.size()); }

  double until{HUGE_VAL};  // then the operator gives triggers [s]
  std::vector<LedStep> steps;

 private:
  void execute(const EffectorCommand& e) {
    if (has(e.set, Part::robot_model)) {
      const Pose T_WE = *pose_from_numbers(e.robot_model.tool_representation, e.robot_model.tool);
      v_ = xi_star(T_WE.R.transpose() * T_WE_.R, v_);
      T_WE_ = T_WE;
    }
    for (int step = 0; step < kPacing.n_s; ++step) {
      const Pose T_0E = T_0W_ * T_WE_;
      const Vector3 velocity = T_0E.R * v_.linear();
      const Vector3 force = hand_.step(t(), kDt, T_0E.p, velocity);
      steps.push_back({m_, T_0E.p, velocity, force});
      F_ = Wrench::from(-(T_0E.R.transpose() * force), Vector3::Zero());
      if (!has(e.set, Part::arm)) continue;
      v_ = edp::step_velocity(e.arm.frame, F_, v_, kDt);
      T_0W_.p += kDt * (T_0E.R * v_.linear());
    }
  }

  LeadingHand hand_;
  std::deque<EffectorCommand> commands_{{}};
  Pose T_WE_, T_0W_;
  Twist v_;
  Wrench F_;
  std::int64_t i_{};
  int m_{};
};

}  // namespace mrroc::guide
