#include "mp/status_board.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/link/text.hpp"

namespace mrroc::mp {
namespace {
constexpr std::chrono::milliseconds kPeriod{100};
}

StatusBoard::StatusBoard(link::Process& process, const Supervisor& supervisor, const std::string& task,
                         const std::vector<std::string>& arms, const std::string& run_folder)
    : supervisor_(supervisor),
      out_(process.bus(), process.route("task_status"), process.context().session_id) {
  link::put_text(status_.task, task);
  link::put_text(status_.run_folder, run_folder);
  status_.n_agents = static_cast<int>(std::min(arms.size(), std::size(status_.agent)));
  drivers_.resize(std::size(status_.agent));
  for (int k = 0; k < status_.n_agents; ++k)
    link::put_text(status_.agent[k], arms[static_cast<std::size_t>(k)]);
}

void StatusBoard::set_behaviour(int m, std::string_view name, std::string_view until) {
  const std::string before = link::get_text(status_.behaviour);
  if (m == status_.m && name == before) return;
  news_ = true;
  if (!before.empty())
    link::put_text(
        status_.ended_because,
        link::end_of_behaviour(before, until_, fmt::format("{:.2f} s", status_.sim_time - begun_s_)));
  until_ = until;
  begun_s_ = status_.sim_time;
  status_.m = m;
  link::put_text(status_.behaviour, name);
}
std::string StatusBoard::behaviour() const { return link::get_text(status_.behaviour); }
std::string StatusBoard::watched() const {
  std::string text = fmt::format("{} {}", status_.m, status_.progress);
  for (const DriverState state : drivers_) text += fmt::format(" {}", static_cast<int>(state));
  const bool homes = std::ranges::find(drivers_, DriverState::homing) != drivers_.end();
  return homes ? fmt::format("{} in {}", text, macrostep_) : text;
}
void StatusBoard::set_state(TaskState state, bool waits_for_trigger) {
  status_.state = static_cast<int>(state);
  status_.waits_for_trigger = waits_for_trigger;
}
void StatusBoard::set_early(std::string_view why) { link::put_text(status_.early, why); }
void StatusBoard::set_progress(double share, const std::string& text) {
  status_.progress = share;
  link::put_text(status_.progress_text, text);
}
void StatusBoard::set_time(std::int64_t macrostep, double sim_s) {
  macrostep_ = macrostep;
  status_.sim_time = sim_s;
}
void StatusBoard::set_effector(std::size_t agent, EffectorKind kind) {
  if (agent < std::size(status_.effector)) status_.effector[agent] = static_cast<std::int8_t>(kind);
}
void StatusBoard::set_arm(std::size_t arm, const Report& report, std::string_view sensor_text) {
  status_.position_known[arm] = report.position_known ? 1 : 0;
  std::ranges::copy(report.T_0E, status_.T_0E[arm]);
  std::ranges::copy(report.F_a.v, status_.F_a[arm]);
  status_.sensor[arm] = report.sensor;
  drivers_[arm] = report.driver_state;
  link::put_text(status_.sensor_text[arm], sensor_text);
}
void StatusBoard::set_velocity(std::size_t agent, const PlanarVelocity& v) {
  if (agent < std::size(status_.velocity))
    std::ranges::copy(std::array{v.vx, v.vy, v.w}, status_.velocity[agent]);
}

void StatusBoard::poll() {
  const bool news = news_ || supervisor_.behaviours_begun() != agents_begun_;
  if (news || link::Process::Clock::now() - last_ > kPeriod) publish();
}

void StatusBoard::publish() {
  const auto now = link::Process::Clock::now();
  const double wall = std::chrono::duration<double>(now - last_).count();
  const double speed = (status_.sim_time - last_sim_s_) / wall;
  status_.speed += (speed - status_.speed) * std::min(1.0, wall);  // a mean over about a second
  last_ = now;
  news_ = false;
  last_sim_s_ = status_.sim_time;
  take_processes();
  link::put_text(status_.last_message, supervisor_.last_message());
  status_.last_code = static_cast<int>(supervisor_.last_code());
  status_.fault = supervisor_.fault() ? static_cast<int>(supervisor_.fault()->code) : 0;
  out_.publish(status_, macrostep_);
}

void StatusBoard::take_processes() {
  agents_begun_ = supervisor_.behaviours_begun();
  const auto nodes = supervisor_.node_statuses();
  status_.n_processes = static_cast<int>(std::min(nodes.size(), std::size(status_.process)));
  for (int k = 0; k < status_.n_processes; ++k) {
    const NodeStatus& p = nodes[static_cast<std::size_t>(k)];
    link::put_text(status_.process[k], p.name);
    status_.process_state[k] = static_cast<int>(p.state);
    status_.process_age[k] = p.age;
  }
  constexpr std::string_view kAgent = "ecp-";
  for (const NodeStatus& ecp : nodes) {
    if (!ecp.name.starts_with(kAgent)) continue;
    const auto k = place_of(std::string_view(ecp.name).substr(kAgent.size()));
    if (!k) continue;
    status_.agent_m[*k] = ecp.m;
    link::put_text(status_.agent_behaviour[*k], ecp.behaviour);
    link::put_text(status_.agent_ended_because[*k], ecp.ended_because);
  }
}

std::optional<int> StatusBoard::place_of(std::string_view agent) {
  for (int k = 0; k < status_.n_agents; ++k)
    if (link::get_text(status_.agent[k]) == agent) return k;
  const int place = status_.n_agents;
  if (place == static_cast<int>(std::size(status_.agent))) return {};
  ++status_.n_agents;
  link::put_text(status_.agent[place], agent);
  set_effector(static_cast<std::size_t>(place), EffectorKind::none);
  return place;
}

}  // namespace mrroc::mp
