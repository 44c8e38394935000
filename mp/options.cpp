#include "mp/options.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cstdio>
#include <limits>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/link/run_folder.hpp"
#include "base/print.hpp"
#include "base/signals.hpp"
#include "base/standard_files.hpp"

namespace mrroc::mp {
namespace {

constexpr double kMaxSpeed = 1e4;
constexpr double kMaxTime = 1e6;                                              // [s]
constexpr std::uint64_t kMaxSeed = std::numeric_limits<std::int64_t>::max();  // as the configuration holds it

// Of the options that every task has.
const Examples kExamples{
    "./run press --seed 2",
    "./run press --clock wall",
    "./run press --speed 1",
    "./run press --run-dir runs/first",
    "./run press --config runs/first/config.toml",
    "./run press --set task.force=8",
    "./run press --processes one",
    "./run press --script orders.txt",
    "./run press --script orders.txt --max-time 60",
    "./run press --parameters --json",
    "./run press --session cell",
    "./run press --config cell.toml --host \"robot=ssh robot\"",
    "./run press --url udpm://239.255.76.67:7667?ttl=1",
};

/// @return the number, if the whole text is one above 0 and up to the limit
std::optional<double> positive(const std::string& text, double limit) {
  std::size_t used = 0;
  double number = 0;
  try {
    number = std::stod(text, &used);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (used != text.size() || !(number > 0) || number > limit) return std::nullopt;
  return number;
}

double parse_speed(const std::string& text) {
  if (text == "max") return 0;
  if (const auto speed = positive(text, kMaxSpeed)) return *speed;
  throw WrongValue(fmt::format("'{}' is neither max nor a number above 0 and up to {:g}", text, kMaxSpeed));
}

double parse_max_time(const std::string& text) {
  if (const auto seconds = positive(text, kMaxTime)) return *seconds;
  throw WrongValue(fmt::format("'{}' is no number of seconds above 0 and up to {:g}", text, kMaxTime));
}

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size() || seed > kMaxSeed)
    throw WrongValue(fmt::format("'{}' is not a whole number from 0 to {}", text, kMaxSeed));
  return seed;
}

/// What is random, and how time passes.
void add_time_options(CommandLine& line, TaskOptions& o) {
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
}

/// The run folder, and the values that the run has.
void add_configuration_options(CommandLine& line, TaskOptions& o) {
  line.option("--run-dir", o.run_dir, "the run folder (default runs/TASK-TIME)")
      .check([](const std::string& name) {
        if (name.empty()) throw WrongValue("'' names no folder; leave --run-dir out for a fresh one");
      })
      .type_name("DIR");
  line.option("--config", o.config_file,
              "values over the built-in ones; the config.toml of a run: instead of them")
      .type_name("FILE");
  line.option("--set", o.settings, "sets a value of the configuration; may be repeated")
      .type_name("KEY=VALUE");
}

/// Who gives the operator's orders.
void add_operator_options(CommandLine& line, TaskOptions& o) {
  const Option attended = line.flag("--attended", o.attended, "a person at ui_cli gives start and triggers");
  line.flag("--unattended", "the scripted operator gives them (default)").excludes(attended);
  line.option(
          "--script", o.script,
          "operator input to replay: lines MACROSTEP ORDER. Where it ends before the task does, a terminal "
          "may go "
          "on; if an order is missing and none comes within 10 s, a run in lock-step ends with script_ended")
      .type_name("FILE")
      .excludes(attended);
}

/// When the run ends, and with which exit status.
void add_end_options(CommandLine& line, TaskOptions& o) {
  line.option(
          "--max-time", [&o](const std::string& s) { o.max_time = parse_max_time(s); },
          "ends the run after so many simulated seconds with the fault time_limit (default: never)")
      .type_name("S");
  line.flag("--strict", o.strict, "a figure that misses what is wanted makes the exit status 1");
  line.flag("--no-pictures", o.no_pictures,
            "leaves the scripts plots/NAME.gp and runs no gnuplot, which takes a part of a short run's time");
}

/// The list of parameters.
void add_parameter_options(CommandLine& line, TaskOptions& o) {
  const Option parameters =
      line.flag("--parameters", o.parameters,
                "instead of a run: list every parameter with its default, range and unit");
  line.flag("--truth", o.truth,
            "with --parameters: those of the plant, which no controller reads, and what is believed instead")
      .needs(parameters);
  line.flag("--json", o.json, "with --parameters: as JSON").needs(parameters);
}

/// How others see the system and reach it, and where its programs start.
void add_system_options(CommandLine& line, TaskOptions& o) {
  line.flag("--view", o.view, "also show the task as a web page; prints its address");
  line.option("--session", o.session, "name for ui_cli --session (default: unique)").type_name("NAME");
  line.option("--url", o.url, "where the system talks (default: from the session's name)")
      .type_name("udpm://HOST:PORT?ttl=N");
  line.option("--host", o.hosts, "how programs start on a host of the configuration; may be repeated")
      .type_name("NAME=WORDS");
}

/// @return the examples with this task instead of press, but for those of keys that only press has
Examples examples_of(const std::string& task) {
  constexpr std::string_view kOf = "./run press ", kItsKey = "--set task.force";
  Examples examples = kExamples;
  for (std::string& line : examples)
    if (line.starts_with(kOf) && line.find(kItsKey) == std::string::npos)
      line = "./run " + task + " " + line.substr(kOf.size());
  return examples;
}

/// @return exit status of what the line asks for
int run_parsed(CommandLine& line, int argc, char** argv, const std::function<int()>& run,
               const Examples& own) {
  const auto report_error = [](const FaultError& e) {
    fmt::print(stderr, "{}\n", e.error_line());
    return exit_status(e.fault().code);
  };
  line.footer(
      "Exit status: 0 done; 1 fault, stopped, or with --strict a figure missed; 2 bad usage or input, "
      "nothing was started; 3 system error.");
  if (const auto help = line.help_asked(argc, argv)) {
    print(stdout, *help);
    return 0;
  }
  try {
    line.refuse_unknown_options(argc, argv);
    Examples examples = examples_of(line.name());
    examples.insert(examples.end(), own.begin(), own.end());
    line.parse(argc, argv, examples);
    return run();
  } catch (const FaultError& e) {
    return report_error(e);
  } catch (const std::exception& e) {
    return report_error(FaultError(FaultCode::internal_error, e.what()));
  }
}

}  // namespace

// The help shows them in this order.
void add_task_options(CommandLine& line, TaskOptions& o) {
  add_time_options(line, o);
  add_configuration_options(line, o);
  line.option(
          "--processes",
          [&o](const std::string& p) {
            o.separate = p == "separate";
            o.separate_asked = o.separate;
          },
          "separate processes over LCM (default), or all in one")
      .one_of({"separate", "one"})
      .type_name("separate|one");
  add_operator_options(line, o);
  add_end_options(line, o);
  add_parameter_options(line, o);
  add_system_options(line, o);
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

int run_command_line(CommandLine& line, int argc, char** argv, const std::function<int()>& run,
                     const Examples& own) {
  keep_standard_files();
  report_failed_writes();  // the first file is written before the task's processes are there
  return end_standard_output(run_parsed(line, argc, argv, run, own));
}

}  // namespace mrroc::mp
