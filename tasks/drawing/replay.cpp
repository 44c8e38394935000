#include "tasks/drawing/replay.hpp"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "base/link/log_reader.hpp"
#include "base/msg/convert.hpp"
#include "base/script_port.hpp"
#include "mrroc/operator_image_t.hpp"
#include "tasks/drawing/program.hpp"

namespace mrroc::drawing {
namespace {

const std::array<std::string, kArms> kArmKeys{"arm1", "arm2"};

template <class M>
using Stamped = std::map<std::int64_t, M>;

/// @return whether both are the same on the wire, headers apart
template <link::FixedMessage M>
bool same(M a, M b) {
  a.header = b.header = {};
  const auto size = static_cast<std::size_t>(link::encoded_size<M>());
  std::vector<std::uint8_t> bytes_a(size), bytes_b(size);
  a.encode(bytes_a.data(), 0, static_cast<int>(size));
  b.encode(bytes_b.data(), 0, static_cast<int>(size));
  return bytes_a == bytes_b;
}

class Replay {
 public:
  Replay(const std::filesystem::path& log, const Parameters& k, const Recording& taught)
      : log_(log), k_(k), taught_(taught) {}

  ReplayResult run() {
    for (const std::string& arm : kArmKeys) agent(arm);
    coordinator();
    return result_;
  }

 private:
  template <link::FixedMessage M>
  void compare(const std::string& channel, std::int64_t stamp, const M& decided, const Stamped<M>& logged) {
    const auto it = logged.find(stamp);
    if (it == logged.end()) return;
    ++result_.macrosteps;
    if (same(decided, it->second)) return;
    ++result_.differences;
    if (result_.first.empty()) result_.first = fmt::format("{} for macrostep {}", channel, stamp);
  }

  /// The transparent agent: from its first report that it is ready to the end of the task.
  void agent(const std::string& arm) {
    const auto replies = log_.messages<effector_reply_t>(arm + ".reply");
    const auto readings = log_.messages<sensor_reading_t>(arm + ".pen_state");
    const auto orders = log_.messages<agent_order_t>(arm + ".order");
    const auto commands = log_.messages<effector_command_t>(arm + ".command");
    const auto reports = log_.messages<agent_report_t>(arm + ".report");
    for (const auto& [stamp, report] : reports) {
      const std::int64_t i = stamp - 1;
      if (!report.ready || !replies.contains(i) || !readings.contains(i) || !orders.contains(i)) continue;
      Arm::X x;
      x.i = i;
      x.e = from_message(replies.at(i));
      x.V = from_message(readings.at(i));
      x.T = from_message(orders.at(i));
      if (kTransparent.f_tau(x)) break;
      compare(arm + ".report", stamp, to_message(kTransparent.f_cT(x)), reports);
      if (!commands.contains(stamp)) continue;
      EffectorCommand command = kTransparent.f_ce(x);
      command.session = commands.at(stamp).session;  // the link's business, not the agent's
      command.number = commands.at(stamp).number;
      compare(arm + ".command", stamp, to_message(command), commands);
    }
  }

  void coordinator() {
    const auto images = log_.messages<operator_image_t>("operator.image");
    std::array<Stamped<agent_report_t>, kArms> reports;
    std::array<Stamped<agent_order_t>, kArms> orders;
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      reports[arm] = log_.messages<agent_report_t>(kArmKeys[arm] + ".report");
      orders[arm] = log_.messages<agent_order_t>(kArmKeys[arm] + ".order");
    }
    std::vector<Coordinator::X> script;
    for (std::int64_t i = 1; images.contains(i) && reports[0].contains(i) && reports[1].contains(i); ++i) {
      Coordinator::X x;
      for (std::size_t arm = 0; arm < kArms; ++arm) x.T.agent[arm] = from_message(reports[arm].at(i));
      const operator_image_t& h = images.at(i);
      x.T.h = {.trigger = h.trigger, .started = h.started != 0, .paused = h.paused != 0};
      script.push_back(x);
    }
    if (script.empty()) return;
    Coordinator::X x = script.front();
    x.i = 1;
    x.c.k = k_;
    x.c.recording = taught_;
    ScriptPort<Coordinator> port({script.begin() + 1, script.end()});
    run_program(x, port);
    std::int64_t stamp = 2;
    for (const auto& decision : port.decisions()) {
      for (std::size_t arm = 0; arm < kArms; ++arm)
        compare(kArmKeys[arm] + ".order", stamp, to_message(decision.y.T[arm]), orders[arm]);
      ++stamp;
    }
  }

  link::LogReader log_;
  Parameters k_;
  Recording taught_;
  ReplayResult result_;
};

}  // namespace

ReplayResult replay(const std::filesystem::path& log, const Parameters& parameters, const Recording& taught) {
  return Replay(log, parameters, taught).run();
}

}  // namespace mrroc::drawing
