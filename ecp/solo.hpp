// Control subsystems that work without a coordinator's orders (coordination "none", MG 5): the coordinator
// gives start and pause and waits until they are done.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "base/task_clock.hpp"
#include "ecp/generators/paced_command.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/shell.hpp"

namespace mrroc::ecp {

/// Port of such an agent. Its i counts macrosteps of task time, which the coordinator's pause slows down to zero: the rows of
/// a table are asked once in a macrostep of task time. In every macrostep the driver gets the part of their command that
/// task time has come to, and the coordinator what the agent sees.
template <Images A>
class SoloPort {
 public:
  using X = typename A::X;

  /// What an agent reads besides, and when it does not wait for task time.
  struct Others {
    /// Fills in what of x the port does not know; called after every read. Empty: nothing.
    std::function<void(X&)> read{};
    /// Whether the rows are to be asked at once, though task time stands. Empty: never.
    std::function<bool(const X&)> urgent{};
  };

  /// @param links  must outlive the port
  explicit SoloPort(ArmLinks& links) : links_(links) {}

  /// Says what is read besides, from now on. What it refers to must outlive the port.
  void also(Others others) { others_ = std::move(others); }

  /// Sends y; the coordinator is told the number of the behaviour.
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    motion_ = &motion;
    links_.in_behaviour(motion.m, motion.name, motion.until);
    if constexpr (std::is_same_v<decltype(y.V), SensorSetting>) links_.set_sensor(y.V);
    command_.begin(y.e);
    send(y.T);
  }
  /// Waits until task time has gone on by a macrostep.
  Outcome wait() {
    Outcome o = links_.wait();
    if (o == Outcome::terminated) clock_.advance(pause_ordered());
    for (; o == Outcome::terminated && !goes_on(); ++stood_) {
      read(*x_);
      if (others_.urgent && others_.urgent(*x_)) return o;
      if (leaves_behaviour(response(*motion_, *x_))) return o;
      send(transmission_of(*motion_, *x_));
      o = links_.wait();
      if (o == Outcome::terminated) clock_.advance(pause_ordered());
    }
    return o;
  }
  /// Fills in e, V, T and i of x, which must live as long as the port is used.
  void read(X& x) {
    x_ = &x;
    x.e = links_.reply();
    if constexpr (std::is_same_v<decltype(x.V), SensorReading>) x.V = links_.reading();
    x.T = links_.order();
    x.i = links_.i() - stood_;
    if (others_.read) others_.read(x);
  }
  /// @return what the port is made of, for ports that do more
  [[nodiscard]] const ArmLinks& links() const { return links_; }
  /// @return what was sent for the present macrostep and for the one before, where one of them was a part of a command;
  ///         nothing: task time goes at full pace
  [[nodiscard]] std::optional<std::array<EffectorCommand, 2>> sent_parts() const {
    if (whole_[0] && whole_[1]) return {};
    return sent_;
  }

 private:
  [[nodiscard]] bool pause_ordered() const { return links_.order().m == static_cast<int>(SoloOrder::pause); }
  [[nodiscard]] bool goes_on() const {
    return !x_ || links_.order().finished || command_.ends_within(clock_.now().pace);
  }
  void send(Report report) {
    report.m = motion_->m;
    sent_ = {command_.part(clock_.now().pace, links_.reply()), sent_[0]};
    whole_ = {command_.was_whole(), whole_[0]};
    links_.send(sent_[0], report);
  }

  ArmLinks& links_;
  Others others_;
  TaskClock clock_ = TaskClock::ramped();  // follows the coordinator's, one macrostep later
  PacedCommand command_;
  std::array<EffectorCommand, 2> sent_{};  // newest first
  std::array<bool, 2> whole_{true, true};
  const Motion<A>* motion_{};
  X* x_{};  // that of the program
  std::int64_t stood_{};
};

/// c_c of an agent that remembers one parameter of its task and nothing else; constant during a run.
/// @tparam usual  what it is unless the configuration says otherwise
template <int usual>
struct Parameter {
  double value{usual};  ///< in a unit of the task's own

  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// Executes the rows one after another, each once.
template <Images A, class Port>
Outcome execute_rows(std::span<const Motion<A>> rows, typename A::X& x, Port& port) {
  Outcome o = Outcome::terminated;
  for (std::size_t k = 0; k < rows.size() && o == Outcome::terminated; ++k) o = move(rows[k], x, port);
  return o;
}

/// Runs the ECP of an agent that works on its own, to its end.
/// @param arm      key of the arm: channels, [robots.ARM] in the configuration
/// @param program  Outcome program(X& x, SoloPort<A>& port): what the agent does
/// @param others   links that the program reads itself
/// @param sensor   whose readings are x_cV: channel ARM.SENSOR; empty: the agent has none
template <Images A, class Program>
void run_solo_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments,
                  Program program, const link::OtherLinks& others = {}, const std::string& sensor = {}) {
  using X = typename A::X;
  const auto done = [](const X& x) {
    Report r = tell<A>(x);
    r.event = kWorkDone;
    return r;
  };
  const Motion<A> wait_for_start = row<A>(
      0, "wait for start", at_rest<A>, [](const X& x) { return x.T.m == static_cast<int>(SoloOrder::work); },
      "start given");
  Motion<A> wait_for_end = row<A>(0, "done", at_rest<A>, [](const X& x) { return x.T.finished; });
  wait_for_end.f_cT = done;
  const Preparation prepare{.model = read_tool_model(config, arguments.arm)};
  const std::string readings = sensor.empty() ? sensor : arguments.arm + "." + sensor;
  run_ecp<A>(process, {.robot = arguments.arm, .sensor = readings, .others = others}, prepare,
             [&](X& x, ArmPort<A>& arm) {
               SoloPort<A> port(arm.links());
               Outcome o = move(wait_for_start, x, port);
               if (o == Outcome::terminated) o = program(x, port);
               if (o == Outcome::terminated) o = move(wait_for_end, x, port);
               return o;
             });
}

/// @param rows    of the agent's table, which must outlive the body
/// @param sensor  whose readings are x_cV: channel ARM.SENSOR; empty: the agent has none
/// @return the body of the ECP of an agent that executes them one after another
template <Images A, std::size_t n>
link::NodeMain solo(const std::array<Motion<A>, n>& rows, const std::string& sensor = {}) {
  return [&rows, sensor](link::Process& process, const Config& config, const link::NodeArguments& arguments) {
    const auto program = [&rows](typename A::X& x, auto& port) {
      return execute_rows<A>(std::span<const Motion<A>>(rows), x, port);
    };
    run_solo_ecp<A>(process, config, arguments, program, {}, sensor);
  };
}

/// @param rows  of the agent's table, which must outlive the body
/// @param read  reads from the configuration what x_cc consists of at the beginning, such as the value of a Parameter
/// @return the body of the ECP of an agent that executes them one after another
template <Images A, std::size_t n, class Value>
link::NodeMain solo(const std::array<Motion<A>, n>& rows, Value (*read)(const Config&)) {
  return [&rows, read](link::Process& process, const Config& config, const link::NodeArguments& arguments) {
    const auto program = [&](typename A::X& x, auto& port) {
      x.c = {read(config)};
      return execute_rows<A>(std::span<const Motion<A>>(rows), x, port);
    };
    run_solo_ecp<A>(process, config, arguments, program);
  };
}

}  // namespace mrroc::ecp
