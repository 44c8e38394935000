#include "mp/options.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cstdio>
#include <limits>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/link/run_folder.hpp"

namespace mrroc::mp {
namespace {

constexpr double kMaxSpeed = 1e4;
constexpr std::uint64_t kMaxSeed = std::numeric_limits<std::int64_t>::max();  // as the configuration holds it

const Examples kExamples{
    "./run press --seed 2",
    "./run press --clock wall",
    "./run press --speed 1",
    "./run press --run-dir runs/first",
    "./run press --config runs/first/config.toml",
    "./run drawing --set task.draw_force=2",
    "./run press --processes one",
    "./run press --script orders.txt",
    "./run press --session cell",
    "./run press --url udpm://239.255.76.67:7667?ttl=1",
    "./run drawing --drawing my.svg --size 150",
    "./run drawing --load arrow.taught",
    "./run drawing --save arrow.taught",
    "./run rubik --scramble \"R U'\"",
};

double parse_speed(const std::string& text) {
  if (text == "max") return 0;
  std::size_t used = 0;
  double speed = 0;
  try {
    speed = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != text.size() || !(speed > 0) || speed > kMaxSpeed)
    throw WrongValue(fmt::format("'{}' is neither max nor a number above 0 and up to {:g}", text, kMaxSpeed));
  return speed;
}

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size() || seed > kMaxSeed)
    throw WrongValue(fmt::format("'{}' is not a whole number from 0 to {}", text, kMaxSeed));
  return seed;
}

}  // namespace

void add_task_options(CommandLine& line, TaskOptions& o) {
  line.option(
          "--seed",
          [&o](const std::string& s) {
            o.seed = parse_seed(s);
            o.seed_asked = true;
          },
          "seed of everything random (default: that of the configuration, 1)")
      .type_name("N");
  line.option(
          "--clock",
          [&o](const std::string& c) { o.clock = c == "wall" ? ClockKind::wall : ClockKind::step; },
          "step: lock-step, bit-identical (default); wall: 500 Hz of the monotonic clock")
      .one_of({"step", "wall"})
      .type_name("step|wall");
  line.option(
          "--speed",
          [&o](const std::string& s) {
            o.speed = parse_speed(s);
            o.speed_asked = true;
          },
          "simulated seconds per second in lock-step, or max (default)")
      .type_name("X|max");
  line.option("--run-dir", o.run_dir, "the run folder (default runs/TASK-TIME)").type_name("DIR");
  line.option("--config", o.config_file,
              "values over the built-in ones; the config.toml of a run: instead of them")
      .type_name("FILE");
  line.option("--set", o.settings, "sets a value of the configuration; may be repeated")
      .type_name("KEY=VALUE");
  line.option(
          "--processes",
          [&o](const std::string& p) {
            o.separate = p == "separate";
            o.separate_asked = o.separate;
          },
          "separate processes over LCM (default), or all in one")
      .one_of({"separate", "one"})
      .type_name("separate|one");
  const Option attended = line.flag("--attended", o.attended, "a person at ui_cli gives start and triggers");
  line.flag("--unattended", "the scripted operator gives them (default)").excludes(attended);
  line.option("--script", o.script, "operator input to replay: lines MACROSTEP ORDER")
      .type_name("FILE")
      .excludes(attended);
  line.flag("--view", o.view, "also show the task as a web page; prints its address");
  line.option("--session", o.session, "name for ui_cli --session (default: unique)").type_name("NAME");
  line.option("--url", o.url, "where the system talks (default: from the session's name)")
      .type_name("udpm://HOST:PORT?ttl=N");
  line.option(
          "--check", [&o](const std::string& run) { o.check = link::checked_run_folder(run); },
          "instead of a run: recompute the coordinator's orders from a run folder's log, and print "
          "what differs as JSON; `ui_cli log check` does it for all processes")
      .type_name("RUN");
}

std::string who_orders(const TaskOptions& o) {
  if (o.attended) return ", waits for the operator: `ui_cli start`";
  return o.script.empty() ? "" : ", orders from " + o.script.string();
}

int run_command_line(CommandLine& line, int argc, char** argv, const std::function<int()>& run) {
  const auto complain = [](const FaultError& e) {
    fmt::print(stderr, "{}\n", e.error_line());
    return exit_status(e.fault().code);
  };
  line.footer(
      "Exit status: 0 done; 1 fault or stopped; 2 bad usage or input, nothing was started; 3 system error.");
  if (const auto help = line.help_asked(argc, argv)) {
    fmt::print("{}", *help);
    return 0;
  }
  try {
    line.refuse_unknown_options(argc, argv);
    line.parse(argc, argv, kExamples);
    return run();
  } catch (const FaultError& e) {
    return complain(e);
  } catch (const std::exception& e) {
    return complain(FaultError(FaultCode::internal_error, e.what()));
  }
}

}  // namespace mrroc::mp
