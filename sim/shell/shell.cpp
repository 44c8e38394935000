#include "sim/shell/shell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/clock.hpp"
#include "base/counted.hpp"
#include "base/cube/facelets.hpp"
#include "base/hand.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "base/msg/pose_rows.hpp"
#include "edp/step_record.hpp"
#include "mrroc/cube_truth_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "mrroc/simulation_control_t.hpp"
#include "sim/shell/driverless_robot.hpp"

namespace mrroc::sim {
namespace {

using link::Group;
using link::Phase;
using Clock = link::Process::Clock;

/// With the wall clock, a drive goes on with its last command so many steps before it brakes by itself.
constexpr int kTimeout = 10;
/// With the wall clock, a driver that is silent for so many steps after the end of the task has left.
constexpr int kLeft = 100;
/// Macrosteps that a driver makes after the one for which the end is announced: release, and one more.
constexpr std::int64_t kLastMacrosteps = 3;
/// With the wall clock, time that the simulator has lost beyond that is not caught up: as with real drives,
/// nothing happens twice as fast.
constexpr std::chrono::milliseconds kCatchUp{10};
/// With the wall clock, so long a command that is late is waited for once in a silence, and simulated time stands still: what
/// this host's scheduler does is no matter of the drives, which would go on with their last duty cycle.
constexpr std::chrono::milliseconds kGrace{50};

class Shell {
 public:
  Shell(link::Process& process, World& world, const ShellParameters& parameters, CameraStation* cameras)
      : process_(process),
        world_(world),
        k_(parameters),
        cameras_(cameras),
        report_out_(process.outbox<hand_report_t>("hand.report")),
        control_in_(process.inbox<simulation_control_t>("simulation.control")),
        order_in_(process.inbox<hand_order_t>("hand.order")),
        commands_(static_cast<std::size_t>(world.arms())),
        missed_(static_cast<std::size_t>(world.arms())),
        driverless_(static_cast<std::size_t>(world.arms())),
        sheets_(static_cast<std::size_t>(world.arms())) {
    if (world_.cube()) cube_out_ = process.outbox<cube_truth_t>("cube.truth");
    for (const std::string& robot : k_.robots)
      records_.push_back(std::make_unique<edp::RecordFiles>(
          k_.folder.empty() ? edp::Recording::never : edp::Recording::on_fault, k_.folder,
          "simulator-" + robot, kMaxAxes, kStep));
    for (std::size_t arm = 0; arm < k_.robots.size(); ++arm) {
      const std::string& robot = k_.robots[arm];
      // What the hardware of a robot is that is not simulated, another plant says.
      state_out_.push_back(k_.drivers[arm].empty() ? nullptr
                                                   : process.outbox<hardware_state_t>(
                                                         robot + ".hardware_state", Group::servo_state));
      command_in_.push_back(
          process.inbox<hardware_command_t>(robot + ".hardware_command", Group::servo_command));
      command_sources_.push_back(command_in_.back().get());
    }
  }

  void run() {
    if (!process_.assemble()) return;
    if (cameras_) cameras_->begin();
    pacer_.begin(Clock::now());
    for (std::int64_t step = 0; process_.phase() != Phase::finished; ++step) {
      const bool begins = step == 0 || count_macrostep();
      if (begins && !begin_macrostep(step)) break;
      if (!process_.lock_step()) obey_what_has_come();
      if (!process_.lock_step() && finished_in_ != 0 && std::ranges::min(missed_) > kLeft) break;
      let_go();
      const double speed = !process_.lock_step() || paused_ ? 1 : k_.speed;
      const Clock::time_point due = pacer_.next(speed, Clock::now());
      if (cameras_) cameras_->deliver(step);
      publish_state(step);
      if (cube_out_ && begins) publish_cube(macrostep_);
      if (cameras_) cameras_->look(step, world_);
      await_commands(step, due);
      record(step);
      watch_driverless(step);
      world_.step(commands_);
      if (!process_.lock_step()) {
        note_lateness(due);
        watch_pace();
      }
      if (speed > 0) process_.await([] { return false; }, due);
    }
    if (process_.over() && process_.stop_as_of() == 0)
      for (const auto& record : records_) record->dump_on_abort();
    if (cameras_) cameras_->end();
    for (int arm = 0; arm < world_.arms(); ++arm) write_sheet(arm);
    if (late_ > 0)
      process_.log(
          fmt::format("{} ended late, the latest by {:.1f} ms", counted(late_, "period"), 1e3 * latest_));
    if (!too_slow_) process_.report_done();
    process_.stay();
  }

 private:
  /// With the wall clock: a run far behind it ends. The simulator goes on until the arms are at rest.
  void watch_pace() {
    if (too_slow_ || process_.over()) return;
    pace_.step(Clock::now());
    too_slow_ = pace_.too_slow();
    if (too_slow_)
      process_.report_fault({.code = FaultCode::host_too_slow,
                             .value = pace_.speed(),
                             .limit = PaceWatch::kSlowest,
                             .text = "simulated seconds per second of the wall clock"});
  }

  void note_lateness(Clock::time_point due) {
    const double late = std::chrono::duration<double>(Clock::now() - due).count();
    if (late <= 0) return;
    ++late_;
    latest_ = std::max(latest_, late);
    process_.report_skipped(1);
  }

  /// The length of a macrostep belongs to a command, so the drivers count: a macrostep of the simulation begins when
  /// the last of them begins it.
  /// @return whether one begins
  bool count_macrostep() {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::size_t arm = 0; arm < commands_.size(); ++arm)
      if (!absent(arm)) least = std::min(least, commands_[arm].macrostep);
    if (least <= macrostep_ || least == std::numeric_limits<std::int64_t>::max()) return false;
    macrostep_ = process_.lock_step() ? macrostep_ + 1 : least;
    return true;
  }

  /// @return whether nobody drives that arm
  [[nodiscard]] bool absent(std::size_t arm) const {
    return k_.drivers[arm].empty() || process_.dead(k_.drivers[arm]);
  }

  /// Tells after a stop when the robots rest whose drivers are dead: these cannot.
  void watch_driverless(std::int64_t step) {
    int dead = 0, resting = 0, stop_steps = 0;
    for (std::size_t arm = 0; arm < driverless_.size(); ++arm) {
      if (k_.drivers[arm].empty() || !process_.dead(k_.drivers[arm])) continue;
      DriverlessRobot& robot = driverless_[arm];
      robot.step(step, world_.reading(static_cast<int>(arm)), !commands_[arm].enabled);
      ++dead;
      resting += robot.at_rest() ? 1 : 0;
      stop_steps = std::max(stop_steps, robot.stop_steps());
    }
    const bool rest = dead > 0 && resting == dead;
    if (rest == driverless_rest_ || !process_.over()) return;
    driverless_rest_ = rest;
    process_.report_rest(rest, stop_steps);
  }

  /// @return whether that driver has made its last macrostep
  [[nodiscard]] bool has_left(std::size_t arm) const {
    return finished_in_ != 0 && commands_[arm].macrostep >= finished_in_ + kLastMacrosteps;
  }

  [[nodiscard]] bool stopped() const { return process_.over() && macrostep_ >= process_.stop_as_of(); }

  /// @return false when the task is over: in lock-step the drivers end in the same step
  bool begin_macrostep(std::int64_t step) {
    process_.report_progress(macrostep_, step);
    if (macrostep_ == 0 || finished_in_ != 0)
      return !process_.lock_step() || finished_in_ == 0 || macrostep_ < finished_in_ + kLastMacrosteps;
    if (!process_.lock_step()) {
      if (hands_) report_hands();
      return true;
    }
    const auto here = [&] { return control_in_->at(macrostep_) || stopped(); };
    process_.await_from(control_sources_, FaultCode::peer_silent, here);
    if (stopped()) return true;
    obey(*control_in_->at(macrostep_));
    if (!hands_) return true;
    report_hands();
    process_.await_from(order_sources_, FaultCode::peer_silent,
                        [&] { return order_in_->at(macrostep_) || stopped(); });
    if (!stopped()) obey(*order_in_->at(macrostep_));
    return true;
  }

  /// With the wall clock nothing is waited for; but a clean sheet is ordered once: no order may be passed over.
  void obey_what_has_come() {
    while (const simulation_control_t* const control = control_in_->next(controlled_ + 1)) obey(*control);
    if (!stopped())
      while (const hand_order_t* const order = order_in_->next(obeyed_ + 1)) obey(*order);
  }

  /// At a stop a person lets go.
  void let_go() {
    if (let_go_ || !stopped()) return;
    let_go_ = true;
    for (int arm = 0; arm < world_.arms(); ++arm) world_.hand(arm).release();
  }

  void obey(const simulation_control_t& control) {
    controlled_ = control.header.stamp;
    if (control.finished && finished_in_ == 0) finished_in_ = controlled_;
    paused_ = control.paused != 0;
    hands_ = control.hands != 0;
  }

  void obey(const hand_order_t& order) {
    obeyed_ = order.header.stamp;
    if (!finite(order)) return;  // a hand goes on with what it does
    for (int arm = 0; arm < led_arms(); ++arm) {
      Hand& hand = world_.hand(arm);
      if (order.new_sheet[arm]) {
        write_sheet(arm);
        world_.new_sheet(arm);
      }
      const auto action = static_cast<HandAction>(order.action[arm]);
      auto& last = actions_[static_cast<std::size_t>(arm)];
      if (action != last) {  // a number that is no action leads nowhere
        last = action;
        if (action == HandAction::release) hand.release();
        if (action == HandAction::lead_along) hand.lead_along(k_.strokes);
        if (action == HandAction::lead_to) hand.lead_to({order.x[arm], order.y[arm]}, order.height[arm]);
      }
      hand.pause(paused_);
    }
  }

  /// @return arms for which the messages of the hands have room
  [[nodiscard]] int led_arms() const {
    return std::min(world_.arms(), static_cast<int>(std::size(hand_order_t{}.action)));
  }

  void report_hands() {
    hand_report_t report{};
    for (int arm = 0; arm < led_arms(); ++arm) {
      const HandStatus s = world_.hand(arm).status();
      report.done[arm] = s.phase == HandPhase::done;
      report.progress[arm] = s.fraction;
      const auto& ink = world_.ink(arm);
      report.ink_strokes[arm] = ink.empty() ? 0 : ink.back().stroke + 1;
    }
    report_out_->publish(report, macrostep_);
  }

  void publish_state(std::int64_t step) {
    for (int arm = 0; arm < world_.arms(); ++arm) {
      const auto& out = state_out_[static_cast<std::size_t>(arm)];
      if (!out) continue;
      hardware_state_t state = to_message(world_.reading(arm));
      state.begun = macrostep_ + 1;
      out->publish(state, step);
    }
  }

  void publish_cube(std::int64_t i) {
    const CubeTruth& cube = *world_.cube();
    cube_truth_t m{};
    put_rows(m.T_UC, cube.T_UC);
    for (int arm = 0; arm < std::min(world_.arms(), 2); ++arm) {
      const Vector3 middle = world_.effector(arm).inverse() * cube.T_UC.p;
      std::ranges::copy(middle, m.in_hand[arm]);
    }
    std::ranges::copy(cube::to_facelets(cube.state), m.facelets);
    m.axis = cube.axis;
    std::ranges::copy(cube.angle, m.angle);
    std::ranges::copy(cube.torque, m.torque);
    m.squeeze = cube.squeeze;
    m.on_floor = cube.on_floor;
    cube_out_->publish(m, i);
  }

  void await_commands(std::int64_t step, Clock::time_point due) {
    const auto here = [&](std::size_t arm) {
      return command_in_[arm]->at(step) || absent(arm) || has_left(arm) ||
             process_.phase() == Phase::finished;
    };
    const auto all = [&] {
      for (std::size_t arm = 0; arm < commands_.size(); ++arm)
        if (!here(arm)) return false;
      return true;
    };
    if (process_.lock_step()) {
      process_.await_from(command_sources_, FaultCode::peer_silent, all);
    } else {
      process_.poll();  // also when the time is over already
      const bool silent = std::ranges::any_of(missed_, [](int missed) { return missed > 0; });
      if (!process_.await(all, due) && !silent) process_.await(all, due + kGrace);
    }
    for (std::size_t arm = 0; arm < commands_.size(); ++arm) take_command(arm, step);
  }

  void take_command(std::size_t arm, std::int64_t step) {
    const hardware_command_t* const m =
        absent(arm) ? nullptr : command_in_[arm]->at(step);  // whatever it still sends
    if (m && std::ranges::all_of(m->pwm, [](double pwm) { return std::isfinite(pwm); })) {
      commands_[arm] = from_message(*m);
      missed_[arm] = 0;
    } else if (++missed_[arm] > kTimeout || process_.lock_step()) {
      commands_[arm].enabled = commands_[arm].jaws_enabled = false;  // silent driver: all drives brake
    }
  }

  /// Records the drives' readings and commands: the memory of a driver that dies dies with it.
  void record(std::int64_t step) {
    const bool dump = !dumped_ && process_.over() && process_.stop_as_of() == 0;
    dumped_ = dumped_ || dump;
    for (std::size_t arm = 0; arm < records_.size(); ++arm) {
      const HardwareReading reading = world_.reading(static_cast<int>(arm));
      edp::StepRecord r;
      r.step = step;
      r.encoder = reading.encoder;
      r.current = reading.current;
      r.pwm = commands_[arm].pwm;
      r.S_F_m = reading.S_F_m;
      if (dump) records_[arm]->trigger();
      records_[arm]->add(r);
    }
  }

  void write_sheet(int arm) {
    if (k_.folder.empty()) return;
    const auto n = sheets_[static_cast<std::size_t>(arm)]++;
    std::ofstream file(k_.folder /
                       fmt::format("{}-sheet-{}.csv", k_.robots[static_cast<std::size_t>(arm)], n));
    file << "stroke,t,x,y\n";
    for (const InkPoint& p : world_.ink(arm))
      file << fmt::format("{},{:.3f},{:.5f},{:.5f}\n", p.stroke, p.t, p.x, p.y);
  }

  link::Process& process_;
  World& world_;
  ShellParameters k_;
  CameraStation* cameras_;
  std::vector<std::unique_ptr<link::Outbox<hardware_state_t>>> state_out_;  // per arm; null: not simulated
  std::unique_ptr<link::Outbox<hand_report_t>> report_out_;
  std::unique_ptr<link::Outbox<cube_truth_t>> cube_out_;  // none: there is no cube
  std::unique_ptr<link::Inbox<simulation_control_t>> control_in_;
  std::unique_ptr<link::Inbox<hand_order_t>> order_in_;
  std::vector<std::unique_ptr<link::Inbox<hardware_command_t>>> command_in_;
  std::vector<std::unique_ptr<edp::RecordFiles>> records_;  // per arm
  bool dumped_{};                                           // the records, for a fault that stops the system
  std::vector<HardwareCommand> commands_;
  std::vector<int> missed_;
  std::vector<DriverlessRobot> driverless_;  // per arm; counts from its driver's death on
  bool driverless_rest_{};                   // all whose drivers are dead, and the supervisor knows it
  std::vector<int> sheets_;
  std::array<HandAction, 4> actions_{};
  bool paused_{};
  bool let_go_{};              // the hands have, at a stop
  bool hands_{};               // the task has a simulated operator
  std::int64_t macrostep_{};   // that the drivers have begun
  std::int64_t controlled_{};  // stamp of the last message on simulation.control
  std::int64_t obeyed_{};      // stamp of the last order of the hands
  std::int64_t finished_in_{};
  link::Sources control_sources_{control_in_.get()};
  link::Sources order_sources_{order_in_.get()};
  link::Sources command_sources_;
  std::int64_t late_{};  // periods
  double latest_{};      // [s]
  PaceWatch pace_{kStep};
  bool too_slow_{};
  Pacer pacer_{kStep, process_.lock_step() ? Pacer::kMaxDelay : kCatchUp};
};

}  // namespace

void run_simulator(link::Process& process, World& world, const ShellParameters& parameters,
                   CameraStation* cameras) {
  Shell(process, world, parameters, cameras).run();
}

}  // namespace mrroc::sim
