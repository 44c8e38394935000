#include "edp/shell.hpp"

#include <fmt/core.h>

#include "base/msg/convert.hpp"
#include "base/operator.hpp"
#include "edp/guard.hpp"
#include "edp/watchdog.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/step_samples_t.hpp"
#include "mrroc/world_state_t.hpp"

namespace mrroc::edp {
namespace {

using link::Group;
using link::Phase;

/// Between lines about an arm that holds for want of commands [steps].
constexpr std::int64_t kTellHold = 500;

/// The links of one driver and the macrostep in which it is.
class Shell {
 public:
  Shell(link::Process& process, Driver& driver, const ShellParameters& parameters)
      : process_(process),
        driver_(driver),
        k_(parameters),
        state_in_(process.inbox<world_state_t>("world.state", Group::servo_state)),
        drive_out_(process.outbox<drive_command_t>(parameters.robot + ".drive", Group::servo_command)),
        command_in_(process.inbox<effector_command_t>(parameters.robot + ".command")),
        operator_in_(process.bus(), process.route("operator"), process.membership().session_id),
        reply_out_(process.outbox<effector_reply_t>(parameters.robot + ".reply")),
        samples_out_(process.outbox<step_samples_t>(parameters.robot + ".samples")) {}

  void run() {
    const auto guard_ends = link::Process::Clock::now() + k_.start_guard;
    process_.await([] { return false; }, guard_ends);
    if (!process_.assemble()) return;
    while (!released_long_ago() && await_state()) do_step();
    if (process_.dead(k_.world) || (process_.over() && process_.stop_as_of() == 0)) record_.throw_down();
    if (const Protocol& p = driver_.protocol(); p.repeated() + p.lost() + watchdog_.holds() > 0)
      process_.say(fmt::format("{}.command: {} repeated, {} after a lost one, {} holds without a command",
                               k_.robot, p.repeated(), p.lost(), watchdog_.holds()));
    if (!tripped_) process_.report_done();
    process_.stay();
  }

 private:
  /// @return whether there is a state for the next step, which is state_ then
  bool await_state() {
    const bool got = process_.lock_step() ? await_next_state() : await_newest_state();
    if (!got) return false;
    const std::int64_t stamp = state_->header.stamp;
    if (stamp > step_) process_.report_skipped(stamp - step_);
    lag_ += stamp - step_;
    step_ = stamp;
    return true;
  }

  bool await_next_state() {
    process_.await_from(state_sources_, FaultCode::hardware_silent, [&] {
      return state_in_->at(step_) || process_.phase() == Phase::finished || process_.dead(k_.world);
    });
    state_ = state_in_->at(step_);
    return state_ != nullptr;
  }

  bool await_newest_state() {
    const auto newest = [&] {
      state_ = state_in_->newest();
      return state_ && state_->header.stamp >= step_;
    };
    const auto period =
        std::chrono::duration_cast<link::Process::Clock::duration>(std::chrono::duration<double>(k_.dt));
    while (process_.phase() != Phase::finished && !process_.dead(k_.world)) {
      process_.await([&] { return newest() || process_.phase() == Phase::finished; },
                     link::Process::Clock::now() + period);
      process_.poll();
      if (newest()) {
        watchdog_.state();
        return true;
      }
      if (watchdog_.no_state() == Watchdog::Verdict::trip) trip();
    }
    return false;
  }

  /// The world is silent. Whatever comes from now on, the drives brake and the task ends.
  void trip() {
    Fault fault = make_fault(FaultCode::hardware_silent, "steps without a state", -1, watchdog_.silent(),
                             k_.state_patience);
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
    if (!thrown_down_ && process_.over() && process_.stop_as_of() == 0) {
      thrown_down_ = true;
      record_.trigger();
    }
    if (driver_.at_boundary() && step_ > 0) begin_macrostep();
    const HardwareReading reading = from_message(state_->robot[k_.index], step_);
    const HardwareCommand command = driver_.step(reading);
    drive_out_->publish(to_message(command), step_);
    record_.add(record_of(driver_, reading, command));
    process_.report_progress(macrostep_, step_);
    ++step_;
    if (driver_.reply_due()) end_of_reading();
  }

  void begin_macrostep() {
    macrostep_ += 1 + lag_ / k_.n_s;
    lag_ %= k_.n_s;
    // Nobody is there to command any more: homing comes to rest as motions do.
    if (!orphaned_ && (stopped(macrostep_) || process_.dead(k_.ecp))) {
      orphaned_ = true;
      driver_.drop_owner();
    }
    if (stopped(macrostep_)) return;
    note_release();
    command_in_->due(macrostep_, k_.injection,
                     [&](const effector_command_t& m) { driver_.take(from_message(m)); });
    const bool commanded = command_in_->at(macrostep_) != nullptr;
    if (!process_.lock_step() && !released_ &&
        watchdog_.macrostep(commanded) == Watchdog::Verdict::decelerate && step_ >= told_at_ + kTellHold) {
      told_at_ = step_;
      process_.say(fmt::format("no command for macrostep {}: the arm comes to rest", macrostep_));
    }
  }

  /// That its owner leaves is the link's statement: faults made on purpose do not touch it. It is the last
  /// message, and with the wall clock its macrostep may have been skipped.
  void note_release() {
    const effector_command_t* const m =
        process_.lock_step() ? command_in_->at(macrostep_) : command_in_->newest();
    if (released_ || !m || m->header.stamp > macrostep_) return;
    released_ = from_message(*m).instruction == Instruction::release;
    released_in_ = macrostep_;
  }

  void end_of_reading() {
    reply_out_->publish(to_message(driver_.reply()), macrostep_ + 1);
    step_samples_t samples{};
    for (const MeasuredStep& s : driver_.samples()) samples.sample[samples.n++] = to_message(s.sample());
    samples.last = released_ && macrostep_ > released_in_;
    samples_out_->publish(samples, macrostep_ + 1);
    if (const std::filesystem::path file = record_.write(); !file.empty())
      process_.say(fmt::format("the steps before the fault are in {}", file.filename().string()));
    if (released_ || !process_.lock_step()) return;
    const std::int64_t next = macrostep_ + 1;
    process_.await_from(command_sources_, FaultCode::peer_silent, [&] {
      return command_in_->at(next) || stopped(next) || process_.dead(k_.ecp) ||
             process_.phase() == Phase::finished;
    });
  }

  /// The macrostep after the release is the last one, so that driver and world end in the same step.
  [[nodiscard]] bool released_long_ago() const {
    return released_ && macrostep_ > released_in_ && driver_.at_boundary();
  }
  [[nodiscard]] bool stopped(std::int64_t macrostep) const {
    return process_.over() && macrostep >= process_.stop_as_of();
  }

  link::Process& process_;
  Driver& driver_;
  ShellParameters k_;
  std::unique_ptr<link::Inbox<world_state_t>> state_in_;
  std::unique_ptr<link::Outbox<drive_command_t>> drive_out_;
  std::unique_ptr<link::Inbox<effector_command_t>> command_in_;
  link::Queue<operator_order_t> operator_in_;
  std::unique_ptr<link::Outbox<effector_reply_t>> reply_out_;
  std::unique_ptr<link::Outbox<step_samples_t>> samples_out_;
  link::Sources state_sources_{state_in_.get()};
  link::Sources command_sources_{command_in_.get()};
  RecordFiles record_{k_.recording, k_.folder, k_.robot, k_.axes, k_.dt};
  Watchdog watchdog_{k_.state_patience};
  const world_state_t* state_{};
  std::int64_t step_{};  // the next one, or the present one while it is executed
  std::int64_t lag_{};   // skipped steps that the number of the macrostep does not contain yet
  std::int64_t macrostep_{};
  std::int64_t told_at_{-kTellHold};
  bool tripped_{};
  bool emergency_{};
  bool thrown_down_{};  // the system stops at once, because of a fault
  bool orphaned_{};
  bool released_{};
  std::int64_t released_in_{};
};

}  // namespace

void run_edp(link::Process& process, Driver& driver, const ShellParameters& parameters) {
  Shell(process, driver, parameters).run();
}

}  // namespace mrroc::edp
