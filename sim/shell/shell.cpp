#include "sim/shell/shell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/clock.hpp"
#include "base/counted.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/simulation_control_t.hpp"
#include "sim/shell/arm_plant.hpp"
#include "sim/shell/driverless_robot.hpp"
#include "sim/shell/hands.hpp"
#include "sim/shell/platform_plant.hpp"

namespace mrroc::sim {
namespace {

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

/// A robot of one of the plants, and how its driver keeps it.
struct Robot {
  Plant* plant{};                // whose it is
  std::size_t index{};           // there
  int missed{};                  // commands in a row
  DriverlessRobot driverless{};  // counts from its driver's death on

  [[nodiscard]] const std::string& driver() const { return plant->driver(index); }
  [[nodiscard]] std::int64_t macrostep() const { return plant->macrostep(index); }
};

class Shell {
 public:
  Shell(link::Process& process, const Simulated& simulated, const ShellParameters& parameters)
      : process_(process),
        k_(parameters),
        cameras_(simulated.cameras),
        control_in_(process.inbox<simulation_control_t>("simulation.control")) {
    if (simulated.arms) {
      hands_.emplace(process, *simulated.arms, k_);
      plants_.push_back(std::make_unique<ArmPlant>(process, *simulated.arms, k_));
    }
    if (simulated.platforms)
      plants_.push_back(std::make_unique<PlatformPlant>(process, *simulated.platforms, k_));
    for (const auto& plant : plants_)
      for (std::size_t k = 0; k < plant->robots(); ++k) {
        robots_.push_back({plant.get(), k});
        command_sources_.push_back(plant->source(k));
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
      if (!process_.lock_step() && finished_in_ != 0 && all_silent()) break;
      let_go();
      const double speed = !process_.lock_step() || paused_ ? 1 : k_.speed;
      const Clock::time_point due = pacer_.next(speed, Clock::now());
      if (cameras_) cameras_->deliver(step);
      for (const auto& plant : plants_) plant->publish(step, macrostep_, begins);
      if (cameras_) cameras_->look(step);
      await_commands(step, due);
      record(step);
      watch_driverless(step);
      for (const auto& plant : plants_) plant->step();
      if (!process_.lock_step()) {
        note_lateness(due);
        watch_pace();
      }
      if (speed > 0) process_.await([] { return false; }, due);
    }
    if (process_.over() && process_.stop_as_of() == 0)
      for (const auto& plant : plants_) plant->dump_on_abort();
    end_pictures();
    if (hands_) hands_->write_sheets();
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
    for (const Robot& robot : robots_)
      if (!absent(robot)) least = std::min(least, robot.macrostep());
    if (least <= macrostep_ || least == std::numeric_limits<std::int64_t>::max()) return false;
    macrostep_ = process_.lock_step() ? macrostep_ + 1 : least;
    return true;
  }

  /// @return whether nobody drives that robot
  [[nodiscard]] bool absent(const Robot& robot) const {
    return robot.driver().empty() || process_.dead(robot.driver());
  }

  [[nodiscard]] bool all_absent() const {
    return std::ranges::all_of(robots_, [this](const Robot& robot) { return absent(robot); });
  }

  /// @return whether every driver has been silent for long
  [[nodiscard]] bool all_silent() const {
    return std::ranges::all_of(robots_, [](const Robot& robot) { return robot.missed > kLeft; });
  }

  /// Tells after a stop when the robots rest whose drivers are dead: these cannot.
  void watch_driverless(std::int64_t step) {
    int dead = 0, resting = 0, stop_steps = 0;
    for (Robot& robot : robots_) {
      if (robot.driver().empty() || !process_.dead(robot.driver())) continue;
      robot.driverless.step(step, robot.plant->encoders(robot.index), robot.plant->braked(robot.index));
      ++dead;
      resting += robot.driverless.at_rest() ? 1 : 0;
      stop_steps = std::max(stop_steps, robot.driverless.stop_steps());
    }
    const bool rest = dead > 0 && resting == dead;
    if (rest == driverless_rest_ || !process_.over()) return;
    driverless_rest_ = rest;
    process_.report_rest(rest, stop_steps);
    if (!rest || !all_absent()) return;
    for (const auto& plant : plants_) plant->publish_rest(macrostep_ + 1);
  }

  /// @return whether that driver has made its last macrostep
  [[nodiscard]] bool has_left(const Robot& robot) const {
    return finished_in_ != 0 && robot.macrostep() >= finished_in_ + kLastMacrosteps;
  }

  [[nodiscard]] bool stopped() const { return process_.over() && macrostep_ >= process_.stop_as_of(); }

  /// @return false when the task is over: in lock-step the drivers end in the same step
  bool begin_macrostep(std::int64_t step) {
    process_.report_progress(macrostep_, step);
    if (macrostep_ == 0 || finished_in_ != 0)
      return !process_.lock_step() || finished_in_ == 0 || macrostep_ < finished_in_ + kLastMacrosteps;
    if (!process_.lock_step()) {
      ask_cameras();
      if (led()) hands_->report(macrostep_);
      return true;
    }
    const auto here = [&] { return control_in_->at(macrostep_) || stopped(); };
    process_.await_from(control_sources_, FaultCode::peer_silent, here);
    if (stopped()) {
      end_pictures();  // receptors would look at more or fewer of them until the supervisor knows that all rest
      process_.seal_fingerprints();
      return true;
    }
    obey(*control_in_->at(macrostep_));
    ask_cameras();
    if (!led()) return true;
    hands_->report(macrostep_);
    process_.await_from(hands_->sources(), FaultCode::peer_silent,
                        [&] { return hands_->ordered(macrostep_) || stopped(); });
    if (!stopped()) hands_->obey(macrostep_, paused_);
    return true;
  }

  /// Cameras on demand learn whether pictures are wanted.
  void ask_cameras() {
    if (!cameras_ || cameras_->sources().empty()) return;
    if (process_.lock_step())
      process_.await_from(cameras_->sources(), FaultCode::peer_silent,
                          [&] { return cameras_->asked(macrostep_) || stopped(); });
    if (!stopped()) cameras_->obey(macrostep_);
  }

  /// With the wall clock nothing is waited for; but a clean sheet is ordered once: no order may be passed over.
  void obey_what_has_come() {
    while (const simulation_control_t* const control = control_in_->next(controlled_ + 1)) obey(*control);
    if (hands_ && !stopped()) hands_->obey_what_has_come(paused_);
  }

  void end_pictures() {
    if (cameras_) cameras_->end();
    cameras_ = nullptr;
  }

  /// At a stop a person lets go.
  void let_go() {
    if (let_go_ || !stopped()) return;
    let_go_ = true;
    if (hands_) hands_->release();
  }

  void obey(const simulation_control_t& control) {
    controlled_ = control.header.stamp;
    if (control.finished && finished_in_ == 0) finished_in_ = controlled_;
    paused_ = control.paused != 0;
    operator_ = control.hands != 0;
  }

  /// @return whether the task has a simulated operator, who leads arms
  [[nodiscard]] bool led() const { return operator_ && hands_; }

  void await_commands(std::int64_t step, Clock::time_point due) {
    const auto here = [&](const Robot& robot) {
      return robot.plant->has_command(robot.index, step) || absent(robot) || has_left(robot) ||
             process_.phase() == Phase::finished;
    };
    const auto all = [&] { return std::ranges::all_of(robots_, here); };
    if (process_.lock_step()) {
      if (all_absent()) process_.poll();  // with nobody to wait for, a stop would not be heard
      process_.await_from(command_sources_, FaultCode::peer_silent, all);
    } else {
      process_.poll();  // also when the time is over already
      const bool silent = std::ranges::any_of(robots_, [](const Robot& robot) { return robot.missed > 0; });
      if (!process_.await(all, due) && !silent) process_.await(all, due + kGrace);
    }
    for (Robot& robot : robots_) take_command(robot, step);
  }

  void take_command(Robot& robot, std::int64_t step) {
    // Of a dead driver, whatever it still sends does not count.
    if (!absent(robot) && robot.plant->take_command(robot.index, step))
      robot.missed = 0;
    else if (++robot.missed > kTimeout || process_.lock_step())
      robot.plant->brake(robot.index);  // silent driver: all drives brake
  }

  void record(std::int64_t step) {
    const bool dump = !dumped_ && process_.over() && process_.stop_as_of() == 0;
    dumped_ = dumped_ || dump;
    for (const auto& plant : plants_) plant->record(step, dump);
  }

  link::Process& process_;
  ShellParameters k_;
  CameraStation* cameras_;  // null: there are none, or no more pictures
  std::unique_ptr<link::Inbox<simulation_control_t>> control_in_;
  std::optional<Hands> hands_;  // none without arms
  std::vector<std::unique_ptr<Plant>> plants_;
  std::vector<Robot> robots_;  // of all plants
  bool dumped_{};              // the records, for a fault that stops the system
  bool driverless_rest_{};     // all whose drivers are dead, and the supervisor knows it
  bool paused_{};
  bool let_go_{};              // the hands have, at a stop
  bool operator_{};            // the task has a simulated operator
  std::int64_t macrostep_{};   // that the drivers have begun
  std::int64_t controlled_{};  // stamp of the last message on simulation.control
  std::int64_t finished_in_{};
  link::Sources control_sources_{control_in_.get()};
  link::Sources command_sources_;
  std::int64_t late_{};  // periods
  double latest_{};      // [s]
  PaceWatch pace_{kStep};
  bool too_slow_{};
  Pacer pacer_{kStep, process_.lock_step() ? Pacer::kMaxDelay : kCatchUp};
};

}  // namespace

void run_simulator(link::Process& process, const Simulated& simulated, const ShellParameters& parameters) {
  Shell(process, simulated, parameters).run();
}

}  // namespace mrroc::sim
