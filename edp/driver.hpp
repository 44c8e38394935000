// The whole effector driver of one robot, without any input or output: EDP_MASTER, EDP_TRANS, EDP_FORCE and
// EDP_SERVO of MG fig. 11 in one object that is called once per step.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "base/effector_command.hpp"
#include "base/hardware.hpp"
#include "edp/automaton.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/encoders.hpp"
#include "edp/force_sensor.hpp"
#include "edp/homing.hpp"
#include "edp/oscillation.hpp"
#include "edp/protocol.hpp"
#include "edp/reply_builder.hpp"
#include "edp/robot.hpp"
#include "edp/servo.hpp"
#include "edp/softening.hpp"
#include "edp/standstill_detector.hpp"
#include "edp/step_generator.hpp"
#include "edp/torque_watch.hpp"

namespace mrroc::edp {

/// Effector driver of one robot.
///
/// Macrosteps follow one another without a gap. Each begins at a boundary; there the command for it is taken,
/// if there is one, and it then lasts n_s steps of that command, and one passive step more, in which the set
/// point stands, when n_Q = n_s + 1. Without a SET ARM command it lasts DriverParameters::n_s steps, and the
/// arm comes to rest and holds: at the goal of its motion, when that was a position (docs/timing.md, Arriving).
///
/// The shell's loop:
///
///     if (driver.at_boundary() && there is a command for this macrostep) driver.take(command);
///     send(driver.step(reading));
///     if (driver.reply_due()) publish(driver.reply(), driver.samples());
///
/// The table in edp/automaton.hpp says which command is legal in which state, and what follows from it. The drives brake
/// in not_synchronised and faulted, and in holding once the arm is at rest; in all other states they follow
/// the set point.
///
/// SYNCHRO is executed at once in its macrostep, and homing goes on over the following ones: the replies tell
/// its end by the state ready. It ends early, unsynchronised, when nobody owns the driver any more. Before it,
/// motor positions count from the place where the driver started, joints and poses mean nothing, and the arm
/// moves only by relative motor positions.
///
/// A refused command changes nothing: the macrostep goes on as if it had not come. A macrostep that cannot be
/// executed to its end (a limit, a singularity, too fast) brings the arm to rest and ends in the verdict
/// failed with a non-fatal fault; SET ARM is refused with that fault until the arm holds and the fault has
/// been told in a reply. A motion that asks a motor for more torque than it may give, for longer than
/// SupervisionParameters::torque_steps, ends likewise (excessive_torque), but at once and where the arm is: what it
/// pushes against is relieved, and the next motion begins at the measured pose.
///
/// A malfunction (over-current, over-speed, following error, limit switch, force sensor) is a fatal fault: the drives
/// brake, and only reset leads on, from the measured pose. A motor whose limit switch is pressed then may move away from
/// it, and no farther.
///
/// take() and step() are real-time safe: no allocation, no lock, no exception.
class Driver {
 public:
  /// Steps that a stopped arm is held by its regulators before the brakes close. They alone bring it to rest:
  /// the regulators answer the edges of the encoders with jolts of a millimetre per second.
  static constexpr int kBrakesCloseAfter = 15;
  /// The same of an arm that has been told where to come to rest: until then the regulators have made up for what the
  /// motion has left, some 0.2 mm at 0.2 m/s.
  static constexpr int kSettleAtGoal = 60;

  /// @param robot must live longer than the driver
  /// @throw FaultError bad_configuration when a parameter makes no sense, with its name
  Driver(const Robot& robot, const DriverParameters& parameters);

  /// Takes a command for the macrostep that begins with the next step; call it at a boundary, with everything
  /// that has come for this macrostep. Not called at all, it is silence; keep and release are silence too, as
  /// far as motion is concerned. The first command is executed; the protocol sees the others, a repetition for
  /// instance, and nothing more becomes of them. A call that is not at a boundary is ignored.
  void take(const EffectorCommand& command) noexcept;

  /// One step: measures, supervises, moves the set point, computes the duty cycles.
  /// @param reading of this step
  HardwareCommand step(const HardwareReading& reading) noexcept;

  /// @return whether the next step begins a macrostep
  [[nodiscard]] bool at_boundary() const noexcept { return iota_ == 0; }
  /// @return steps of the macrostep that lasts or has just ended: of its command, or of one without a command
  [[nodiscard]] int macrostep_steps() const noexcept { return n_ > 0 ? n_ : p_.n_s; }
  /// @return whether the step just done was n_Q: reply() is new. So once in every macrostep
  [[nodiscard]] bool reply_due() const noexcept { return reply_builder_.due(); }
  /// @return whether motor positions are known
  [[nodiscard]] bool synchronised() const noexcept { return position_known_; }
  /// @return the last reply. Its number is 0 and its verdict none when there was no command; measured pose,
  ///         force, state and the robot model are always there, and the fault that stands, if any. To a repeated command and
  ///         to QUERY it is the reply stored then. Its macrostep is 0: the shell stamps it.
  [[nodiscard]] const EffectorReply& reply() const noexcept { return reply_builder_.reply(); }
  /// @return readings of all steps since the reply before, the last one at the end; valid until the next step
  [[nodiscard]] std::span<const MeasuredStep> samples() const noexcept { return reply_builder_.samples(); }
  /// @return after the last step
  [[nodiscard]] DriverState state() const noexcept { return state_; }
  /// @return when the motors moved last, and whether the robot is at rest
  [[nodiscard]] const StandstillDetector& standstill() const noexcept { return standstill_; }
  /// @return first step after the last commanded macrostep; 0: there was none
  [[nodiscard]] std::int64_t commanded_until() const noexcept { return commanded_until_; }
  /// @return the fault that stands: fatal, or non-fatal and not yet told; code none when there is none
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }
  /// @return the set point: pose T_c, joints, motors. Meaningful when synchronised
  [[nodiscard]] const SetPoint& set_point() const noexcept { return generator_.set_point(); }
  /// @return which process holds the driver and which number comes next
  [[nodiscard]] const Protocol& protocol() const noexcept { return protocol_; }
  /// @return whether it has an owner, and that is another session
  [[nodiscard]] bool owned_by_another(std::int64_t session) const noexcept {
    return protocol_.owner() && *protocol_.owner() != session;
  }
  /// The owner of the session is dead, or the operator stops the system: the driver is free for another owner, and the
  /// arm comes to rest where it can, not at a goal. Call it at a boundary.
  void drop_owner() noexcept;
  /// A malfunction that the shell has found, emergency_stop for instance: the drives brake from the next step
  /// on, and the driver is faulted until it is reset. Call it between steps.
  void trip(const Fault& fault) noexcept;

 private:
  /// Measurements of a step.
  struct Measured {
    AxisVector motors;     // [rad]
    AxisVector increment;  // since the step before [encoder increments]
    double time{};         // since the step before [s]
    Pose T_0W;
    Pose T_0E;
    Wrench F_a;  // in E
  };

  [[nodiscard]] std::optional<Fault> execute(const EffectorCommand& command) noexcept;
  [[nodiscard]] std::optional<Fault> check(const EffectorCommand& command) const noexcept;
  [[nodiscard]] std::optional<Fault> check_state(const EffectorCommand& command) const noexcept;
  [[nodiscard]] std::optional<Fault> check_jaws(double distance) const noexcept;
  [[nodiscard]] std::optional<Fault> start_motion(const EffectorCommand& command, const Pose& T_WE) noexcept;
  void set_model(const RobotModel& model) noexcept;
  void start_homing() noexcept;
  void fire(Event event) noexcept { state_ = transition(state_, event).next; }
  void begin_macrostep(const HardwareReading& reading) noexcept;
  void end_macrostep() noexcept;
  void measure(const HardwareReading& reading) noexcept;
  void home(const HardwareReading& reading) noexcept;
  void believe_jaws(const HardwareReading& reading) noexcept;
  [[nodiscard]] bool home_jaws(const HardwareReading& reading) noexcept;
  void set_position_known() noexcept;
  void drive_jaws(HardwareCommand& command) noexcept;
  void reset() noexcept;
  void supervise(const HardwareReading& reading) noexcept;
  void adjust_force(const HardwareReading& reading, bool stood) noexcept;
  [[nodiscard]] DriverView view() const noexcept;
  void answer(const HardwareReading& reading) noexcept;
  void move(const HardwareReading& reading) noexcept;
  // Whether the motion has asked a motor for too much torque for too long; then the set point stands where the arm is.
  [[nodiscard]] std::optional<Fault> relieve(const HardwareReading& reading) noexcept;
  [[nodiscard]] bool moves() const noexcept {
    return state_ == DriverState::executing || state_ == DriverState::decelerating ||
           state_ == DriverState::jogging;
  }
  void stand_where_measured() noexcept;
  void fail(const Fault& fault) noexcept;
  [[nodiscard]] AxisVector gravity_feed_forward() noexcept;
  [[nodiscard]] HardwareCommand drive(const HardwareReading& reading) noexcept;
  [[nodiscard]] bool stands() const noexcept;
  void watch_standstill() noexcept;
  [[nodiscard]] bool braked() const noexcept {
    return held_steps_ > (generator_.at_goal() ? kSettleAtGoal : kBrakesCloseAfter);
  }

  const Robot* robot_;
  DriverParameters p_;
  Encoders encoders_;
  ForceSensor force_;
  StepGenerator generator_;
  OscillationObserver oscillation_;
  Softening softening_;
  Servo servo_;
  Homing homing_;
  std::optional<Gripper> gripper_;
  Protocol protocol_;
  ReplyBuilder reply_builder_;
  TorqueWatch torque_;
  StandstillDetector standstill_;
  RobotModel model_;  // what was set last; the tool is the generator's
  std::uint16_t outputs_{};

  DriverState state_{DriverState::not_synchronised};
  bool position_known_{};
  double gravity_feed_forward_share_{};  // of the gravity feed-forward that the servo is told
  Fault fault_{};
  bool fault_told_{};  // in a reply
  Measured measured_;
  std::array<std::int32_t, kMaxAxes> last_encoder_{};
  std::int64_t last_step_{};
  std::int64_t steps_done_{};

  int held_steps_{kSettleAtGoal + 1};  // since the arm came to rest
  int iota_{};                         // step of the macrostep, 1..n_; 0 at a boundary
  int n_{};                            // steps of the macrostep with the passive one
  int n_Q_{};
  std::int64_t commanded_until_{};

  bool taken_{};
  std::optional<Event> motion_event_;  // with which the macrostep begins when it has a SET ARM
  bool reset_pending_{};
  std::uint8_t leaving_{};  // motors whose limit switch has been pressed since the last reset
  bool bias_pending_{};
  TaskFrameCommand rows_;  // of the last SET ARM
  AxisSet force_axes_;     // on which they let force act; none under MIM
  Answer answer_;          // to the command of the present macrostep
};

}  // namespace mrroc::edp
