#include "base/link/log_check.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace mrroc::link {
namespace {

using Json = nlohmann::ordered_json;

/// Messages that the process sent in the run and has not sent now.
void judge_not_sent(const ReplayBus& bus, const std::string& behaviour, LogVerdict& v) {
  const auto left = bus.not_sent();
  if (left.empty()) return;
  if (const std::string missing = bus.missing(); !missing.empty()) {
    v.incomplete = "the log lacks " + missing;
    return;
  }
  for (const auto& [channel, numbers] : left) v.differences += static_cast<std::int64_t>(numbers.size());
  if (v.first) return;
  const auto& [channel, numbers] = *left.begin();
  v.first = LogDifference{.channel = channel,
                          .number = numbers.front(),
                          .behaviour = behaviour,
                          .logged = "a message",
                          .recomputed = "nothing"};
}

}  // namespace

LogVerdict check_process(const LogReader& log, const std::string& name, ClockKind clock,
                         const std::function<void(Process&)>& body, const std::set<std::string>& left_out) {
  LogVerdict v{.process = name};
  if (clock == ClockKind::wall) {
    v.not_checked = "the run went by the wall clock: a log does not tell what had arrived when it decided";
    return v;
  }
  ReplayBus bus(log, left_out);
  Process process(bus, {.session = log.session(),
                        .session_id = log.session_id(),
                        .name = name,
                        .roster = {"mp", name},
                        .clock = clock,
                        .timeout = std::chrono::milliseconds(0),
                        .replayed = true});
  bus.set_judge({.compares = [&process](std::string_view channel) { return process.sends(channel); },
                 .behaviour = [&process] { return process.behaviour(); }});
  try {
    body(process);
  } catch (const LogEnded&) {
  } catch (const NotInLog& e) {
    v.not_checked = e.what;
    return v;
  } catch (const FaultError&) {
    // As in the run: if it is not, what it sent afterwards is not sent again.
  }
  v.compared = bus.compared();
  v.differences = bus.differences();
  v.first = bus.first();
  judge_not_sent(bus, process.behaviour(), v);
  return v;
}

std::string to_json(const LogVerdict& v) {
  Json j{{"process", v.process}, {"compared", v.compared},     {"differences", v.differences},
         {"first", nullptr},     {"incomplete", v.incomplete}, {"not_checked", v.not_checked}};
  if (v.first)
    j["first"] = {{"channel", v.first->channel},   {"number", v.first->number},
                  {"stamp", v.first->stamp},       {"behaviour", v.first->behaviour},
                  {"function", v.first->function}, {"field", v.first->field},
                  {"logged", v.first->logged},     {"recomputed", v.first->recomputed}};
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

LogVerdict verdict_from_json(const std::string& text) try {
  const Json j = Json::parse(text);
  LogVerdict v;
  j.at("process").get_to(v.process);
  j.at("compared").get_to(v.compared);
  j.at("differences").get_to(v.differences);
  j.at("incomplete").get_to(v.incomplete);
  j.at("not_checked").get_to(v.not_checked);
  if (const Json& f = j.at("first"); !f.is_null()) {
    LogDifference& d = v.first.emplace();
    f.at("channel").get_to(d.channel);
    f.at("number").get_to(d.number);
    f.at("stamp").get_to(d.stamp);
    f.at("behaviour").get_to(d.behaviour);
    f.at("function").get_to(d.function);
    f.at("field").get_to(d.field);
    f.at("logged").get_to(d.logged);
    f.at("recomputed").get_to(d.recomputed);
  }
  return v;
} catch (const Json::exception& e) {
  throw FaultError(FaultCode::bad_log, fmt::format("this is no verdict on a log: {}", e.what()));
}

int report_verdict(const LogVerdict& verdict) {
  fmt::print("{}\n", to_json(verdict));
  std::fflush(stdout);
  return verdict.differences > 0 ? 1 : 0;
}

}  // namespace mrroc::link
