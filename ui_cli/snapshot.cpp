#include "ui_cli/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/link/text.hpp"

namespace mrroc::ui {
namespace {

using link::get_text;

/// @return the enumerator with that number; one that has no name for a number outside 0..last
template <class E>
E enumerator(std::int32_t number, E last) {
  constexpr std::uint8_t kNameless = 255;
  const bool known = number >= 0 && number <= static_cast<std::int32_t>(last);
  return static_cast<E>(known ? static_cast<std::uint8_t>(number) : kNameless);
}

int count(std::int32_t told, std::size_t room) {
  return std::clamp(told, 0, static_cast<std::int32_t>(room));
}

}  // namespace

Snapshot snapshot(const task_status_t& m, const std::string& session) {
  Snapshot s;
  s.session = session;
  s.session_id = m.header.session;
  s.task = get_text(m.task);
  s.state = enumerator(m.state, TaskState::ended);
  s.waits_for_trigger = m.waits_for_trigger != 0;
  s.early = get_text(m.early);
  s.m = m.m;
  s.behaviour = get_text(m.behaviour);
  s.ended_because = get_text(m.ended_because);
  s.macrostep = m.header.stamp;
  s.sim_time = m.sim_time;
  s.speed = m.speed;
  if (m.progress >= 0) s.progress = std::min(m.progress, 1.0);
  s.progress_text = get_text(m.progress_text);
  for (int k = 0; k < count(m.n_agents, std::size(m.agent)); ++k) {
    AgentView a{.name = get_text(m.agent[k]),
                .effector = enumerator(m.effector[k], EffectorKind::none),
                .m = m.agent_m[k],
                .behaviour = get_text(m.agent_behaviour[k]),
                .ended_because = get_text(m.agent_ended_because[k]),
                .position_known = m.position_known[k] != 0,
                .sensor = get_text(m.sensor_text[k])};
    std::ranges::copy(m.T_0E[k], a.T_0E.begin());
    std::ranges::copy(m.F_a[k], a.F_a.begin());
    std::ranges::copy(m.velocity[k], a.velocity.begin());
    s.agents.push_back(std::move(a));
  }
  for (int k = 0; k < count(m.n_processes, std::size(m.process)); ++k)
    s.processes.push_back(
        {get_text(m.process[k]), enumerator(m.process_state[k], link::ProcessState::dead), m.process_age[k]});
  s.fault = fault_code(m.fault).value_or(FaultCode::internal_error);
  s.last_code = fault_code(m.last_code).value_or(FaultCode::internal_error);
  s.last_message = get_text(m.last_message);
  s.run_folder = get_text(m.run_folder);
  return s;
}

std::string resting(const Snapshot& s) {
  const auto any = [&s](EffectorKind kind) {
    return std::ranges::count(s.agents, kind, &AgentView::effector) > 0;
  };
  if (!any(EffectorKind::platform)) return "arms rest and keep their forces";
  return any(EffectorKind::arm) ? "arms keep forces, platforms stand" : "platforms stand";
}

}  // namespace mrroc::ui
