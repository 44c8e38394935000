#include "base/link/child_main.hpp"

#include <fmt/core.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <span>

#include "base/command_line.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/log_check.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/real_time.hpp"
#include "base/link/run_folder.hpp"
#include "base/link/session.hpp"
#include "base/print.hpp"
#include "base/signals.hpp"
#include "base/standard_files.hpp"

namespace mrroc::link {
namespace {

int report_error(const FaultError& e) {
  fmt::print(stderr, "{}\n", e.error_line());
  return exit_status(e.fault().code);
}

/// With the wall clock: a process that is called more often interrupts the others.
int priority_of(const std::string& process) {
  if (process == "simulator") return 40;
  return process.starts_with("edp-") ? 30 : 20;
}

/// @return what was permitted, and what was not
std::string keep_time(const NodeContext& context, bool paced) {
  if (context.clock == ClockKind::wall) return become_real_time(priority_of(context.name));
  return paced && keep_in_memory() ? "memory locked" : "";
}

/// Source of the session's key; by default the running session of that name.
struct KeySource {
  int descriptor{-1};          ///< -1: none
  std::filesystem::path file;  ///< empty: none
};

Key find_key(const KeySource& source, const std::string& session) {
  if (source.descriptor >= 0) return read_key(source.descriptor);
  if (!source.file.empty()) return read_key_file(source.file);
  for (const SessionInfo& running : running_sessions())
    if (running.name == session && running.key) return *running.key;
  throw FaultError(FaultCode::no_such_session, "no session of this host has the name " + session,
                   "give --key-file with the file that `ui_cli list --json` names on the task's host");
}

/// What the command line of a node says.
struct ChildOptions {
  NodeContext context;
  NodeArguments arguments;
  std::string url{LcmAddress{}.url()};
  std::string config_file;
  std::string clock{"step"};
  KeySource key;
  bool paced{};
  double timeout{std::chrono::duration<double>(context.timeout).count()};  ///< [s]
  std::filesystem::path checked;  ///< run folder; empty: the node joins a system
};

/// The name of the process, and how it joins a system. @param joins  whether it does
void add_system_options(CommandLine& line, ChildOptions& o, bool joins) {
  line.option("--session", o.context.session, "name of the system").required(joins);
  line.option("--session-id", o.context.session_id, "number of the run").required(joins);
  line.option("--url", o.url, "where the system talks: udpm://HOST:PORT?ttl=N").required(joins);
  const Option by_file =
      line.option("--key-file", o.key.file,
                  "the session's key (default: that of the session of this name on this host)")
          .type_name("FILE");
  line.option("--key-fd", o.key.descriptor,
              "read the key from the first line of this open file, as a task does: 0")
      .type_name("N")
      .range(0, 1023)
      .excludes(by_file);
  line.option("--name", o.context.name, "of this process in the roster").required();
  line.option("--roster", o.context.roster, "all processes, the task's own first")
      .required(joins)
      .delimiter(',');
}

/// What it does there, and when.
void add_work_options(CommandLine& line, ChildOptions& o, bool joins) {
  line.option("--config", o.config_file, "the run's config.toml").required(joins);
  line.option("--clock", o.clock, "step or wall").one_of({"step", "wall"});
  line.flag("--paced", o.paced, "macrosteps last as long as they say: stays in memory, if that is permitted");
  line.option("--timeout", o.timeout, "wait so long for a message that must come [s], 0: for ever")
      .range(0.0, 1e6);
  line.option("--arm", o.arguments.arm, "which arm it belongs to");
  line.option("--hardware", o.arguments.hardware,
              "of a driver: simulated, loopback, or what the robot has of its own (default: [robots.ARM] "
              "hardware)")
      .type_name("KIND");
  line.ignored_option("--robot", "the robot's model, for the reader of the process list");
  line.option("--check", o.checked,
              "recompute from a run folder's log what this process sent, and print what differs as JSON")
      .type_name("RUN");
}

/// A process that dies with its parent waits for it, however long the parent is suspended.
void wait_for_parent(NodeContext& context) {
  int at_death_of_parent = 0;
  ::prctl(PR_GET_PDEATHSIG, &at_death_of_parent);
  if (at_death_of_parent != 0) context.alone = std::chrono::milliseconds(0);
}

int run(const ChildOptions& o, const NodeMain& body) {
  const Config config = Config::load(o.config_file);
  const Key key = find_key(o.key, o.context.session);
  const std::string real_time = keep_time(o.context, o.paced);
  const auto network = open_lcm(LcmAddress::parse(o.url), key);
  const double loss = read_loss(config);
  LossyBus lossy(*network, loses(loss, std::hash<std::string>{}(o.context.name)));
  Bus& bus = loss > 0 ? static_cast<Bus&>(lossy) : *network;
  Process process(bus, o.context);
  if (!real_time.empty()) process.log("real time: " + real_time);
  try {
    body(process, config, o.arguments);
    return 0;
  } catch (const FaultError& e) {
    process.report_fault(e.fault());
    return report_error(e);
  } catch (const std::exception& e) {
    process.report_fault({.code = FaultCode::internal_error, .text = e.what()});
    return report_error(FaultError(FaultCode::internal_error, e.what()));
  }
}

/// Runs the body on the log of a run instead.
int check(const ChildOptions& o, const NodeMain& body) {
  const LogReader log(checked_run_folder(o.checked));
  const Config config = Config::load((o.checked / "config.toml").string());
  return report_verdict(check_process(log, o.context.name, o.context.clock,
                                      [&](Process& process) { body(process, config, o.arguments); }));
}

}  // namespace

int child_main(int argc, char** argv, const std::string& about, const NodeMain& body) {
  for (const int of_terminal : {SIGINT, SIGHUP})
    std::signal(of_terminal, SIG_IGN);  // the task's own program decides
  report_failed_writes();
  ChildOptions o;
  const std::span words(argv, static_cast<std::size_t>(argc));
  // A check needs no system.
  const bool joins = std::ranges::none_of(words, [](std::string_view w) { return w.starts_with("--check"); });

  CommandLine line(about + "\nA task starts it; by hand it joins a system that waits for it.");
  add_system_options(line, o, joins);
  add_work_options(line, o, joins);
  if (const auto help = line.help_asked(argc, argv)) {
    print(stdout, *help);
    return end_standard_output(0);
  }
  try {
    line.refuse_unknown_options(argc, argv);
    line.parse(argc, argv, {"./run press", "ui_cli log check runs/press-20260314-101500"});
  } catch (const FaultError& e) {
    return report_error(e);
  }
  o.context.clock = o.clock == "wall" ? ClockKind::wall : ClockKind::step;
  o.context.timeout = std::chrono::milliseconds(std::llround(1e3 * o.timeout));
  wait_for_parent(o.context);
  try {
    return joins ? run(o, body) : check(o, body);
  } catch (const FaultError& e) {
    return report_error(e);
  } catch (const NoMulticast& e) {
    return report_error(FaultError(FaultCode::no_multicast, e.what()));
  } catch (const std::exception& e) {
    return report_error(FaultError(FaultCode::bad_usage, e.what()));
  }
}

}  // namespace mrroc::link
