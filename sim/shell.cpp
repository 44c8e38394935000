#include "sim/shell.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "base/clock.hpp"
#include "base/hand.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "base/msg/pose_rows.hpp"
#include "edp/recorder.hpp"
#include "mrroc/cube_truth_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "mrroc/world_state_t.hpp"
#include "sim/rest_watch.hpp"
#include "tasks/rubik/cube/facelets.hpp"

namespace mrroc::sim {
namespace {

using link::Group;
using link::Phase;
using Clock = link::Process::Clock;

/// With the wall clock, a drive goes on with its last command so many steps before it brakes by itself.
constexpr int kPatience = 10;
/// With the wall clock, a driver that is silent for so many steps after the end of the task has left.
constexpr int kLeft = 100;
/// With the wall clock, time that the world has lost beyond that is not caught up: as with real drives, nothing
/// happens twice as fast.
constexpr std::chrono::milliseconds kCatchUp{10};

class Shell {
 public:
  Shell(link::Process& process, World& world, const ShellParameters& parameters, CameraStation* cameras)
      : process_(process),
        world_(world),
        k_(parameters),
        cameras_(cameras),
        state_out_(process.outbox<world_state_t>("world.state", Group::servo_state)),
        report_out_(process.outbox<hand_report_t>("hand.report")),
        order_in_(process.inbox<hand_order_t>("hand.order")),
        commands_(static_cast<std::size_t>(world.arms())),
        missed_(static_cast<std::size_t>(world.arms())),
        sheets_(static_cast<std::size_t>(world.arms())) {
    if (world_.cube()) cube_out_ = process.outbox<cube_truth_t>("cube.truth");
    for (const std::string& robot : k_.robots)
      records_.push_back(std::make_unique<edp::RecordFiles>(
          k_.folder.empty() ? edp::Recording::never : edp::Recording::on_fault, k_.folder, "world-" + robot,
          kMaxAxes, kStep));
    for (const std::string& robot : k_.robots)
      drive_in_.push_back(process.inbox<drive_command_t>(robot + ".drive", Group::servo_command));
    for (const auto& in : drive_in_) drive_sources_.push_back(in.get());
  }

  void run() {
    if (!process_.assemble()) return;
    if (cameras_) cameras_->begin();
    pacer_.begin(Clock::now());
    for (std::int64_t step = 0; process_.phase() != Phase::finished; ++step) {
      if (step % k_.n_s == 0 && !begin_macrostep(step / k_.n_s)) break;
      if (!process_.lock_step() && finished_in_ != 0 && std::ranges::min(missed_) > kLeft) break;
      const double speed = !process_.lock_step() || paused_ ? 1 : k_.speed;
      const Clock::time_point due = pacer_.next(speed, Clock::now());
      if (cameras_) cameras_->deliver(step);
      publish_state(step);
      if (cube_out_ && step % k_.n_s == 0) publish_cube(step / k_.n_s);
      if (cameras_) cameras_->look(step, world_);
      await_commands(step, due);
      record(step);
      world_.step(commands_);
      watch(step);
      if (!process_.lock_step()) note_lateness(due);
      if (speed > 0) process_.await([] { return false; }, due);
    }
    if (cameras_) cameras_->end();
    for (int arm = 0; arm < world_.arms(); ++arm) write_sheet(arm);
    if (late_ > 0)
      process_.say(fmt::format("{} periods ended late, the latest by {:.1f} ms", late_, 1e3 * latest_));
    process_.report_done();
    process_.stay();
  }

 private:
  void note_lateness(Clock::time_point due) {
    const double late = std::chrono::duration<double>(Clock::now() - due).count();
    if (late <= 0) return;
    ++late_;
    latest_ = std::max(latest_, late);
    process_.report_skipped(1);
  }

  /// @return false when the task is over: in lock-step the drivers end in the same step
  bool begin_macrostep(std::int64_t i) {
    process_.report_progress(i, i * k_.n_s);
    if (i == 0 || finished_in_ != 0)
      return !process_.lock_step() || finished_in_ == 0 || i < finished_in_ + 3;
    report_hands(i);
    const auto stopped = [&] { return process_.over() && i >= process_.stop_as_of(); };
    if (process_.lock_step())
      process_.await_from(order_sources_, FaultCode::peer_silent,
                          [&] { return order_in_->at(i) || stopped(); });
    if (stopped()) {
      for (int arm = 0; arm < world_.arms(); ++arm) world_.hand(arm).release();  // a person lets go
    } else if (process_.lock_step()) {
      obey(*order_in_->at(i));
    } else {
      // A clean sheet is ordered once: none may be passed over.
      while (const hand_order_t* const order = order_in_->next(obeyed_ + 1)) obey(*order);
    }
    return true;
  }

  void obey(const hand_order_t& order) {
    obeyed_ = order.header.stamp;
    if (order.finished && finished_in_ == 0) finished_in_ = obeyed_;
    paused_ = order.paused != 0;
    if (!finite(order)) return;  // a hand goes on with what it does
    for (int arm = 0; arm < world_.arms(); ++arm) {
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

  void report_hands(std::int64_t i) {
    hand_report_t report{};
    for (int arm = 0; arm < world_.arms(); ++arm) {
      const HandStatus s = world_.hand(arm).status();
      report.done[arm] = s.phase == HandPhase::done;
      report.progress[arm] = s.fraction;
      const auto& ink = world_.ink(arm);
      report.ink_strokes[arm] = ink.empty() ? 0 : ink.back().stroke + 1;
    }
    report_out_->publish(report, i);
  }

  void publish_state(std::int64_t step) {
    world_state_t state{};
    for (int arm = 0; arm < world_.arms(); ++arm) state.robot[arm] = to_message(world_.reading(arm));
    state_out_->publish(state, step);
  }

  void publish_cube(std::int64_t i) {
    const CubeTruth& cube = *world_.cube();
    cube_truth_t m{};
    put_rows(m.T_UC, cube.T_UC);
    for (int arm = 0; arm < std::min(world_.arms(), 2); ++arm) {
      const Vector3 middle = world_.effector(arm).inverse() * cube.T_UC.p;
      std::ranges::copy(middle, m.in_hand[arm]);
    }
    std::ranges::copy(rubik::to_facelets(cube.state), m.facelets);
    m.axis = cube.axis;
    std::ranges::copy(cube.angle, m.angle);
    std::ranges::copy(cube.torque, m.torque);
    m.squeeze = cube.squeeze;
    m.on_floor = cube.on_floor;
    cube_out_->publish(m, i);
  }

  void await_commands(std::int64_t step, Clock::time_point due) {
    const auto here = [&](std::size_t arm) {
      return drive_in_[arm]->at(step) || process_.dead(k_.drivers[arm]) ||
             process_.phase() == Phase::finished;
    };
    const auto all = [&] {
      for (std::size_t arm = 0; arm < commands_.size(); ++arm)
        if (!here(arm)) return false;
      return true;
    };
    if (process_.lock_step()) {
      process_.await_from(drive_sources_, FaultCode::peer_silent, all);
    } else {
      process_.poll();  // also when the time is over already
      process_.await(all, due);
    }
    for (std::size_t arm = 0; arm < commands_.size(); ++arm) take_command(arm, step);
  }

  void take_command(std::size_t arm, std::int64_t step) {
    const drive_command_t* const m = drive_in_[arm]->at(step);
    if (m && std::ranges::all_of(m->pwm, [](double pwm) { return std::isfinite(pwm); })) {
      commands_[arm] = from_message(*m);
      missed_[arm] = 0;
    } else if (++missed_[arm] > kPatience || process_.lock_step()) {
      commands_[arm].enabled = commands_[arm].jaws_enabled = false;  // silent driver: all drives brake
    }
  }

  /// What the drives saw and were told: the memory of a driver that dies dies with it.
  void record(std::int64_t step) {
    const bool thrown_down = !thrown_down_ && process_.over() && process_.stop_as_of() == 0;
    thrown_down_ = thrown_down_ || thrown_down;
    for (std::size_t arm = 0; arm < records_.size(); ++arm) {
      const HardwareReading reading = world_.reading(static_cast<int>(arm));
      edp::StepRecord r;
      r.step = step;
      r.encoder = reading.encoder;
      r.current = reading.current;
      r.pwm = commands_[arm].pwm;
      r.S_F_m = reading.S_F_m;
      if (thrown_down) records_[arm]->trigger();
      records_[arm]->add(r);
    }
  }

  void watch(std::int64_t step) {
    for (int arm = 0; arm < world_.arms(); ++arm) {
      const ArmTruth& truth = world_.truth(arm);
      rest_.step(arm, step, truth.tip_velocity.norm(), truth.tool_turn.norm(),
                 commands_[static_cast<std::size_t>(arm)].commanded_until);
    }
    // An arm that rests before the macrostep of the stop may yet be told to move.
    if (!process_.over() || step / k_.n_s < process_.stop_as_of()) return;
    const bool at_rest = rest_.at_rest();
    if (at_rest && !rested_) process_.report_rest(true, rest_.stop_steps(process_.stop_as_of() * k_.n_s));
    rested_ = at_rest;
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
  std::unique_ptr<link::Outbox<world_state_t>> state_out_;
  std::unique_ptr<link::Outbox<hand_report_t>> report_out_;
  std::unique_ptr<link::Outbox<cube_truth_t>> cube_out_;  // none: there is no cube
  std::unique_ptr<link::Inbox<hand_order_t>> order_in_;
  std::vector<std::unique_ptr<link::Inbox<drive_command_t>>> drive_in_;
  std::vector<std::unique_ptr<edp::RecordFiles>> records_;  // per arm
  bool thrown_down_{};                                      // the system stops at once, because of a fault
  std::vector<HardwareCommand> commands_;
  std::vector<int> missed_;
  std::vector<int> sheets_;
  std::array<HandAction, 4> actions_{};
  RestWatch rest_;
  bool rested_{};
  bool paused_{};
  std::int64_t obeyed_{};  // stamp of the last order of the hands
  std::int64_t finished_in_{};
  link::Sources order_sources_{order_in_.get()};
  link::Sources drive_sources_;
  std::int64_t late_{};  // periods
  double latest_{};      // [s]
  Pacer pacer_{kStep, process_.lock_step() ? Pacer::kPatience : kCatchUp};
};

}  // namespace

void run_world(link::Process& process, World& world, const ShellParameters& parameters,
               CameraStation* cameras) {
  Shell(process, world, parameters, cameras).run();
}

}  // namespace mrroc::sim
