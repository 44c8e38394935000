// StGen of MG fig. 11: cuts a macrostep into steps of the set point.
#pragma once
#include <optional>

#include "base/effector_command.hpp"
#include "edp/control_law.hpp"
#include "edp/guard.hpp"
#include "edp/macrostep.hpp"
#include "edp/robot.hpp"
#include "edp/set_point.hpp"

namespace mrroc::edp {

/// Moves the set point step by step: by the law (28) in the task frame (TCIM), by interpolation of the motors
/// (MIM), or to rest. The set point never leaves the limits. Real-time safe.
class StepGenerator {
 public:
  /// Phase of the set point's motion.
  /// executing: a macrostep; arriving: on the way to its goal, where it comes to rest; stopping: on the way to rest.
  enum class MotionPhase : std::uint8_t { standing, executing, arriving, stopping };

  /// Stands with all motors at 0 until stand_at(). @param T_WE  tool in the wrist
  StepGenerator(const MotionRules& rules, const Pose& T_WE) noexcept;

  /// Stands at these motor positions from now on. @param motors [rad]
  void stand_at(const AxisVector& motors) noexcept;

  /// The robot works with another kinematic model from now on; the motors stay where they are. Only while the
  /// set point stands. @param robot must live longer than the generator
  void set_robot(const Robot& robot) noexcept;

  /// Whether motor positions mean anything. While they do not, only relative motor positions can be moved to,
  /// no range is checked, and joints and pose of the set point mean nothing.
  void set_position_known(bool known) noexcept { rules_.position_known = known; }

  /// Homing: moves the set motor positions by so much in this step; stop() or stand_at() end it.
  /// @param increment [rad]
  void shift(const AxisVector& increment) noexcept;

  /// Begins a macrostep, with the tool that it is meant for.
  /// @return why it is refused; then nothing has changed
  [[nodiscard]] std::optional<Fault> start(const ArmCommand& command, const Pose& T_WE) noexcept;

  /// The tool is another one from now on; the wrist stays where it is, or ends where it was told to be.
  /// @param T_WE tool in the wrist
  void set_tool(const Pose& T_WE) noexcept;

  /// From now on each axis has so much of the mobility that it is commanded. @param shares  0 < share <= 1
  void set_mobility_shares(const MobilityShares& shares) noexcept { shares_ = shares; }

  /// No command follows: the set point comes to rest at the goal of the motion. One that brakes before its goal goes on
  /// to it; one that has arrived there at speed stops as by stop() and returns. A motion without a goal stops.
  void finish() noexcept;

  /// Whatever moves stops: the speed falls smoothly to zero in stop_steps, then the set point stands. In TCIM
  /// the wrist's velocity falls, in MIM the motors'. The goal is given up; a motion of the motors (MIM) that brakes before it
  /// already, and would pass it in such a stop, comes to rest there.
  void stop() noexcept;

  /// One step of the set point.
  /// @param F_a adjusted force in E [N, N m]
  /// @return why the macrostep cannot go on: the next set point would be out of reach, too fast, or so near a
  ///         limit that the stop would not fit any more. The motors are then on their way to rest, each from
  ///         the speed it has; with too much contact force as hard as the acceleration of the motors allows.
  std::optional<Fault> step(const Wrench& F_a) noexcept;

  /// @return what the set point does after the last step
  [[nodiscard]] MotionPhase phase() const noexcept { return phase_; }
  /// @return whether the set point stands at the goal of the last motion
  [[nodiscard]] bool at_goal() const noexcept { return at_goal_; }
  /// @return as the last step has left it
  [[nodiscard]] const SetPoint& set_point() const noexcept { return set_; }
  /// @return T_WE
  [[nodiscard]] const Pose& tool() const noexcept { return T_WE_; }
  /// @return T_EW
  [[nodiscard]] const Pose& tool_inverse() const noexcept { return T_EW_; }

 private:
  /// A set point that has not been checked.
  struct Candidate {
    Pose T_0E;
    Matrix3 R_0W;
    AxisPositions axes;
    Twist v_0W;
  };
  [[nodiscard]] Twist previous_velocity() const noexcept;
  [[nodiscard]] std::optional<Fault> follow(const Twist& v_E, Candidate& next) const noexcept;
  void place(const AxisVector& motors, Candidate& next) const noexcept;
  [[nodiscard]] std::optional<Fault> execute(const Wrench& F_a, Candidate& next) noexcept;
  [[nodiscard]] std::optional<Fault> active_step(const Wrench& F_a) noexcept;
  [[nodiscard]] std::optional<Fault> passive_step() noexcept;
  [[nodiscard]] std::optional<Fault> arriving_step(const Wrench& F_a) noexcept;
  [[nodiscard]] std::optional<Fault> returning_step(const Wrench& F_a) noexcept;
  // Of a set point that moves along the motors' line. F_a: in E
  [[nodiscard]] std::optional<Fault> check_motion(const Candidate& next, const Wrench& F_a) const noexcept;
  [[nodiscard]] Beginning beginning(const Pose& T_WE) const noexcept;
  void change_tool(const Pose& T_WE) noexcept;
  [[nodiscard]] bool nearly_there() const noexcept;
  void begin_stop(int steps) noexcept;
  // The stop is over: it stands, or returns to the goal that it has passed.
  void end_stop() noexcept;
  [[nodiscard]] std::optional<Fault> check(const Candidate& next) const noexcept;
  // Whether the motors' stop that may have to follow ends within the limits, too. way: of that stop, in steps
  // of the present speed.
  [[nodiscard]] std::optional<Fault> check_stop(const Candidate& next, double way) const noexcept;
  void accept(const Candidate& next) noexcept;
  void stop_step() noexcept;
  // As hard as the acceleration of the motors allows: for a stop that leads out of the range of a joint, or
  // into a contact.
  void brake() noexcept;
  void stand() noexcept;

  MotionRules rules_;
  AxisRanges ranges_;
  Pose T_WE_;
  Pose T_EW_;
  SetPoint set_;
  Matrix3 R_0W_;  // orientation of the wrist at the set point
  Macrostep macrostep_;
  MobilityShares shares_{1, 1, 1, 1, 1, 1};
  MotionPhase phase_{MotionPhase::standing};
  std::optional<Goal>
      goal_;  // that the set point is on its way to when it is not there at the end of its macrostep
  bool at_goal_{};
  bool returning_{};  // arriving: back to the goal, along from_..to_
  AxisVector from_, to_;
  bool passive_{};    // the last step was passive
  int stop_steps_{};  // of the stop or return that goes on
  bool stop_in_motors_{};
  bool stop_at_once_{};
  int k_{};  // step of the macrostep, of the stop, or of the return
};

}  // namespace mrroc::edp
