#include "ui_cli/log/behaviour_names.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "base/latency.hpp"
#include "base/link/text.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::ui {

BehaviourNames::BehaviourNames(const RunRecord& run) {
  constexpr std::string_view kAgent = "ecp-", kStatus = ".status";
  bool read = false, unread = false;  // what the task told
  for (const link::LoggedMessage& m : run.log().messages()) {
    if (m.channel == "task_status") {
      const auto s = link::decode<task_status_t>(m.bytes);
      (s ? read : unread) = true;
      if (!s) continue;
      if (const std::string name = link::get_text(s->behaviour); s->m != 0 && !name.empty())
        coordinator_.try_emplace(s->m, name);
      for (int k = 0; k < std::clamp(s->n_agents, 0, static_cast<int>(std::size(s->agent))); ++k)
        learn(link::get_text(s->agent[k]), s->agent_m[k], link::get_text(s->agent_behaviour[k]));
    } else if (m.channel.starts_with(kAgent) && m.channel.ends_with(kStatus)) {
      if (const auto s = link::decode<process_status_t>(m.bytes))
        learn(m.channel.substr(kAgent.size(), m.channel.size() - kAgent.size() - kStatus.size()), s->m,
              link::get_text(s->behaviour));
    }
  }
  if (unread && !read)
    missing_ = "behaviours of the task have numbers only: the log's task_status is of another version";
}

void BehaviourNames::learn(const std::string& arm, int m, const std::string& behaviour) {
  if (m != 0 && !behaviour.empty()) names_.try_emplace({arm, m}, behaviour);
}

std::string BehaviourNames::name(const std::string& arm, int m) const {
  const auto it = names_.find({arm, m});
  if (it != names_.end()) return it->second;
  const auto own = names_.lower_bound({arm, std::numeric_limits<int>::min()});
  const bool led = own == names_.end() || own->first.first != arm;
  const auto of_all = coordinator_.find(m);
  return led && of_all != coordinator_.end() ? of_all->second : "";
}

std::vector<TimeBand> behaviour_bands(const RunRecord& run, const BehaviourNames& names,
                                      const std::string& arm) {
  // A report's reading is of what the agent commanded when it reported the behaviour so many macrosteps before.
  return time_bands(
      run.log().messages<agent_report_t>(arm + ".report"),
      [&](const auto& report) {
        return static_cast<double>(report.first + latency::kCommandToReply) * run.macrostep_s();
      },
      [](const auto& report) { return report.second.m; }, [&](int m) { return names.name(arm, m); });
}

}  // namespace mrroc::ui
