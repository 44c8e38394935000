#include "edp/pair_stability_command.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <ostream>

#include "base/command_line.hpp"
#include "base/fault.hpp"

namespace mrroc::edp {
namespace {

/// What is typed, in the units in which it is typed.
struct Arguments {
  PairLoop pair;
  std::optional<double> stiffness;
  double delay_ms{};
  double bandwidth{20};
  bool asked{}, json{};
};

std::string limit_text(double limit) {
  if (limit == 0) return "no wall, not even the softest,";
  if (std::isinf(limit)) return fmt::format("any wall up to {:.0e} N/m", kStiffestWall);
  return fmt::format("walls below {:.3g} N/m", limit);
}

void add_options(CommandLine& line, Arguments& a) {
  PairLoop& p = a.pair;
  line.flag("--pair", a.asked, "a pair of master and slave (without: one arm)");
  line.option("--master-I", p.master.inertia, "inertia of the master's law [kg]").show_default();
  line.option("--master-B", p.master.mobility, "reciprocal of its damping [s/kg]").show_default();
  line.option("--slave-I", p.slave.inertia, "inertia of the slave's law [kg]").show_default();
  line.option("--slave-B", p.slave.mobility, "reciprocal of its damping [s/kg]").show_default();
  line.option("--return-rate", p.return_rate,
              "the slave returns to its place with so much times its distance [1/s]")
      .show_default();
  line.option("--smoothing", p.smoothing, "time constant of the velocity that the slave is fed [s]")
      .show_default();
  line.option("--motion-scale", p.motion_scale, "way of the slave over way of the master").show_default();
  line.option("--force-scale", p.force_scale, "force on the master over force of the slave").show_default();
  line.option("--delay", a.delay_ms, "of the channel, each way [ms]").show_default();
  line.option("--hand-K", p.hand_stiffness, "stiffness of the hand at the master [N/m]").show_default();
  line.option("--hand-D", p.hand_damping, "damping of the hand [N s/m]").show_default();
  line.option("--contact-damping", p.slave.contact_damping, "of the wall, per stiffness [s]").show_default();
  line.option("--bandwidth", a.bandwidth, "natural frequency of the servos, of second order [Hz]")
      .show_default();
  line.option("--n-s", p.n_s, "steps of a macrostep").show_default();
  line.option("--K", a.stiffness, "stiffness of a wall to judge [N/m]");
  line.flag("--json", a.json, "print JSON");
  line.footer("\nExample: `ui_cli stability --pair --delay 20 --K 1e4`\nMore: docs/stability.md");
}

}  // namespace

std::string pair_report(const PairLoop& pair, std::optional<double> stiffness) {
  const double limit = pair_stiffness_limit(pair);
  const double coupling = pair.return_rate / pair.slave.mobility;
  std::string text = fmt::format(
      "master     I = {:g} kg, B = {:g} s/kg\nslave      I = {:g} kg, B = {:g} s/kg, coupled by {:.3g} N/m\n"
      "channel    {:g} ms each way; motion times {:g}, force times {:g}; macrosteps of {:g} ms\n\n",
      pair.master.inertia, pair.master.mobility, pair.slave.inertia, pair.slave.mobility, coupling,
      1e3 * pair.delay, pair.motion_scale, pair.force_scale, 1e3 * pair.n_s * pair.slave.dt);
  text += fmt::format("Without passivity control the pair bears {}.\n", limit_text(limit));
  text +=
      fmt::format("Colgate and Schenkel (b > K T / 2: any hand, but no slave and no latency): {:.3g} N/m\n",
                  colgate_bound(pair));
  text += "\ndelay each way [ms]   largest wall [N/m]\n";
  for (const double delay : {0.0, 0.02, 0.05, 0.1, 0.2}) {
    PairLoop other = pair;
    other.delay = delay;
    const double most = pair_stiffness_limit(other);
    text +=
        fmt::format("{:>19g} {:>20}\n", 1e3 * delay, std::isinf(most) ? "any" : fmt::format("{:.3g}", most));
  }
  if (!stiffness) return text;
  text += fmt::format("\nAt {:.3g} N/m it is {}.\n", *stiffness,
                      pair_radius(pair, *stiffness) < 1 ? "stable" : "UNSTABLE");
  if (*stiffness >= limit)
    text +=
        "What to change, any of: a smaller B of the master, a smaller return rate, a smaller force or motion "
        "scale; or "
        "leave task.passivity on.\n";
  return text;
}

std::string pair_json(const PairLoop& pair, std::optional<double> stiffness) {
  const double limit = pair_stiffness_limit(pair);
  std::string text =
      fmt::format("{{\"limit_N_per_m\": {}, \"colgate_N_per_m\": {:.6g}",
                  std::isinf(limit) ? "null" : fmt::format("{:.6g}", limit), colgate_bound(pair));
  if (stiffness) text += fmt::format(", \"stable\": {}", pair_radius(pair, *stiffness) < 1);
  return text + "}\n";
}

int run_pair_stability(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Arguments a;
  CommandLine line("Which wall a pair of master and slave bears without passivity control",
                   "ui_cli stability --pair");
  add_options(line, a);
  if (const auto status = line.parse_words(arguments, out, err, {"ui_cli stability --pair --delay 20"}))
    return *status;
  try {
    a.pair.delay = 1e-3 * a.delay_ms;
    a.pair.master.servo = a.pair.slave.servo = LagServo{.bandwidth = a.bandwidth};
    out << (a.json ? pair_json(a.pair, a.stiffness) : pair_report(a.pair, a.stiffness));
    return 0;
  } catch (const FaultError& e) {
    err << FaultError(FaultCode::bad_usage, e.what()).error_line() << std::endl;
  }
  return exit_status(FaultCode::bad_usage);
}

}  // namespace mrroc::edp
