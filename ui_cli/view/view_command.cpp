#include "ui_cli/view/view_command.hpp"

#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/signals.hpp"
#include "ui_cli/view/run_source.hpp"
#include "ui_cli/view/server.hpp"
#include "ui_cli/view/session_source.hpp"

namespace mrroc::view {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr const char* kAbout =
    "Shows a running task, or a run folder, as a web page on this host: arms, platforms, sheets with ink, "
    "camera "
    "pictures, forces\n"
    "and poses over time, behaviours, messages. The page only shows; orders are given with ui_cli.";

const ExplainedLines kLines{{"ui_cli view", "what runs now, or next; can be left open"},
                            {"ui_cli view runs/press-...", "a run that is over"},
                            {"./run drawing --view --speed 1", "a task with its viewer beside it"}};

constexpr const char* kExitStatus =
    "\nExit status: 0 ended with Ctrl-C; 2 bad usage, or a folder that cannot be shown.";

std::atomic<bool> interrupted{false};
void interrupt(int) { interrupted = true; }

struct Options {
  std::string run;
  int port{};
  ui::SessionSelector selector;
  bool with_task{};
  bool json{};
};

/// A name or an address that cannot be one is told at once, not on the page.
void check(const ui::SessionSelector& selector) {
  if (selector.session.empty()) return;
  link::check_session_name(selector.session);
  try {
    if (!selector.url.empty()) std::ignore = link::LcmAddress::parse(selector.url);
  } catch (const std::logic_error& e) {
    throw FaultError(FaultCode::bad_usage, fmt::format("--url: {}", e.what()));
  }
}

/// Waits for the end.
void stay(const Options& o, const Server& server, const SessionSource* source) {
  constexpr auto kLeave = 5s;
  auto wanted = std::chrono::steady_clock::now();
  while (!interrupted) {
    std::this_thread::sleep_for(50ms);
    const auto now = std::chrono::steady_clock::now();
    if (!o.with_task || !source || source->following() || server.pages() > 0) wanted = now;
    if (now - wanted > kLeave) return;
  }
}

int serve(const Options& o, std::ostream& out) {
  check(o.selector);
  Record record;
  CameraWindow cameras;
  std::unique_ptr<SessionSource> source;
  if (o.run.empty())
    source = std::make_unique<SessionSource>(
        SessionEnvironment{.selector = o.selector, .sessions = link::session_directory()}, record, cameras);
  else
    load_run(o.run, record);
  const Server server(
      {record, cameras, [&]() -> fs::path { return source ? source->folder() : fs::path(o.run); }}, o.port);
  if (o.json)
    out << nlohmann::json{{"url", server.url()}}.dump() << std::endl;
  else
    out << "view: " << server.url() << std::endl;
  stay(o, server, source.get());
  return 0;
}

}  // namespace

int run_view(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Options o;
  CommandLine line(kAbout, "ui_cli view");
  line.option("run", o.run, "run folder (default: what runs now)").type_name("RUN");
  line.option("--port", o.port, "of 127.0.0.1 (default: 8460 or the next that is free)")
      .range(1024, 65535)
      .type_name("N");
  const Option session =
      line.option("--session", o.selector.session, "name of the session, when several tasks run")
          .type_name("NAME");
  line.option("--url", o.selector.url, "where a task of another host talks: udpm://HOST:PORT?ttl=N")
      .needs(session)
      .type_name("URL");
  line.option("--key-file", o.selector.key_file, "key of that session: a copy of its .key file")
      .needs(session)
      .type_name("FILE");
  line.flag("--with-task", o.with_task, "end when no task runs and no page is open for 5 s");
  line.flag("--json", o.json, "the address as JSON: {\"url\": ...}");
  line.footer("\nExamples:\n" + explained(kLines) + kExitStatus);
  interrupted = false;
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  report_failed_writes();  // a page that goes away is no error
  if (const auto status =
          line.parse_words(arguments, out, err,
                           {"ui_cli view --port 8470", "ui_cli view --session press",
                            "ui_cli view --session cell --url udpm://239.255.76.67:7667?ttl=1"}))
    return *status;
  try {
    return serve(o, out);
  } catch (const FaultError& e) {
    err << e.error_line(o.selector.session) << std::endl;
    return exit_status(e.fault().code);
  }
}

}  // namespace mrroc::view
