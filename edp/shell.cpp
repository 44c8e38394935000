#include "edp/shell.hpp"

#include <algorithm>

#include "base/msg/convert.hpp"
#include "mrroc/step_samples_t.hpp"
#include "mrroc/world_state_t.hpp"

namespace mrroc::edp {
namespace {

using link::Group;
using link::Phase;

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
        reply_out_(process.outbox<effector_reply_t>(parameters.robot + ".reply")),
        samples_out_(process.outbox<step_samples_t>(parameters.robot + ".samples")) {}

  void run() {
    const auto guard_ends = link::Process::Clock::now() + k_.start_guard;
    process_.await([] { return false; }, guard_ends);
    if (!process_.assemble()) return;
    for (std::int64_t step = 0; !released_long_ago(); ++step) {
      if (!await_state(step)) break;
      do_step(step);
    }
    process_.report_done();
    process_.stay();
  }

 private:
  bool await_state(std::int64_t step) {
    process_.await([&] {
      return state_in_->at(step) || process_.phase() == Phase::finished || process_.dead(k_.world);
    });
    return state_in_->at(step) != nullptr;
  }

  void do_step(std::int64_t step) {
    if (driver_.at_boundary() && step > 0) begin_macrostep();
    const HardwareReading reading = from_message(state_in_->at(step)->robot[k_.index], step);
    drive_out_->publish(to_message(driver_.step(reading)), step);
    process_.report_progress(macrostep_, step);
    if (driver_.reply_due()) end_of_reading();
  }

  void begin_macrostep() {
    ++macrostep_;
    // Nobody is there to command any more: homing comes to rest as motions do.
    if (stopped(macrostep_) || process_.dead(k_.ecp)) driver_.drop_owner();
    if (stopped(macrostep_)) return;
    // That its owner leaves is the link's statement: faults made on purpose do not touch it.
    const effector_command_t* const sent = command_in_->at(macrostep_);
    if (sent && static_cast<Instruction>(sent->instruction) == Instruction::release) {
      released_ = true;
      released_in_ = macrostep_;
    }
    bool taken = false;
    command_in_->due(macrostep_, k_.injection, [&](const effector_command_t& m) {
      const EffectorCommand command = from_message(m);
      if (!taken) driver_.take(command);
      taken = true;
    });
  }

  void end_of_reading() {
    reply_out_->publish(to_message(driver_.reply()), macrostep_ + 1);
    step_samples_t samples{};
    for (const StepSample& s : driver_.samples()) samples.sample[samples.n++] = to_message(s);
    samples.last = released_ && macrostep_ == released_in_ + 1;
    samples_out_->publish(samples, macrostep_ + 1);
    if (released_ || !process_.lock_step()) return;
    const std::int64_t next = macrostep_ + 1;
    process_.await([&] {
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
  std::unique_ptr<link::Outbox<effector_reply_t>> reply_out_;
  std::unique_ptr<link::Outbox<step_samples_t>> samples_out_;
  std::int64_t macrostep_{};
  bool released_{};
  std::int64_t released_in_{};
};

}  // namespace

void run_edp(link::Process& process, Driver& driver, const ShellParameters& parameters) {
  Shell(process, driver, parameters).run();
}

}  // namespace mrroc::edp
