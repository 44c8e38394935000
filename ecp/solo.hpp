// Control subsystems that work on their own (coordination "none", MG 5): the coordinator gives start and
// pause and waits until they are done.
#pragma once
#include <array>
#include <span>
#include <string>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/shell.hpp"

namespace mrroc::ecp {

/// Port of such an agent. Its i does not count macrosteps of a pause: for the rows of a table time stands
/// still.
template <Images A>
class SoloPort {
 public:
  /// @param links  must outlive the port
  explicit SoloPort(ArmLinks& links) : links_(links) {}

  /// Sends y; the coordinator is told the number of the behaviour.
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    command_ = y.e;
    report_ = y.T;
    report_.m = motion.m;
    links_.in_behaviour(motion.m, motion.name, motion.until);
    links_.send(command_, report_);
  }
  /// Waits until time goes on.
  Outcome wait() {
    Outcome o = links_.wait();
    for (; o == Outcome::terminated && paused(); ++stood_) {
      links_.send(standing(command_), report_);
      o = links_.wait();
    }
    return o;
  }
  /// Fills in e, V, T and i of x.
  void read(typename A::X& x) const {
    x.e = links_.reply();
    if constexpr (std::is_same_v<decltype(x.V), SensorReading>) x.V = links_.reading();
    x.T = links_.order();
    x.i = links_.i() - stood_;
  }
  /// @return what the port is made of, for ports that do more
  [[nodiscard]] const ArmLinks& links() const { return links_; }

 private:
  [[nodiscard]] bool paused() const { return links_.order().m == static_cast<int>(SoloOrder::pause); }

  ArmLinks& links_;
  EffectorCommand command_;
  Report report_;
  std::int64_t stood_{};
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
void run_solo_ecp(link::Process& process, const Config& config, const link::PartArguments& arguments,
                  Program program, const OtherLinks& others = {}, const std::string& sensor = {}) {
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
link::PartBody solo(const std::array<Motion<A>, n>& rows, const std::string& sensor = {}) {
  return [&rows, sensor](link::Process& process, const Config& config, const link::PartArguments& arguments) {
    const auto program = [&rows](typename A::X& x, auto& port) {
      return execute_rows<A>(std::span<const Motion<A>>(rows), x, port);
    };
    run_solo_ecp<A>(process, config, arguments, program, {}, sensor);
  };
}

}  // namespace mrroc::ecp
