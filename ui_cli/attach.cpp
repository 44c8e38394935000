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
                   "start one, for example with `./run drawing`, or name a task of another host or user with "
                   "--session and --url");
}

link::LcmAddress parse_url(const std::string& url) {
  try {
    return link::LcmAddress::parse(url);
  } catch (const std::logic_error& e) {  // also a number that is too large for any port
    throw FaultError(FaultCode::bad_usage, fmt::format("--url: {}", e.what()));
  }
}

link::SessionInfo find(const Wish& wish, const std::vector<link::SessionInfo>& running) {
  if (wish.session.empty()) {
    if (!wish.url.empty()) throw FaultError(FaultCode::bad_usage, "--url needs --session beside it");
    if (running.empty()) nothing_runs("no task runs");
    if (running.size() == 1) return running.front();
    throw FaultError(FaultCode::no_such_session,
                     fmt::format("{} tasks run: {}", running.size(), candidates(running)),
                     "name one with --session NAME");
  }
  link::check_session_name(wish.session);
  const auto known = std::ranges::find(running, wish.session, &link::SessionInfo::name);
  if (known != running.end()) return *known;
  if (!wish.url.empty()) return {wish.session, 0, {}, {}, {}, 0};
  const std::string what = fmt::format("no task runs under the name {}", wish.session);
  if (running.empty()) nothing_runs(what);
  throw FaultError(FaultCode::no_such_session, fmt::format("{}; these run: {}", what, candidates(running)),
                   "name one of them with --session, or a task of another host or user with --url beside it");
}

}  // namespace

link::SessionInfo choose_session(const Wish& wish, const std::vector<link::SessionInfo>& running) {
  link::SessionInfo session = find(wish, running);
  if (!wish.url.empty()) session.address = parse_url(wish.url);
  if (!session.address)
    throw FaultError(
        FaultCode::no_such_session,
        fmt::format("the task of session {} runs without messages between processes", session.name),
        fmt::format("end it with Ctrl-C in its own terminal, or with `kill {}`", session.pid));
  return session;
}

}  // namespace mrroc::ui
