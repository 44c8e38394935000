#include "ui_cli/report.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/command_hint.hpp"
#include "ui_cli/fixed_number.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;

std::string dump(const Json& j) { return j.dump(2, ' ', true, Json::error_handler_t::replace) + "\n"; }

std::string row(std::string_view name, const std::string& value) {
  return value.empty() ? std::string() : fmt::format("{:<10} {}\n", name, value);
}

/// A behaviour: those of waiting have no number.
std::string numbered(int m, const std::string& name) {
  if (m == 0) return name;
  return name.empty() ? fmt::format("m = {}", m) : fmt::format("m = {}, {}", m, name);
}

std::string_view word_of(EffectorKind kind) {
  switch (kind) {
    case EffectorKind::arm:
      return "arm";
    case EffectorKind::platform:
      return "platform";
    case EffectorKind::none:
      return "none";
  }
  return "?";
}

/// Place and speed of a platform; pose and force of an arm.
std::string where_is(const AgentView& a) {
  const auto& T = a.T_0E;
  const std::string x = a.position_known ? fixed(1e3 * T[0], 1) : "-",
                    y = a.position_known ? fixed(1e3 * T[1], 1) : "-";
  if (a.effector == EffectorKind::platform)
    return fmt::format(
        "x, y {} {} mm; heading {} rad; v {} m/s, w {} rad/s", x, y, a.position_known ? fixed(T[5], 3) : "-",
        a.position_known ? fixed(a.velocity[0], 2) : "-", a.position_known ? fixed(a.velocity[2], 2) : "-");
  const std::string pose =
      a.position_known ? fmt::format("x, y, z {} {} {} mm; rotation {} {} {} rad", x, y, fixed(1e3 * T[2], 1),
                                     fixed(T[3], 3), fixed(T[4], 3), fixed(T[5], 3))
                       : "x, y, z - mm; rotation - rad";
  return fmt::format("{}; F_x, F_y, F_z {} {} {} N", pose, fixed(a.F_a[0], 2), fixed(a.F_a[1], 2),
                     fixed(a.F_a[2], 2));
}

}  // namespace

std::string status_text(const Snapshot& s, std::string_view session) {
  std::string text = row("session", s.session);
  text += row("task", fmt::format("{}: {}{}", s.task, to_string(s.state),
                                  s.waits_for_trigger ? ", waits for a trigger" : ""));
  if (s.state == TaskState::paused)
    text += row("pause", resting(s) + "; simulated time goes on, the task does not");
  if (s.waits_for_trigger) text += row("trigger", s.early.empty() ? "may be given" : "early: " + s.early);
  text += row("behaviour", numbered(s.m, s.behaviour));
  text += row("after", s.ended_because);
  if (s.progress)
    text += row("progress", fmt::format("{:.0f} %{}{}", 100 * *s.progress,
                                        s.progress_text.empty() ? "" : ", ", s.progress_text));
  else
    text += row("progress", s.progress_text);
  text += row("time", fmt::format("{:.2f} s simulated, {:.1f} x real time", s.sim_time, s.speed));
  for (const AgentView& a : s.agents) {
    if (has_effector(a)) text += row(a.name, where_is(a) + (a.sensor.empty() ? "" : "; " + a.sensor));
    text += row(has_effector(a) ? "" : a.name, numbered(a.m, a.behaviour));
    text += row("", a.ended_because.empty() ? "" : "after " + a.ended_because);
  }
  std::string heading = "processes";
  for (const ProcessView& p : s.processes) {
    text += row(heading, fmt::format("{:<20} {:<9} heard {:.1f} s ago", p.name, to_string(p.state), p.age));
    heading.clear();
  }
  const std::string message = command_hint(s.last_message, session);
  text +=
      row("message",
          s.last_code == FaultCode::none ? message : fmt::format("{}: {}", to_string(s.last_code), message));
  text += row("run folder", s.run_folder);
  return text;
}

std::string status_json(const Snapshot& s) {
  Json j{{"session", s.session},
         {"task", s.task},
         {"state", to_string(s.state)},
         {"m", s.m},
         {"behaviour", s.behaviour},
         {"ended_because", s.ended_because},
         {"waits_for_trigger", s.waits_for_trigger},
         {"trigger_early", s.early},
         {"macrostep", s.macrostep},
         {"sim_s", s.sim_time},
         {"speed", s.speed},
         {"progress", nullptr},
         {"progress_text", s.progress_text},
         {"agents", Json::array()},
         {"processes", Json::array()},
         {"last_message", {{"code", to_string(s.last_code)}, {"text", s.last_message}}},
         {"run_folder", s.run_folder}};
  if (s.progress) j["progress"] = *s.progress;
  for (const AgentView& a : s.agents)
    j["agents"].push_back(
        {{"name", a.name},
         {"effector", word_of(a.effector)},
         {"m", a.m},
         {"behaviour", a.behaviour},
         {"ended_because", a.ended_because},
         {"T_0E", a.position_known ? Json(a.T_0E) : Json(nullptr)},
         {"F_a", a.F_a},
         {"velocity",
          a.effector == EffectorKind::platform && a.position_known ? Json(a.velocity) : Json(nullptr)},
         {"sensor", a.sensor}});
  for (const ProcessView& p : s.processes)
    j["processes"].push_back({{"name", p.name}, {"state", to_string(p.state)}, {"age_s", p.age}});
  return dump(j);
}

std::string sessions_text(const std::vector<link::SessionInfo>& sessions) {
  if (sessions.empty()) return "no task runs\n";
  std::string text = fmt::format("{:<24} {:<14} {:>7}  {}\n", "SESSION", "TASK", "PROCESS", "RUN FOLDER");
  for (const auto& s : sessions)
    text += fmt::format("{:<24} {:<14} {:>7}  {}\n", s.name, s.task, s.pid, s.run_folder.string());
  return text;
}

std::string sessions_json(const std::vector<link::SessionInfo>& sessions) {
  Json j = Json::array();
  for (const auto& s : sessions) {
    j.push_back({{"session", s.name},
                 {"task", s.task},
                 {"pid", s.pid},
                 {"id", s.id},
                 {"url", nullptr},
                 {"key_file", nullptr},
                 {"run_folder", s.run_folder.string()}});
    if (s.address) j.back()["url"] = s.address->url();
    if (!s.key_file.empty()) j.back()["key_file"] = s.key_file.string();
  }
  return dump(j);
}

std::string answer_text(const Answer& answer) {
  return (answer.text.empty() ? fmt::format("{} accepted", to_string(answer.order)) : answer.text) + "\n";
}

std::string answer_json(const Answer& answer) {
  return dump({{"order", to_string(answer.order)}, {"accepted", answer.accepted}, {"text", answer.text}});
}

}  // namespace mrroc::ui
