#include "edp/stability_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <ostream>

#include "base/command_line.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "edp/pair_stability_command.hpp"

namespace mrroc::edp {
namespace {

/// Damping ratio that is good practice: the first peak passes the settled force by a sixth.
constexpr double kGood = 0.5;
constexpr double kWorthIt = 1.05;  // times the limit: less is no advice

std::string servo_text(const ServoModel& servo) {
  if (const auto* lag = std::get_if<LagServo>(&servo)) {
    if (lag->order == 1)
      return fmt::format("first order, lag {:.3g} ms", 1e3 / (2 * std::numbers::pi * lag->bandwidth));
    return fmt::format("second order, {:.3g} Hz, damping {:.2g}, feed-forward {:.0f} %", lag->bandwidth,
                       lag->damping, 100 * lag->feed_forward);
  }
  return std::holds_alternative<IdealServo>(servo) ? "ideal" : "drive with its regulator";
}

std::string loop_text(const ContactLoop& l) {
  return fmt::format(
      "law (28)   I = {:g} kg, B = {:g} s/kg, every {:g} ms\n"
      "servo      {}\n"
      "gears      {}\n"
      "force      {}, average of {}, {}, {} late beyond the law's own\n",
      l.inertia, l.mobility, 1e3 * l.dt, servo_text(l.servo),
      l.gears.frequency > 0
          ? fmt::format("{:g} Hz, damping {:g}, links of {:g} kg at the tip, {:g} kg beyond the sensor",
                        l.gears.frequency, l.gears.damping, l.gears.mass, l.gears.tool)
          : "rigid",
      l.mean_of_step ? "mean over its step" : "at the end of its step", l.average,
      l.low_pass > 0 ? fmt::format("low pass {:g} Hz", l.low_pass) : "no low pass", counted(l.delay, "step"));
}

std::string row_text(double K, const ContactMode& m) {
  const char* verdict = m.radius >= 1       ? "unstable"
                        : m.damping < 0.2   ? "stable, rings for long"
                        : m.damping < kGood ? "stable, overshoots"
                                            : "good";
  return fmt::format("{:>15.3g} {:>9.2f} {:>10.1f}   {}\n", K, m.damping, m.frequency, verdict);
}

/// @return stiffness up to which the damping is good, or 0
double well_damped_up_to(const ContactLoop& loop, double limit) {
  double good = 0;
  const double top = std::min(limit, 1e9);
  for (double K = top * 1e-6; K < top; K *= 1.02)
    if (contact_mode(loop, K).damping >= kGood) good = K;
  return good;
}

/// Sentences about what would make a contact of this stiffness better.
std::string advice(const ContactLoop& l, double K) {
  std::string text;
  if (const double B = mobility_for(l, K, kGood); B > 0) {
    text += fmt::format(
        "- lower B to {:.2g} s/kg: damping {:.1f} at this stiffness, guarded approach at v presses v/B", B,
        kGood);
    text += fmt::format(" ({:.3g} N at 10 mm/s)\n", 0.01 / B);
  }
  ContactLoop plain = l;
  plain.average = 1;
  plain.low_pass = 0;
  plain.delay = 0;
  if (l.average > 1 || l.low_pass > 0 || l.delay > 0)
    text += fmt::format("- without average, low pass and delay the limit would be {:.3g} N/m\n",
                        stiffness_limit(plain));
  if (const double soft = well_damped_up_to(l, stiffness_limit(l)); soft > 0 && soft < K)
    text += fmt::format("- put a spring of {:.2g} N/m in series with tool or work piece: damping {:.1f}\n",
                        soft * K / (K - soft), kGood);
  if (const auto* lag = std::get_if<LagServo>(&l.servo)) {
    LagServo faster = *lag;
    faster.bandwidth *= 1.5;
    ContactLoop quick = l;
    quick.servo = faster;
    if (const double limit = stiffness_limit(quick); limit > kWorthIt * stiffness_limit(l))
      text += fmt::format("- a servo 1.5 times as fast would raise the limit to {:.3g} N/m\n", limit);
  }
  return text;
}

struct Arguments {
  ContactLoop loop;
  std::optional<double> stiffness;
  double bandwidth{20}, lag{}, servo_damping{1}, feed_forward{1};
  bool json{}, map{}, ideal{}, sampled{}, pair{};
};

ServoModel servo_of(const Arguments& a) {
  if (a.ideal) return IdealServo{};
  if (a.lag > 0) return LagServo{1 / (2 * std::numbers::pi * a.lag), 1, 1, 0};
  return LagServo{a.bandwidth, 2, a.servo_damping, a.feed_forward};
}

void add_options(CommandLine& line, Arguments& a) {
  ContactLoop& l = a.loop;
  line.option("--I", l.inertia, "inertia of the behaviour [kg], [kg m^2]").show_default();
  line.option("--B", l.mobility, "reciprocal of its damping [s/kg], [s/(kg m^2)]").show_default();
  line.option("--K", a.stiffness, "stiffness to judge: surroundings, tool, pen in series [N/m], [N m/rad]");
  line.option("--dt", l.dt, "step of the driver [s]").show_default();
  line.option("--delay", l.delay, "steps by which the force is late beyond the law's own").show_default();
  line.option("--average", l.average, "readings in the moving average").show_default();
  line.option("--low-pass", l.low_pass, "corner of the force's low pass [Hz], 0: none").show_default();
  line.option("--contact-damping", l.contact_damping, "of the surroundings, per stiffness [s]")
      .show_default();
  const Option bandwidth =
      line.option("--bandwidth", a.bandwidth, "natural frequency of a servo of second order [Hz]")
          .show_default();
  line.option("--servo-damping", a.servo_damping, "its damping ratio").show_default();
  line.option("--feed-forward", a.feed_forward, "share of the set velocity that it is fed, 0..1")
      .show_default();
  const Option lag = line.option("--lag", a.lag, "time constant of a servo of first order instead [s]")
                         .check([](const std::string& text) {
                           if (!(std::strtod(text.c_str(), nullptr) > 0))
                             throw WrongValue("it must be more than 0 s; without any lag: --ideal");
                         });
  const Option ideal = line.flag("--ideal", a.ideal, "no servo at all: the arm is where it is set to be");
  lag.excludes(bandwidth);
  ideal.excludes(bandwidth).excludes(lag);
  line.option("--elasticity", l.gears.frequency, "mode of the gears with rotors held [Hz], 0: rigid")
      .show_default();
  line.option("--elasticity-damping", l.gears.damping, "its damping ratio").show_default();
  line.option("--link-mass", l.gears.mass, "links as felt at the tip, which swing in that mode [kg]")
      .show_default();
  line.option("--tool-mass", l.gears.tool,
              "of them beyond the force sensor, which measures its inertia, too [kg]")
      .show_default();
  line.flag("--sampled", a.sampled, "the force at the end of a step, not its mean over it");
  const Option json = line.flag("--json", a.json, "print JSON");
  line.flag("--pair", a.pair, "a pair of master and slave, with options of its own: --pair --help");
  line.flag("--map", a.map, "print the limit over I and B, for gnuplot").excludes(json);
  line.footer("\nExample: `ui_cli stability --I 20 --B 0.005 --K 1e4`\nMore: docs/stability.md");
}

}  // namespace

std::string stability_report(const ContactLoop& loop, std::optional<double> stiffness) {
  const double limit = stiffness_limit(loop);
  std::string text = loop_text(loop) + "\nstiffness [N/m]   damping   swings at [Hz]\n";
  std::vector<double> stiffnesses{1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6};
  if (stiffness) stiffnesses.push_back(*stiffness);
  std::ranges::sort(stiffnesses);
  stiffnesses.erase(std::unique(stiffnesses.begin(), stiffnesses.end()), stiffnesses.end());
  for (const double K : stiffnesses) text += row_text(K, contact_mode(loop, K));
  if (limit == 0) return text + "\nNo contact is stable with this loop.\n";
  if (std::isinf(limit)) return text + "\nContact of any stiffness is stable with this loop.\n";
  text += fmt::format("\nContact is stable below {:.3g} N/m", limit);
  if (const double good = well_damped_up_to(loop, limit); good > 0)
    text += fmt::format(", and well damped up to {:.3g} N/m", good);
  text += fmt::format("; at the limit it swings at {:.3g} Hz.\n", contact_mode(loop, limit).frequency);
  if (!stiffness) return text;
  const ContactMode m = contact_mode(loop, *stiffness);
  text += fmt::format("At {:.3g} N/m it is {} (damping {:.2f}); the limit is {:.2g} times that stiffness.\n",
                      *stiffness, m.radius < 1 ? "stable" : "UNSTABLE", m.damping, limit / *stiffness);
  if (m.damping < kGood) text += "What to change, any of:\n" + advice(loop, *stiffness);
  return text;
}

std::string stability_json(const ContactLoop& loop, std::optional<double> stiffness) {
  const double limit = stiffness_limit(loop);
  std::string text = "{\"limit_N_per_m\": " + (std::isinf(limit) ? "null" : fmt::format("{:.6g}", limit));
  if (stiffness) {
    const ContactMode m = contact_mode(loop, *stiffness);
    text += fmt::format(", \"stable\": {}, \"damping_ratio\": {:.6g}, \"frequency_Hz\": {:.6g}", m.radius < 1,
                        m.damping, m.frequency);
    const double B = mobility_for(loop, *stiffness, kGood);
    text += fmt::format(", \"B_for_damping_0.5\": {}", B > 0 ? fmt::format("{:.6g}", B) : "null");
  }
  return text + "}\n";
}

std::string stability_map(ContactLoop loop) {
  std::string text = "# I [kg]  B [s/kg]  limit [N/m]\n";
  for (double I = 0.5; I < 51; I *= std::pow(10, 0.1)) {
    for (double B = 5e-4; B < 0.051; B *= std::pow(10, 0.1)) {
      loop.inertia = I;
      loop.mobility = B;
      text += fmt::format("{:.4g} {:.4g} {:.4g}\n", I, B, stiffness_limit(loop));
    }
    text += '\n';
  }
  return text;
}

int run_stability(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  if (std::ranges::find(arguments, "--pair") != arguments.end())
    return run_pair_stability(arguments, out, err);
  Arguments a;
  CommandLine line("Which contact is stable under the force law (28), and what to change when it is not",
                   "ui_cli stability");
  add_options(line, a);
  if (const auto status = line.parse_words(arguments, out, err, {"ui_cli stability --K 20000"}))
    return *status;
  try {
    a.loop.servo = servo_of(a);
    a.loop.mean_of_step = !a.sampled;
    out << (a.map    ? stability_map(a.loop)
            : a.json ? stability_json(a.loop, a.stiffness)
                     : stability_report(a.loop, a.stiffness));
    return 0;
  } catch (const FaultError& e) {
    err << FaultError(FaultCode::bad_usage, e.what()).error_line() << std::endl;
  }
  return exit_status(FaultCode::bad_usage);
}

}  // namespace mrroc::edp
