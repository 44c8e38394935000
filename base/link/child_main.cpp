#include "base/link/child_main.hpp"

#include <fmt/core.h>

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
#include "base/signals.hpp"

namespace mrroc::link {
namespace {

int complain(const FaultError& e) {
  fmt::print(stderr, "{}\n", e.error_line());
  return exit_status(e.fault().code);
}

/// With the wall clock: who is called more often interrupts the others.
int priority_of(const std::string& process) {
  if (process == "world") return 40;
  return process.starts_with("edp-") ? 30 : 20;
}

/// @return what was permitted
std::string keep_time(const Membership& membership, bool paced) {
  if (membership.clock == ClockKind::wall) return become_real_time(priority_of(membership.name));
  return paced && keep_in_memory() ? "memory locked" : "";
}

int run(const Membership& membership, const std::string& url, bool paced, const std::string& config_file,
        const PartArguments& arguments, const PartBody& body) {
  const Config config = Config::load(config_file);
  // Before the bus: its thread is to be scheduled like this one.
  const std::string real_time = keep_time(membership, paced);
  const auto network = open_lcm(LcmAddress::parse(url));
  const double loss = read_loss(config);
  LossyBus lossy(*network, loses(loss, std::hash<std::string>{}(membership.name)));
  Bus& bus = loss > 0 ? static_cast<Bus&>(lossy) : *network;
  Process process(bus, membership);
  if (!real_time.empty()) process.say("real time: " + real_time);
  try {
    body(process, config, arguments);
    return 0;
  } catch (const FaultError& e) {
    process.report_fault(e.fault());
    return complain(e);
  } catch (const std::exception& e) {
    process.report_fault({.code = FaultCode::internal_error, .text = e.what()});
    return complain(FaultError(FaultCode::internal_error, e.what()));
  }
}

/// Runs the body on the log of a run instead.
int check(const std::filesystem::path& folder, const Membership& membership, const PartArguments& arguments,
          const PartBody& body) {
  const LogReader log(checked_run_folder(folder));
  const Config config = Config::load((folder / "config.toml").string());
  return report_verdict(check_process(log, membership.name, membership.clock,
                                      [&](Process& process) { body(process, config, arguments); }));
}

}  // namespace

int child_main(int argc, char** argv, const std::string& about, const PartBody& body) {
  for (const int of_terminal : {SIGINT, SIGHUP})
    std::signal(of_terminal, SIG_IGN);  // the task's own program decides
  survive_failed_writes();
  Membership membership;
  PartArguments arguments;
  std::string url = LcmAddress{}.url();
  std::string config_file;
  std::string clock = "step";
  bool paced = false;
  double patience = std::chrono::duration<double>(membership.patience).count();

  std::filesystem::path checked;
  const std::span words(argv, static_cast<std::size_t>(argc));
  // A check needs no system.
  const bool joins = std::ranges::none_of(words, [](std::string_view w) { return w.starts_with("--check"); });

  CommandLine line(about + "\nA task starts it; by hand it joins a system that waits for it.");
  line.option("--session", membership.session, "name of the system").required(joins);
  line.option("--session-id", membership.session_id, "number of the run").required(joins);
  line.option("--url", url, "where the system talks: udpm://HOST:PORT?ttl=N").required(joins);
  line.option("--name", membership.name, "of this process in the roster").required();
  line.option("--roster", membership.roster, "all processes, the task's own first")
      .required(joins)
      .delimiter(',');
  line.option("--config", config_file, "the run's config.toml").required(joins);
  line.option("--clock", clock, "step or wall").one_of({"step", "wall"});
  line.flag("--paced", paced, "macrosteps last as long as they say: stays in memory, if that is permitted");
  line.option("--patience", patience, "wait so long for a message that must come [s], 0: for ever")
      .range(0.0, 1e6);
  line.option("--arm", arguments.arm, "which arm it belongs to");
  line.ignored_option("--robot", "the robot's model, for the reader of the process list");
  line.option("--check", checked,
              "recompute from a run folder's log what this process sent, and print what differs as JSON")
      .type_name("RUN");
  if (const auto help = line.help_asked(argc, argv)) {
    fmt::print("{}", *help);
    return 0;
  }
  try {
    line.refuse_unknown_options(argc, argv);
    line.parse(argc, argv, {"./run press", "ui_cli log check runs/press-20260314-101500"});
  } catch (const FaultError& e) {
    return complain(e);
  }
  membership.clock = clock == "wall" ? ClockKind::wall : ClockKind::step;
  membership.patience = std::chrono::milliseconds(std::llround(1e3 * patience));
  try {
    if (!joins) return check(checked, membership, arguments, body);
    return run(membership, url, paced, config_file, arguments, body);
  } catch (const FaultError& e) {
    return complain(e);
  } catch (const NoMulticast& e) {
    return complain(FaultError(FaultCode::no_multicast, e.what()));
  } catch (const std::exception& e) {
    return complain(FaultError(FaultCode::bad_usage, e.what()));
  }
}

}  // namespace mrroc::link
