// How long an arm goes on after the operator has pressed a key: pause, stop, emergency stop.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <sstream>
#include <thread>

#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/session.hpp"
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
constexpr double kStep = 0.002;          // [s]
constexpr double kMacrostep = 0.02;      // [s]
constexpr double kApproachSpeed = 0.01;  // of the task press in its first behaviour [m/s]

/// One line of the driver's record of every step.
struct Step {
  std::int64_t k{};
  std::string state;
  std::array<double, 3> set{};  // set position of E [m]
};

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) found.push_back(field);
  return found;
}

std::vector<Step> read_steps(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const auto header = fields(line);
  const auto column = [&](const char* name) { return std::ranges::find(header, name) - header.begin(); };
  const auto x = static_cast<std::size_t>(column("set_x"));
  std::vector<Step> steps;
  while (std::getline(in, line)) {
    const auto field = fields(line);
    if (field.size() != header.size()) continue;
    steps.push_back({std::stoll(field[0]),
                     field[2],
                     {std::stod(field[x]), std::stod(field[x + 1]), std::stod(field[x + 2])}});
  }
  return steps;
}

double speed(const Step& a, const Step& b) {
  double sum = 0;
  for (std::size_t l = 0; l < 3; ++l) sum += std::pow(b.set[l] - a.set[l], 2);
  return std::sqrt(sum) / kStep;
}

/// The task press in real time, watched on its channels, and the full-screen terminal beside it.
class Watched {
 public:
  explicit Watched(const std::filesystem::path& folder)
      : folder_(folder),
        session_(link::unique_session_name("latency")),
        task_("press", {"--speed", "1", "--processes", "separate", "--session", session_, "--run-dir",
                        folder.string(), "--set", "robots.arm1.record=always"}) {
    if (!task_.read_until("m = 1  approach"))
      throw FaultError(FaultCode::start_failed, "the task press did not start; look at ./run press");
    for (const auto& s : link::running_sessions())
      if (s.name == session_ && s.address) {
        bus_ = link::open_lcm(*s.address);
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
      while (const auto reply = replies_->take()) {
        const double begun = seconds(now) - static_cast<double>(reply->step) * kStep;
        begun_ = std::min(begun_, begun);
      }
    }
  }

  /// @return the step, with its fraction, that was executed then
  [[nodiscard]] double step_at(Clock::time_point t) const { return (seconds(t) - begun_) / kStep; }

  /// Waits for the end. @return every step of the run
  std::vector<Step> steps() {
    task_.wait();
    return read_steps(folder_ / "arm1-steps.csv");
  }

 private:
  static double seconds(Clock::time_point t) {
    return std::chrono::duration<double>(t.time_since_epoch()).count();
  }

  std::filesystem::path folder_;
  std::string session_;
  TaskProcess task_;
  std::unique_ptr<link::Bus> bus_;
  std::optional<link::Queue<effector_reply_t>> replies_;
  std::optional<TerminalProgram> terminal_;
  double begun_{std::numeric_limits<double>::infinity()};  // [s] of step 0
};

/// @return macrosteps from the key to the first step that is as wanted; infinite without one
double latency(const std::vector<Step>& steps, double pressed,
               const std::function<bool(const Step& before, const Step& now)>& wanted) {
  for (std::size_t k = 1; k < steps.size(); ++k) {
    if (static_cast<double>(steps[k].k) < pressed) continue;
    if (wanted(steps[k - 1], steps[k]))
      return (static_cast<double>(steps[k].k) - pressed) * kStep / kMacrostep;
  }
  return std::numeric_limits<double>::infinity();
}

/// The speed along the way drops at once by a seventh when the velocity that is commanded becomes zero; the noise of
/// the force sensor changes it by a hundredth.
bool slower(const Step& before, const Step& now) { return speed(before, now) < 0.95 * kApproachSpeed; }

bool decelerates(const Step&, const Step& now) { return now.state == "decelerating"; }
bool brakes(const Step&, const Step& now) { return now.state == "faulted"; }

using Latencies = std::vector<double>;

void pause_in_one_run(std::mt19937& random, Latencies& found) {
  const ScratchFolder scratch;
  Watched press(scratch.path() / "run");
  std::uniform_real_distribution<double> moment(0.2, 0.26);
  std::vector<double> pressed;
  for (int k = 0; k < kPausesPerRun; ++k) {
    press.watch(std::chrono::duration<double>(moment(random)));
    const auto at = press.terminal().press('p');
    press.watch(0.4s);
    pressed.push_back(press.step_at(at));
    press.terminal().press('r');
  }
  press.watch(0.1s);
  press.terminal().press('x');
  press.watch(0.05s);
  press.terminal().press('y');
  const auto steps = press.steps();
  for (const double p : pressed) found.push_back(latency(steps, p, slower));
}

/// @param keys     all that have to be pressed, the last one is the order
void stop_one_run(std::mt19937& random, const std::string& keys,
                  const std::function<bool(const Step&, const Step&)>& wanted, Latencies& found) {
  const ScratchFolder scratch;
  Watched press(scratch.path() / "run");
  std::uniform_real_distribution<double> moment(0.15, 0.5);
  press.watch(std::chrono::duration<double>(moment(random)));
  Clock::time_point at;
  for (const char key : keys) {
    at = press.terminal().press(key);
    press.watch(0.05s);
  }
  const double pressed = press.step_at(at);
  found.push_back(latency(press.steps(), pressed, wanted));
}

Figure worst(const std::string& key, const Latencies& l, const std::string& wanted) {
  auto sorted = l;
  std::ranges::sort(sorted);
  return {key, sorted.back(), "macrosteps",
          fmt::format("key to decelerating set point, {} times in real time, median {:.2f}, wanted <= {}",
                      sorted.size(), sorted[sorted.size() / 2], wanted)};
}

}  // namespace

Figures latency_figures() {
  std::mt19937 random(1);
  Latencies pause, stop, emergency;
  while (pause.size() < kKeys) pause_in_one_run(random, pause);
  while (stop.size() < kKeys) stop_one_run(random, "xy", decelerates, stop);
  while (emergency.size() < kKeys) stop_one_run(random, "e", brakes, emergency);
  return {worst("pause_latency_macrosteps", pause, "4"), worst("stop_latency_macrosteps", stop, "2"),
          worst("emergency_stop_latency_macrosteps", emergency, "2")};
}

}  // namespace mrroc::bench
