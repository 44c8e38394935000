#include "ui_cli/attach.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "base/fault.hpp"

namespace mrroc::ui {
namespace {

std::string candidates(const std::vector<link::SessionInfo>& running) {
  std::string text;
  for (const auto& s : running) text += (text.empty() ? "" : ", ") + s.name;
  return text;
}

[[noreturn]] void nothing_runs(const std::string& what) {
  throw FaultError(FaultCode::no_such_session, what,
                   "start one, for example with `./run drawing`, or name a task of another host with "
                   "--session, --url and --key-file");
}

link::LcmAddress parse_url(const std::string& url) {
  try {
    return link::LcmAddress::parse(url);
  } catch (const std::logic_error& e) {  // also a number that is too large for any port
    throw FaultError(FaultCode::bad_usage, fmt::format("--url: {}", e.what()));
  }
}

link::SessionInfo find(const SessionSelector& selector, const std::vector<link::SessionInfo>& running) {
  if (selector.session.empty()) {
    if (!selector.url.empty()) throw FaultError(FaultCode::bad_usage, "--url needs --session beside it");
    if (running.empty()) nothing_runs("no task runs");
    if (running.size() == 1) return running.front();
    throw FaultError(FaultCode::no_such_session,
                     fmt::format("{} tasks run: {}", running.size(), candidates(running)),
                     "name one with --session NAME");
  }
  link::check_session_name(selector.session);
  const auto known = std::ranges::find(running, selector.session, &link::SessionInfo::name);
  if (known != running.end()) return *known;
  if (!selector.url.empty()) return {.name = selector.session, .address = {}, .task = {}, .run_folder = {}};
  const std::string what = fmt::format("no task runs under the name {}", selector.session);
  if (running.empty()) nothing_runs(what);
  throw FaultError(
      FaultCode::no_such_session, fmt::format("{}; these run: {}", what, candidates(running)),
      "name one of them with --session, or a task of another host with --url and --key-file beside it");
}

}  // namespace

link::SessionInfo choose_session(const SessionSelector& selector,
                                 const std::vector<link::SessionInfo>& running) {
  link::SessionInfo session = find(selector, running);
  if (!selector.url.empty()) session.address = parse_url(selector.url);
  if (!selector.key_file.empty()) session.key = link::read_key_file(selector.key_file);
  if (!session.address)
    throw FaultError(
        FaultCode::no_such_session,
        fmt::format("the task of session {} runs without messages between processes", session.name),
        fmt::format("end it with Ctrl-C in its own terminal, or with `kill {}`", session.pid));
  return session;
}

}  // namespace mrroc::ui
