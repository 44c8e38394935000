#include "test/sim/pose_goal.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "base/fault.hpp"
#include "base/representation.hpp"
#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "robots/irb6/robot_type.hpp"
#include "sim/world.hpp"
#include "test/base/random_pose.hpp"

namespace mrroc::sim::test {
namespace {

using edp::SetPoint;
using mrroc::test::random_direction;
using mrroc::test::uniform;

constexpr int kCommandsFromAPose = 10;
constexpr int kBeginning = 5;  // steps in which a motion fails that begins too fast: at rest it has no speed
constexpr int kSilence = 25;   // macrosteps until the brakes are closed

int pick(std::mt19937_64& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

WorldParameters alone(bool on_track, std::mt19937_64& random) {
  WorldParameters w;
  w.arms = {arm_parameters(on_track ? irb6::track() : irb6::postument())};
  AxisVector front = irb6::make_arm(on_track ? "irb6_track" : "irb6_postument")->front();
  front.tail<3>() << 0, 1.5 * std::numbers::pi, 0;  // the tool points down
  for (int k = 0; k < front.size(); ++k) {
    const bool track = on_track && k == 0;
    w.arms[0].start.push_back(front[k] + (track ? uniform(random, 0.2, 0.6) : uniform(random, -0.15, 0.15)));
  }
  return w;
}

/// One arm with its driver, from whose commands a random hand chooses.
class PosedArm {
 public:
  PosedArm(bool on_track, std::mt19937_64& random, PoseGoalCount& count)
      : robot_(irb6::make_arm(on_track ? "irb6_track" : "irb6_postument")),
        world_(alone(on_track, random), random()),
        driver_(*robot_, parameters()),
        random_(random),
        count_(count) {
    send({.instruction = Instruction::synchro});
    run(1);
    run(kSilence);
    last_ = driver_.set_point().T_0E;
    lowest_ = last_.p.z() - 0.02;
  }

  /// Commands some poses in a row, then nothing.
  void try_poses(int in_a_row) {
    goal_ = driver_.set_point();
    std::string told;
    bool executed = false;
    for (int k = 0; k < in_a_row; ++k) {
      const SetPoint before = goal_;
      const ArmCommand arm = random_command();
      EffectorCommand c{.instruction = Instruction::set};
      c.set = static_cast<std::uint8_t>(Part::arm);
      c.arm = arm;
      path_.clear();
      steps_ = moved_ = 0;
      send(c);
      run(1);
      if (driver_.reply().verdict == Verdict::refused) {
        ++count_.refused;
        goal_ = before;
        continue;
      }
      executed = true;
      told = fmt::format("{} mu {} representation {} reference {} n_s {} n_Q {}, {:.3f} m, {:.3f} rad",
                         robot_->name(), static_cast<int>(arm.mu), static_cast<int>(arm.representation),
                         static_cast<int>(arm.reference), arm.n_s, arm.n_Q,
                         (goal_.T_0E.p - before.T_0E.p).norm(),
                         angle_axis_from_rotation(before.T_0E.R.transpose() * goal_.T_0E.R).norm());
    }
    const int end = steps_;
    run(kSilence);
    moved_ -= end;
    if (driver_.fault()) fault_ = driver_.fault();
    if (!executed) return;
    if (fault_ && !begun_) {
      ++count_.refused;
      return;
    }
    ++count_.commands;
    if (fault_) {
      ++count_.faults;
      count_.worst = told + " " + describe(fault_);
      return;
    }
    judge(told);
  }
  [[nodiscard]] bool failed() const { return static_cast<bool>(fault_); }

 private:
  edp::DriverParameters parameters() const {
    edp::DriverParameters p;
    p.synchro_joints = world_.start_joints(0);
    p.T_WE = robot_->tool_in_wrist();
    p.force.T_WS = robot_->sensor_in_wrist();
    return p;
  }

  void send(EffectorCommand c) {
    c.session = 1;
    c.number = driver_.protocol().expected();
    driver_.take(c);
  }

  void run(int macrosteps) {
    for (int k = 0; k < macrosteps; ++k) do
        step();
      while (!driver_.at_boundary());
  }

  void step() {
    const AxisVector before = driver_.set_point().motor_increment;
    const HardwareCommand command = driver_.step(world_.reading(0));
    world_.step({&command, 1});
    ++steps_;
    if (driver_.fault() && !fault_) {
      fault_ = driver_.fault();
      begun_ = steps_ > kBeginning;
    }
    const SetPoint& set = driver_.set_point();
    const edp::Limits limits;
    for (int k = 0; k < robot_->axes(); ++k) {
      count_.acceleration = std::max(count_.acceleration, std::abs(set.motor_increment[k] - before[k]) /
                                                              (kStep * kStep) / limits.motor_acceleration);
      count_.speed =
          std::max(count_.speed, std::abs(set.motor_increment[k]) / kStep / robot_->axis(k).max_motor_speed);
    }
    if (steps_ > 1)
      count_.speed = std::max(count_.speed, (set.T_0E.p - last_.p).norm() / kStep / limits.linear_velocity);
    last_ = set.T_0E;
    if (!set.motor_increment.isZero(0)) moved_ = steps_;
    path_.push_back(world_.truth(0).T_0E.p);
  }

  /// @return how far E was beyond the goal, along the way on which it came [m]. The path of MIM is no straight line.
  double overshoot() const {
    constexpr double kNear = 5e-4, kComing = 2e-3;  // of the goal [m]
    const auto away = [&](const Vector3& p) { return (p - goal_.T_0E.p).norm(); };
    const auto there = std::ranges::find_if(path_, [&](const Vector3& p) { return away(p) < kNear; });
    auto coming = there;
    while (coming != path_.begin() && away(*coming) < kComing) --coming;
    if (there == path_.end() || away(*coming) < kNear) return 0;
    const Vector3 direction = (goal_.T_0E.p - *coming).normalized();
    double beyond = 0;
    for (auto p = there; p != path_.end(); ++p) beyond = std::max(beyond, (*p - goal_.T_0E.p).dot(direction));
    return beyond;
  }

  void judge(const std::string& told) {
    const Pose& E = world_.truth(0).T_0E;
    const double beyond = overshoot();
    const double mm = 1e3 * (E.p - goal_.T_0E.p).norm();
    const double deg = 180 / M_PI * angle_axis_from_rotation(Matrix3(E.R.transpose() * goal_.T_0E.R)).norm();
    if (mm > count_.error_mm || deg > count_.error_deg || 1e3 * beyond > count_.overshoot_mm)
      count_.worst = fmt::format("{}: {:.4f} mm, {:.4f} deg, beyond {:.4f} mm", told, mm, deg, 1e3 * beyond);
    count_.error_mm = std::max(count_.error_mm, mm);
    count_.error_deg = std::max(count_.error_deg, deg);
    count_.overshoot_mm = std::max(count_.overshoot_mm, 1e3 * beyond);
    count_.set_error_mm =
        std::max(count_.set_error_mm, 1e3 * (driver_.set_point().T_0E.p - goal_.T_0E.p).norm());
    count_.longest = std::max(count_.longest, moved_);
  }

  /// A pose at up to 0.15 m/s and 0.6 rad/s from the goal before; goal_ becomes the new one.
  ArmCommand random_command() {
    ArmCommand a;
    a.n_s = static_cast<std::uint16_t>(pick(random_, 2) ? 11 + pick(random_, 490) : 11 + pick(random_, 50));
    a.n_Q = static_cast<std::uint16_t>(pick(random_, 4) ? a.n_s - 1 : a.n_s + 1);
    a.mu = pick(random_, 2) ? Interpolation::mim : Interpolation::tcim_pose;
    const int first = a.mu == Interpolation::mim ? 0 : 2;
    a.representation = static_cast<Representation>(first + pick(random_, 5 - first));
    a.reference = pick(random_, 2) ? Reference::relative : Reference::absolute;
    const double time = kStep * a.n_s;
    const double way = std::min(0.05, uniform(random_, 0, 0.15) * time);
    const double turn = std::min(0.2, uniform(random_, 0, 0.6) * time);
    const SetPoint before = goal_;
    Vector3 v = way * random_direction(random_);  // in the base
    if (before.T_0E.p.z() + v.z() < lowest_) v.z() = -v.z();
    const Pose step{rotation_from_angle_axis(Vector3(turn * random_direction(random_))),
                    before.T_0E.R.transpose() * v};
    goal_.T_0E = before.T_0E * step;
    const edp::InverseSolution s =
        robot_->inverse(goal_.T_0E * robot_->tool_in_wrist().inverse(), before.axes.joints);
    goal_.axes = {s.joints, robot_->motors_from_joints(s.joints)};
    const bool relative = a.reference == Reference::relative;
    if (a.representation == Representation::motors)
      a.pose = numbers_from_axes(relative ? AxisVector(goal_.axes.motors - before.axes.motors)
                                          : goal_.axes.motors);
    else if (a.representation == Representation::joints)
      a.pose = numbers_from_axes(relative ? AxisVector(goal_.axes.joints - before.axes.joints)
                                          : goal_.axes.joints);
    else
      a.pose = numbers_from_pose(a.representation, relative ? step : goal_.T_0E);
    return a;
  }

  std::unique_ptr<irb6::Arm> robot_;
  World world_;
  edp::Driver driver_;
  std::mt19937_64& random_;
  PoseGoalCount& count_;
  SetPoint goal_;  // T_0E and axes
  Pose last_;
  double lowest_{};            // height of E above which nothing is touched
  std::vector<Vector3> path_;  // of E in the world, since the last command
  int steps_{};
  int moved_{};
  Fault fault_;
  bool begun_{};  // it came after the beginning
};

}  // namespace

PoseGoalCount count_pose_goals(int commands, std::uint64_t seed, int in_a_row) {
  std::mt19937_64 random(seed);
  PoseGoalCount count;
  for (int arm = 0; count.commands < commands; ++arm) {
    if (arm > commands)
      throw FaultError(FaultCode::internal_error,
                       fmt::format("{} commands were executed, {} were refused: {} are wanted",
                                   count.commands, count.refused, commands));
    PosedArm posed(arm % 2 == 1, random, count);
    for (int k = 0; k < kCommandsFromAPose && !posed.failed() && count.commands < commands; ++k)
      posed.try_poses(in_a_row);
  }
  return count;
}

}  // namespace mrroc::sim::test
