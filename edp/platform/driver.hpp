// The whole effector driver of one platform, without any input or output (paper REX: the virtual effector e_1,1), as
// edp/driver.hpp is that of an arm.
#pragma once
#include <cstdint>
#include <optional>

#include "base/platform_command.hpp"
#include "base/platform_hardware.hpp"
#include "edp/platform/automaton.hpp"
#include "edp/platform/follow_watch.hpp"
#include "edp/platform/follower.hpp"
#include "edp/platform/fragment_queue.hpp"
#include "edp/platform/observer.hpp"
#include "edp/platform/pace.hpp"
#include "edp/platform/parameters.hpp"
#include "edp/platform/platform.hpp"
#include "edp/platform/reference.hpp"
#include "edp/platform/reference_offset.hpp"
#include "edp/platform/reply.hpp"
#include "edp/platform/stage_collector.hpp"
#include "edp/platform/supervision.hpp"
#include "edp/platform/synchronisation.hpp"
#include "edp/platform/wheel_brake.hpp"
#include "edp/protocol.hpp"
#include "edp/standstill_detector.hpp"

namespace mrroc::edp {

/// Effector driver of one platform.
///
/// Macrosteps of kPlatformSteps steps follow one another without a gap; each is one iteration of the virtual effector. At the
/// boundary, step 10 i, the command for it is taken; the estimator works in that step, the tracker in the next one, and its
/// torques stand from step 10 i + 2 on. The reply comes in step n_Q = 9 of the macrostep.
///
/// The shell's loop:
///
///     if (driver.at_boundary() && there are commands for this macrostep) driver.take(each of them);
///     send(driver.step(reading));
///     if (driver.reply_due()) publish(driver.reply(), driver.telemetry());
///
/// The table in edp/platform/automaton.hpp says which command is legal in which state, and what follows from it. The drives
/// brake (short-circuited motors) in not_synchronised, homing, ready and, once the platform stands, faulted; in executing
/// and decelerating they follow the tracker. In holding the tracker keeps the platform at the last point until it rests there; then the drives brake, until
/// the platform is to move or has been pushed away. One that has been stopped has no such point: it is to rest where it is.
///
/// SYNCHRO is executed at once in its macrostep, and goes on over the following ones: the replies tell its end by the state
/// ready. SET hands a fragment over. A refused command changes nothing. What is not numbered in a command of the owner - pace,
/// odometry, position - is used whatever becomes of the command; what is no proper number there is dropped and counted.
///
/// Without a message of its owner for PlatformDriverParameters::silence macrosteps, and when nobody owns the driver any more,
/// a platform that moves comes to rest on its way, and what was left of it is dropped. Silence is told as a fault
/// (peer_silent); SET is refused with it until it has been told and the platform holds.
///
/// A malfunction is a fatal fault, as an emergency stop is: the fragments are dropped, only reset leads on, and the drives brake
/// by torques until the wheels stand, as long as the encoders can be true (edp/platform/wheel_brake.hpp): all wheels but one
/// that is blocked or whose encoder is wrong. When the hardware is silent they are short-circuited at once.
///
/// take() and step() are real-time safe: no allocation, no lock, no exception, bounded.
class PlatformDriver {
 public:
  /// Duration of a step [s].
  static constexpr double kStep = kPlatformPeriod / kPlatformSteps;
  /// While it holds, a platform brakes within these distances of the point, and drives again beyond twice of them.
  static constexpr double kHeldPosition = 0.02;  // [m]
  static constexpr double kHeldHeading = 0.03;   // [rad]
  /// After a stop the drives brake once the platform has rested for so many macrosteps, or after the second number of them:
  /// that ends a slide, which the tracker, for which the platform is where it is to be, does not.
  static constexpr int kStoppedRest = 3;
  static constexpr int kStoppedMost = 4;
  /// An estimated speed below which the platform rests.
  static constexpr double kRestSpeed = 0.02;     // [m/s]
  static constexpr double kRestTurnRate = 0.05;  // [rad/s]

  /// @param platform  must live longer than the driver
  /// @throws FaultError bad_configuration when a parameter or a property makes no sense, with its name
  PlatformDriver(const Platform& platform, const PlatformDriverParameters& parameters);

  /// Takes a command for the macrostep that begins with the next step, as Driver::take() does; but the unnumbered parts of
  /// every message of the owner are used, the newest ones.
  void take(const PlatformCommand& command) noexcept;

  /// One step: measures, estimates, follows, supervises. @param reading  of this step
  PlatformDrive step(const PlatformReading& reading) noexcept;

  /// @return whether the next step begins a macrostep
  [[nodiscard]] bool at_boundary() const noexcept { return iota_ == 0; }
  /// @return steps of a macrostep
  [[nodiscard]] int macrostep_steps() const noexcept { return kPlatformSteps; }
  /// @return whether the step just done was n_Q: reply() and telemetry() are new. So once in every macrostep
  [[nodiscard]] bool reply_due() const noexcept { return reply_due_; }
  /// @return the last reply, as Driver::reply() has it; but what is measured and estimated is always that of its macrostep,
  ///         also when its number, verdict and fault are repeated
  [[nodiscard]] const PlatformReply& reply() const noexcept { return reply_; }
  /// @return what the driver thinks, made with the reply
  [[nodiscard]] const PlatformTelemetry& telemetry() const noexcept { return telemetry_; }
  /// @return after the last step
  [[nodiscard]] DriverState state() const noexcept { return state_; }
  /// @return when the wheels turned last, and whether the platform is at rest
  [[nodiscard]] const StandstillDetector& standstill() const noexcept { return standstill_; }
  /// @return first step after the last macrostep in which fragments were executed; 0: there was none
  [[nodiscard]] std::int64_t commanded_until() const noexcept { return commanded_until_; }
  /// @return the fault that stands: fatal, or non-fatal and not yet told; code none when there is none
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }
  /// @return which process holds the driver and which number comes next
  [[nodiscard]] const BasicProtocol<PlatformEffector>& protocol() const noexcept { return protocol_; }
  /// @return whether it has an owner, and that is another session
  [[nodiscard]] bool owned_by_another(std::int64_t session) const noexcept {
    return protocol_.owner() && *protocol_.owner() != session;
  }
  /// @return whether SYNCHRO has found where the platform is, and that is still known
  [[nodiscard]] bool synchronised() const noexcept { return position_known_; }
  /// @return what has been measured
  [[nodiscard]] const StageCollector& sensors() const noexcept { return sensors_; }
  /// @return state of the newest stage; meaningful when synchronised
  [[nodiscard]] const EstimatorResult& estimate() const noexcept { return observer_.result(); }
  /// @return where the platform is to be in this macrostep; meaningful when synchronised
  [[nodiscard]] const PathPoint& wanted() const noexcept { return reference_.front(); }

  /// The owner of the session is dead, or the operator stops the system: the driver is free for another owner, and the
  /// platform comes to rest. Call it at a boundary.
  void drop_owner() noexcept { protocol_.drop_owner(); }
  /// A malfunction that the shell has found, emergency_stop for instance: the drives brake from the next step on, and the
  /// driver is faulted until it is reset. Call it between steps.
  void trip(const Fault& fault) noexcept;

 private:
  [[nodiscard]] std::optional<Fault> execute(const PlatformCommand& command) noexcept;
  [[nodiscard]] std::optional<Fault> check(const PlatformCommand& command) const noexcept;
  [[nodiscard]] std::optional<Fault> check_state(PlatformEvent event) const noexcept;
  bool note(const PlatformCommand& command) noexcept;
  void begin_session(const PlatformCommand& command) noexcept;
  [[nodiscard]] std::int64_t next_fragment() const noexcept;  // its number, of the owner or of a new session
  void start_on(const Fragment& fragment) noexcept;

  void fire(PlatformEvent event) noexcept { state_ = transition(state_, event).next; }
  void begin_macrostep(const PlatformReading& reading) noexcept;
  void end_macrostep() noexcept;
  void reset() noexcept;
  void hear_silence() noexcept;
  void hold(bool stopped) noexcept;
  void measure(const PlatformReading& reading) noexcept;
  void locate() noexcept;
  void estimate_state() noexcept;
  void follow() noexcept;
  void settle() noexcept;
  void answer() noexcept;
  void brake() noexcept;
  [[nodiscard]] PlatformDrive drive() noexcept;
  void fail(const Fault& fault) noexcept;
  [[nodiscard]] bool moves() const noexcept {
    return state_ == DriverState::executing || state_ == DriverState::decelerating;
  }
  [[nodiscard]] bool engaged() const noexcept {
    return moves() || (state_ == DriverState::holding && !braked_);
  }

  const PlatformProperties* platform_;
  PlatformDriverParameters p_;
  StageCollector sensors_;
  PlatformSynchronisation synchronisation_;
  Observer observer_;
  Follower follower_;
  WheelSupervision supervision_;
  WheelBrake wheel_brake_;
  FragmentQueue queue_;
  Pace pace_;
  BasicProtocol<PlatformEffector> protocol_;
  StandstillDetector standstill_;

  DriverState state_{DriverState::not_synchronised};
  bool begun_{};           // the estimator has
  bool position_known_{};  // SYNCHRO has ended
  Fault fault_{};
  bool fault_told_{};  // in a reply

  std::int64_t step_{};  // of the last reading
  std::int64_t steps_done_{};
  int iota_{};  // step of the macrostep, 1..kPlatformSteps; 0 at a boundary
  std::int64_t commanded_until_{};

  StageReading stage_{};
  Reference reference_{};
  ReferenceOffset offset_;
  FollowWatch follow_watch_;
  bool followed_{};  // the tracker has given torques in this macrostep
  bool enabled_{};   // the drives follow them
  PerWheel torque_{};
  bool braked_{};   // in holding
  bool stopped_{};  // holding after a stop, not at the end of the way
  int rest_{};      // macrosteps at rest in holding
  int held_{};      // macrosteps in holding

  double wanted_pace_{1};
  std::int64_t newest_message_{};  // stamp of the one whose pace is used
  bool heard_{};                   // a message of the owner, for this macrostep
  int silent_{};                   // macrosteps without one

  bool taken_{};
  bool reset_pending_{};
  PlatformAnswer answer_{};  // to the command of the present macrostep
  bool reply_due_{};
  PlatformReply reply_{};
  PlatformTelemetry telemetry_{};
};

}  // namespace mrroc::edp
