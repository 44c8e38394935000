// Builds the reply of a macrostep: the measurements of its steps, and the result of its command.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/effector_command.hpp"
#include "base/hardware.hpp"
#include "edp/current_meter.hpp"
#include "edp/gripper.hpp"
#include "edp/protocol.hpp"
#include "edp/robot.hpp"
#include "edp/servo.hpp"
#include "edp/step_generator.hpp"

namespace mrroc::edp {

/// Measurements of one step.
struct MeasuredStep {
  Pose T_0E;   ///< measured
  Wrench F_a;  ///< adjusted force in E
  /// @return the same as messages have it. Real-time safe
  [[nodiscard]] StepSample sample() const noexcept;
};

/// Result of the command of a macrostep.
struct Answer {
  std::int64_t session{};                                     ///< of the command; 0: there was none
  std::int64_t number{};                                      ///< of the command
  Verdict verdict{Verdict::none};                             ///< on it
  Fault fault{};                                              ///< why it was refused or failed
  std::uint8_t parts{};                                       ///< what is got (Part)
  Representation representation{Representation::frame};       ///< of the pose
  Representation tool_representation{Representation::frame};  ///< of the tool
  Feedback feedback{Feedback::measured};                      ///< the pose is measured or set
  bool replay{};                                              ///< the stored reply is the answer
  bool store{};                                               ///< the reply is to be stored
};

/// State of a driver, for its reply. References are valid while a reply is built.
struct DriverView {
  const Robot& robot;              ///< its kinematics
  const StepGenerator& generator;  ///< set point and tool
  const Servo& servo;              ///< algorithms of its motors
  const Gripper* gripper;          ///< null: it has no jaws
  const RobotModel& model;         ///< what was set last; the tool is the generator's
  const AxisVector& motors;        ///< measured in this step [rad]
  DriverState state;               ///< of the automaton
  const Fault& fault;              ///< that stands; code none: there is none
  bool position_known;             ///< of the motors
  bool at_rest;                    ///< the robot
};

/// Builds the reply of one driver, once in each macrostep. Every function but the constructor is real-time safe.
class ReplyBuilder {
 public:
  /// Most samples between two replies: of the end of the longest macrostep, and of the longest one.
  static constexpr std::size_t kMaxSamples = 2 * kMaxSteps + 1;

  /// A step begins. The samples of the reply before are forgotten.
  /// @param reading  of the step: its currents are added to the statistics
  void begin_step(const HardwareReading& reading) noexcept {
    if (due_) count_ = 0;
    due_ = false;
    currents_.add(reading.current);
  }
  /// Adds a sample. @param T_0E, F_a  measured in this step, as MeasuredStep has them
  void add(const Pose& T_0E, const Wrench& F_a) noexcept {
    if (count_ == samples_.size()) return;
    MeasuredStep& sample = samples_[count_++];
    sample.T_0E = T_0E;
    sample.F_a = F_a;
  }
  /// Step n_Q: all but the pose that the command asks for, after add().
  /// @param reading  of the step, for inputs and analog values
  /// @param protocol  has the reply that is replayed
  void build(const DriverView& driver, const Answer& answer, const Protocol& protocol,
             const HardwareReading& reading) noexcept;
  /// After the motion of step n_Q: what is set is known only then; what is measured stays that of the step's beginning.
  /// @param protocol  stores the reply when the answer says so
  void complete(const DriverView& driver, const Answer& answer, Protocol& protocol) noexcept;

  /// @return whether the step was n_Q
  [[nodiscard]] bool due() const noexcept { return due_; }
  /// @return the last reply
  [[nodiscard]] const EffectorReply& reply() const noexcept { return reply_; }
  /// @return all since the reply before, the last one at the end; valid until the next step
  [[nodiscard]] std::span<const MeasuredStep> samples() const noexcept { return {samples_.data(), count_}; }

 private:
  EffectorReply reply_{};
  bool due_{};
  CurrentMeter currents_;
  std::array<MeasuredStep, kMaxSamples> samples_{};
  std::size_t count_{};
};

}  // namespace mrroc::edp
