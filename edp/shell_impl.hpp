// The shell of an effector driver as a template over the kind of driver, for the files that instantiate it.
#pragma once
#include <fmt/core.h>

#include <concepts>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "base/latency.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "base/operator.hpp"
#include "edp/guard.hpp"
#include "edp/hardware.hpp"
#include "edp/shell_parameters.hpp"
#include "edp/stepped_driver.hpp"
#include "edp/watchdog.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::edp {

/// The macrostep in which a driver tells what it has measured or thinks.
struct Moment {
  std::int64_t macrostep{};  ///< stamp of its reply
  bool waits{};              ///< it is not counted, and has no reply
  bool last{};               ///< nothing will follow
};

/// A kind of driver for the shell:
///     Effector, Driver, Format  its effector, the driver, and what is recorded of its steps;
///     Stream                    what it publishes beside the replies: made of the process and the robot's key,
///                               send(const Driver&, const Moment&) after each reply;
///     kSilence                  what a macrostep without a command means by the wall clock, in words for the log.
/// record_of(driver, reading, drive) gives a Format::Record.
template <class K>
concept ShellKind = SteppedDriver<typename K::Driver, typename K::Effector> &&
    RecordFormat<typename K::Format> &&
    requires(typename K::Stream stream, const typename K::Driver& driver,
             const typename K::Effector::Reading& reading, const typename K::Effector::Drive& drive,
             const Moment& moment) {
  stream.send(driver, moment);
  { record_of(driver, reading, drive) } -> std::same_as<typename K::Format::Record>;
  { K::kSilence } -> std::convertible_to<std::string_view>;
};

/// The links of one driver and the macrostep in which it is: what run_edp() in edp/shell.hpp says.
template <ShellKind K>
class Shell {
 public:
  using Effector = typename K::Effector;        ///< kind of the robot
  using Driver = typename K::Driver;            ///< of that effector
  using Format = typename K::Format;            ///< of its record
  using Hardware = BasicAnyHardware<Effector>;  ///< of the robot
  using Reading = typename Effector::Reading;   ///< of its sensors

  Shell(link::Process& process, Driver& driver, Hardware hardware, const ShellParameters& parameters,
        Format format)
      : process_(process),
        driver_(driver),
        hardware_(std::move(hardware)),
        k_(parameters),
        command_in_(process.inbox<CommandMessage>(parameters.robot + ".command")),
        operator_in_(process.bus(), process.route("operator"), process.context().session_id),
        reply_out_(process.outbox<ReplyMessage>(parameters.robot + ".reply")),
        stream_(process, parameters.robot),
        record_(parameters.recording, parameters.folder, parameters.robot, std::move(format), parameters.dt) {
    process.report_effector(
        static_cast<int>(driver.state()));  // so the supervisor knows that a robot is to come to rest
  }

  void run() {
    const auto guard_ends = link::Process::Clock::now() + k_.start_guard;
    process_.await([] { return false; }, guard_ends);
    if (!process_.assemble()) return;
    while (!released_long_ago() && await_reading()) do_step();
    if (process_.over() && process_.stop_as_of() == 0) record_.dump_on_abort();
    if (const auto& p = driver_.protocol(); p.repeated() + p.lost() + watchdog_.holds() > 0)
      process_.log(fmt::format("{}.command: {} repeated, {} after a lost one, {} holds without a command",
                               k_.robot, p.repeated(), p.lost(), watchdog_.holds()));
    if (const PeriodClock* const clock = hardware_.clock(); clock && clock->late().periods > 0)
      process_.log(fmt::format("{}: {}", k_.robot, to_string(clock->late())));
    if (!tripped_) process_.report_done();
    process_.stay();
  }

 private:
  using CommandMessage = link::MessageOf<typename Effector::Command>;
  using ReplyMessage = link::MessageOf<typename Effector::Reply>;

  /// Between lines about a robot that has no command [steps].
  static constexpr std::int64_t kTellHold = 500;

  /// @return whether there is a reading for the next step, which is reading_ then
  bool await_reading() {
    while (process_.phase() != link::Phase::finished) {
      const BasicReadResult<Effector> result = hardware_.read(step_);
      listen();
      if (result.status == ReadStatus::ended) return false;
      if (result.status == ReadStatus::reading) {
        watchdog_.state();
        begun_ = result.begun;
        take(result.reading);
        watch_pace();
        return true;
      }
      if (watchdog_.no_state() == Watchdog::Verdict::trip) trip();
    }
    return false;
  }

  /// Takes what has come. A hardware that waits without the link leaves that to the shell, and in lock-step a driver that
  /// waits for no command any more must hear of the end, too.
  void listen() {
    if (!process_.lock_step() || nobody_commands(macrostep_)) process_.poll();
  }

  void take(const Reading& reading) {
    reading_ = reading;
    const std::int64_t missed = reading.step - step_;
    if (missed > 0) process_.report_skipped(missed);
    lag_ += missed;
    step_ = reading.step;
  }

  /// The hardware is silent. Whatever comes from now on, the drives brake and the task ends.
  void trip() {
    Fault fault = make_fault(FaultCode::hardware_silent, "steps without a reading", -1, watchdog_.silent(),
                             k_.state_timeout);
    driver_.trip(fault);
    tripped_ = true;
    process_.report_fault(fault);
  }

  /// A robot with a clock of its own: when this host does not keep to it, the drives brake and the task ends.
  void watch_pace() {
    const PeriodClock* const clock = hardware_.clock();
    if (tripped_ || !clock || !clock->too_slow()) return;
    const Fault fault =
        make_fault(FaultCode::host_too_slow, "periods that have begun, of those that were due", -1,
                   clock->pace(), PaceWatch::kSlowest);
    driver_.trip(fault);
    tripped_ = true;
    process_.report_fault(fault);
  }

  /// The operator's emergency stop takes no way through MP: it must work when MP hangs.
  void look_for_emergency() {
    while (const auto m = operator_in_.take())
      if (m->order == static_cast<std::int32_t>(OperatorOrder::emergency_stop) && !emergency_) {
        emergency_ = true;
        driver_.trip(make_fault(FaultCode::emergency_stop, ""));
      }
  }

  void do_step() {
    look_for_emergency();
    if (!dumped_ && process_.over() && process_.stop_as_of() == 0) {
      dumped_ = true;
      record_.trigger();
    }
    if (driver_.at_boundary() && step_ > 0) pass_boundary();
    typename Effector::Drive command = driver_.step(reading_);
    command.macrostep = macrostep_ + (driver_.at_boundary() ? 1 : 0);
    hardware_.write(command);
    record_.add(record_of(driver_, reading_, command));
    process_.report_progress(macrostep_, step_);
    process_.report_effector(static_cast<int>(driver_.state()));
    report_rest();
    ++step_;
    if (driver_.reply_due()) end_of_reading();
  }

  /// After a stop. A robot that rests before the macrostep of the stop may yet be told to move.
  void report_rest() {
    if (!stopped(macrostep_)) return;
    if (stop_step_ < 0) stop_step_ = step_;
    const bool at_rest = driver_.standstill().at_rest();
    if (at_rest && !rested_) {
      process_.seal_fingerprints();
      process_.report_rest(true, driver_.standstill().stop_steps(stop_step_));
    }
    rested_ = at_rest;
  }

  /// The next macrostep begins, or in lock-step one that is not counted, without a command: in a macrostep that the others
  /// have not reached the coordinator cannot have decided what comes next. A released driver waits, too: one that leaves
  /// before the simulator has come to the end of the task would be missed there. Robots whose macrosteps are of equal length
  /// never wait so.
  void pass_boundary() {
    waits_ = process_.lock_step() && !may_be_commanded(macrostep_ + 1);
    if (waits_) return;
    if (process_.lock_step() && !released_) await_command(macrostep_ + 1);
    begin_macrostep();
  }

  /// The order that a command obeys is decided so long before the macrostep that executes it.
  [[nodiscard]] bool may_be_commanded(std::int64_t macrostep) const {
    return begun_ > macrostep - latency::kOrderToMotion || nobody_commands(macrostep);
  }

  void await_command(std::int64_t macrostep) {
    process_.await_from(command_sources_, FaultCode::peer_silent, [&] {
      return command_in_->at(macrostep) || nobody_commands(macrostep) ||
             process_.phase() == link::Phase::finished;
    });
  }

  void begin_macrostep() {
    // The steps were missed in a macrostep of the length that its command had; those that follow in a task last as long.
    const int steps = driver_.macrostep_steps();
    macrostep_ += 1 + lag_ / steps;
    lag_ %= steps;
    // Nobody is there to command any more: homing comes to rest as motions do.
    if (!orphaned_ && nobody_commands(macrostep_)) {
      orphaned_ = true;
      driver_.drop_owner();
    }
    if (stopped(macrostep_)) return;
    note_release();
    command_in_->due(macrostep_, k_.injection,
                     [&](const CommandMessage& m) { driver_.take(from_message(m)); });
    const bool commanded = command_in_->at(macrostep_) != nullptr;
    if (!process_.lock_step() && !released_ &&
        watchdog_.macrostep(commanded) == Watchdog::Verdict::decelerate && step_ >= told_at_ + kTellHold) {
      told_at_ = step_;
      process_.log(fmt::format("no command for macrostep {}: {}", macrostep_, K::kSilence));
    }
  }

  /// That its owner leaves is the link's statement: faults made on purpose do not touch it. It is the last
  /// message, and with the wall clock its macrostep may have been skipped.
  void note_release() {
    const CommandMessage* const m =
        process_.lock_step() ? command_in_->at(macrostep_) : command_in_->newest();
    if (released_ || !m || m->header.stamp > macrostep_) return;
    const typename Effector::Command command = from_message(*m);
    released_ = command.instruction == Instruction::release && !driver_.owned_by_another(command.session);
    released_in_ = macrostep_;
  }

  void end_of_reading() {
    if (!waits_) reply_out_->publish(to_message(driver_.reply()), macrostep_ + 1);
    stream_.send(driver_, {macrostep_ + 1, waits_, released_ && macrostep_ > released_in_});
    if (waits_) return;
    if (const std::filesystem::path file = record_.write(); !file.empty())
      process_.log(fmt::format("the steps before the fault are in {}", file.filename().string()));
    if (!released_ && process_.lock_step() && may_be_commanded(macrostep_ + 1)) await_command(macrostep_ + 1);
  }

  /// The macrostep after the release is the last one, so that driver and simulator end in the same step.
  [[nodiscard]] bool released_long_ago() const {
    return released_ && macrostep_ > released_in_ && driver_.at_boundary();
  }
  [[nodiscard]] bool stopped(std::int64_t macrostep) const {
    return process_.over() && macrostep >= process_.stop_as_of();
  }
  /// @return whether no command for that macrostep will come, because the system stops or its control subsystem is dead
  [[nodiscard]] bool nobody_commands(std::int64_t macrostep) const {
    return stopped(macrostep) || process_.dead(k_.ecp);
  }

  link::Process& process_;
  Driver& driver_;
  Hardware hardware_;
  ShellParameters k_;
  std::unique_ptr<link::Inbox<CommandMessage>> command_in_;
  link::Queue<operator_order_t> operator_in_;
  std::unique_ptr<link::Outbox<ReplyMessage>> reply_out_;
  typename K::Stream stream_;
  link::Sources command_sources_{command_in_.get()};
  BasicRecordFiles<Format> record_;
  Watchdog watchdog_{k_.state_timeout};
  Reading reading_{};
  std::int64_t step_{};  // the next one, or the present one while it is executed
  std::int64_t lag_{};   // skipped steps that the number of the macrostep does not contain yet
  std::int64_t macrostep_{};
  std::int64_t begun_{};        // macrosteps that all robots have, as the hardware tells
  bool waits_{};                // in a macrostep that is not counted
  std::int64_t stop_step_{-1};  // in which the stop was obeyed first
  bool rested_{};               // since then, and the supervisor knows it
  std::int64_t told_at_{-kTellHold};
  bool tripped_{};
  bool emergency_{};
  bool dumped_{};  // the record, because of a fault that stops the system at once
  bool orphaned_{};
  bool released_{};
  std::int64_t released_in_{};
};

}  // namespace mrroc::edp
