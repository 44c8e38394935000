// The smallest effector driver that moves an arm of the simulator: law (28), inverse kinematics, servo.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "base/axis_command.hpp"
#include "base/pose.hpp"
#include "edp/control_law.hpp"
#include "edp/servo.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {

/// Drives one arm with a command for the task frame E. Weight is compensated by the bias alone, so force
/// control works in the orientation of the bias only.
class Driver {
 public:
  /// @param set  that the driver believes in
  explicit Driver(const World& world, int arm, irb6::ParameterSet set = irb6::ParameterSet::nominal)
      : world_(world),
        arm_(arm),
        robot_(irb6::make_arm(arm == 0 ? "irb6_postument" : "irb6_track", irb6::model_number(set))),
        servo_(*robot_, kStep),
        joints_(world.start_joints(arm)),
        motors_(robot_->motors_from_joints(joints_)),
        T_0E_(robot_->forward(joints_) * robot_->tool_in_wrist()),
        R_ES_(robot_->tool_in_wrist().R.transpose() * robot_->sensor_in_wrist().R) {}

  TaskFrameCommand command{};  ///< all u() with velocity 0

  /// @return what the drives are to do in the next step
  HardwareCommand step() {
    const HardwareReading& reading = world_.reading(arm_);
    F_a_ = -xi_star(R_ES_, reading.S_F_m - bias_);
    v_ = edp::step_velocity(command, F_a_, v_, kStep);
    T_0E_ = T_0E_ * pose_from_angle_axis(kStep * v_.vector());

    joints_ = robot_->inverse(T_0E_ * robot_->tool_in_wrist().inverse(), joints_).joints;
    const AxisVector motors = robot_->motors_from_joints(joints_);
    AxisVector turned(robot_->axes());
    for (int k = 0; k < robot_->axes(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      turned[k] = reading.encoder[i] - encoder_[i];
    }
    HardwareCommand out{.step = reading.step, .enabled = true};
    out.pwm = servo_.step(motors - motors_, turned, robot_->gravity(motors));
    motors_ = motors;
    encoder_ = reading.encoder;
    return out;
  }

  /// Chooses the regulators of all motors, parameter set 0.
  void select(int algorithm_no) {
    for (int k = 0; k < robot_->axes(); ++k) servo_.select(k, algorithm_no, 0);
  }
  /// Takes a mean of readings as that of the free tool.
  void bias(const Wrench& mean) { bias_ = mean; }
  /// @return F_a of the last step, in E
  [[nodiscard]] const Wrench& force() const { return F_a_; }
  /// @return pose of the pen tip as the encoders of the last reading have it
  [[nodiscard]] Pose measured_pose() const {
    AxisVector motors = robot_->motors_from_joints(world_.start_joints(arm_));
    for (int k = 0; k < robot_->axes(); ++k)
      motors[k] +=
          world_.reading(arm_).encoder[static_cast<std::size_t>(k)] / robot_->axis(k).increments_per_rad;
    return robot_->forward(robot_->joints_from_motors(motors)) * robot_->tool_in_wrist();
  }
  /// @return set pose of the pen tip
  [[nodiscard]] const Pose& set_pose() const { return T_0E_; }

 private:
  const World& world_;
  int arm_;
  std::unique_ptr<irb6::Arm> robot_;
  edp::Servo servo_;
  AxisVector joints_, motors_;
  Pose T_0E_;
  Matrix3 R_ES_;
  Twist v_{};
  Wrench F_a_{}, bias_{};
  std::array<std::int32_t, kMaxAxes> encoder_{};
};

/// All arms of a world with their drivers.
class Cell {
 public:
  explicit Cell(const WorldParameters& parameters = rig::irb6_cell(), std::uint64_t seed = 1)
      : world(parameters, seed) {
    for (int k = 0; k < world.arms(); ++k) drivers.emplace_back(world, k);
    commands.resize(drivers.size());
  }

  /// Runs so many steps; after(cell) is called after each.
  template <class After>
  void run(int steps, After after) {
    for (int k = 0; k < steps; ++k) {
      for (std::size_t arm = 0; arm < drivers.size(); ++arm) commands[arm] = drivers[arm].step();
      world.step(commands);
      after();
    }
  }
  void run(int steps) {
    run(steps, [] {});
  }

  /// Settles for a second and biases the sensors.
  void prepare() {
    constexpr int kSettle = 400;
    constexpr int kMean = 250;
    run(kSettle);
    std::vector<Wrench> mean(drivers.size());
    run(kMean, [&] {
      for (std::size_t arm = 0; arm < mean.size(); ++arm)
        mean[arm] += world.reading(static_cast<int>(arm)).S_F_m * (1.0 / kMean);
    });
    for (std::size_t arm = 0; arm < mean.size(); ++arm) drivers[arm].bias(mean[arm]);
  }

  World world;
  std::vector<Driver> drivers{};
  std::vector<HardwareCommand> commands{};
};

}  // namespace mrroc::sim
