// Measures the time from the operator's key (pause, stop, emergency stop) to the arm's reaction.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <random>
#include <thread>

#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/session.hpp"
#include "bench/latency_samples.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"
#include "bench/terminal_program.hpp"
#include "mrroc/effector_reply_t.hpp"

namespace mrroc::bench {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kKeys = 100;
constexpr int kPausesPerRun = 4;
constexpr double kApproachSpeed = 0.01;  // of the task press in its first behaviour [m/s]

/// The task press in real time, observed on its channels, and the full-screen terminal beside it.
class ObservedTask {
 public:
  explicit ObservedTask(const std::filesystem::path& folder)
      : folder_(folder),
        session_(link::unique_session_name("latency")),
        task_("press",
              {"--speed", "1", "--processes", "separate", "--session", session_, "--run-dir", folder.string(),
               "--set", "robots.arm1.record=always"},
              1min) {
    if (!task_.read_until("m = 1  approach"))
      throw FaultError(FaultCode::start_failed, "the task press did not start; look at ./run press");
    for (const auto& s : link::running_sessions())
      if (s.name == session_ && s.address) {
        bus_ = link::open_session(s);
        replies_.emplace(*bus_, link::Route{link::Group::agents, session_ + ".arm1.reply"}, s.id);
      }
    if (!bus_) throw FaultError(FaultCode::no_such_session, "the task press has no session");
    terminal_.emplace("ui_cli", std::vector<std::string>{"--session", session_});
    if (!terminal_->await("running", 5s))
      throw FaultError(FaultCode::peer_silent, "the terminal does not show the task");
  }

  TerminalProgram& terminal() { return *terminal_; }

  /// Lets the task go on, and learns when its steps are.
  void watch(std::chrono::duration<double> time) {
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
    while (Clock::now() < until) {
      bus_->wait(std::chrono::milliseconds(2));
      const auto now = Clock::now();
      while (const auto reply = replies_->take()) newest_ = {now, static_cast<double>(reply->step)};
    }
  }

  /// Call it at once after the key: only what came before it counts.
  /// @param t  not before the last watch() @return the step, with its fraction, that was executed then.
  /// A simulator that lags has not gone farther than to its next reply, so a latency may come out too long, but
  /// not too short
  [[nodiscard]] double step_at(Clock::time_point t) const {
    const double passed = std::chrono::duration<double>(t - newest_.at).count();
    return newest_.step + std::clamp(passed, 0.0, kMacrostep) / kStep;
  }

  struct Record {
    std::vector<Step> steps;
    bool done{};         // the task has come to its own end: no stop was obeyed
    std::string screen;  // what the terminal has shown since the last key
  };
  /// Waits for the end. @return every step of the run
  Record record() {
    const bool done = task_.wait() == 0;
    return {read_steps(folder_ / "arm1-steps.csv"), done, terminal_->written()};
  }

 private:
  struct Newest {
    Clock::time_point at;
    double step{};
  };

  std::filesystem::path folder_;
  std::string session_;
  TaskProcess task_;
  std::unique_ptr<link::Bus> bus_;
  std::optional<link::Queue<effector_reply_t>> replies_;
  std::optional<TerminalProgram> terminal_;
  Newest newest_;
};

/// A pause takes a tenth of the commanded velocity in its first macrostep, of which three steps have followed a third; the
/// noise of the force sensor changes it by a hundredth.
bool slower(const Step& before, const Step& now) { return speed(before, now) < 0.97 * kApproachSpeed; }

bool decelerates(const Step&, const Step& now) { return now.state == "decelerating"; }
bool brakes(const Step&, const Step& now) { return now.state == "faulted"; }

/// What the presses of one key have shown.
struct Samples {
  std::string name;
  std::vector<double> macrosteps{};
  int discarded{};
  int never{};

  void add(const Latency& l, bool without_effect, const std::string& screen) {
    if (without_effect || l.kind == Latency::Kind::never) {
      ++never;
      std::fprintf(stderr, "operator: %s had no effect; the screen since the key: %s\n", name.c_str(),
                   screen.c_str());
    } else if (l.kind == Latency::Kind::nothing_to_see) {
      ++discarded;
    } else {
      macrosteps.push_back(l.macrosteps);
    }
    if (discarded + never > kKeys)
      throw FaultError(FaultCode::peer_silent,
                       fmt::format("{}: {} keys were too late, {} without effect; leave the machine alone",
                                   name, discarded, never));
  }
};

void pause_in_one_run(std::mt19937& random, Samples& samples) {
  const ScratchFolder scratch;
  ObservedTask press(scratch.path() / "run");
  std::uniform_real_distribution<double> moment(0.2, 0.26);
  struct Pair {
    double pause{}, resume{}, next{};
  };
  std::vector<Pair> pressed;
  for (int k = 0; k < kPausesPerRun; ++k) {
    press.watch(std::chrono::duration<double>(moment(random)));
    Pair p;
    p.pause = press.step_at(press.terminal().press('p'));
    press.watch(0.4s);
    p.resume = press.step_at(press.terminal().press('r'));
    p.next = p.resume + 0.2 / kStep;
    pressed.push_back(p);
  }
  press.watch(0.2s);
  press.terminal().press('x');
  press.watch(0.05s);
  press.terminal().press('y');
  const ObservedTask::Record run = press.record();
  for (const Pair& p : pressed) {
    Latency l = latency(run.steps, p.pause, slower);
    // An arm that does not move on has met what it approaches: it may be that which has made it slower.
    if (!is_undone(run.steps, p.resume, p.next, slower)) l.kind = Latency::Kind::nothing_to_see;
    samples.add(l, false, run.screen);
  }
}

/// @param keys     all that have to be pressed, the last one is the order
void stop_one_run(std::mt19937& random, const std::string& keys, const Wanted& wanted, Samples& samples) {
  const ScratchFolder scratch;
  ObservedTask press(scratch.path() / "run");
  std::uniform_real_distribution<double> moment(0.15, 0.5);
  press.watch(std::chrono::duration<double>(moment(random)));
  double pressed = 0;
  for (const char key : keys) {
    pressed = press.step_at(press.terminal().press(key));
    press.watch(0.05s);
  }
  const ObservedTask::Record run = press.record();
  samples.add(latency(run.steps, pressed, wanted), run.done, run.screen);
}

Figure worst(const std::string& key, const Samples& samples, const std::string& wanted) {
  auto sorted = samples.macrosteps;
  std::ranges::sort(sorted);
  return {
      key, sorted.back(), "macrosteps",
      fmt::format(
          "key to decelerating set point, {} times in real time, median {:.2f}, {} keys came too late and "
          "were repeated, {} had no effect, wanted <= {}",
          sorted.size(), sorted[sorted.size() / 2], samples.discarded, samples.never, wanted)};
}

}  // namespace

Figures latency_figures() {
  std::mt19937 random(1);
  Samples pause{"pause"}, stop{"stop"}, emergency{"emergency stop"};
  while (pause.macrosteps.size() < kKeys) pause_in_one_run(random, pause);
  while (stop.macrosteps.size() < kKeys) stop_one_run(random, "xy", decelerates, stop);
  while (emergency.macrosteps.size() < kKeys) stop_one_run(random, "e", brakes, emergency);
  const int never = pause.never + stop.never + emergency.never;
  return {
      worst("pause_latency_macrosteps", pause, "4"),
      worst("stop_latency_macrosteps", stop, "2"),
      worst("emergency_stop_latency_macrosteps", emergency, "2"),
      {"keys_without_effect", static_cast<double>(never), "", "pauses and stops that never came, wanted 0"}};
}

}  // namespace mrroc::bench
