#include "mp/coordinated_run.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mrroc::mp {

CoordinatedLinks::CoordinatedLinks(TaskRun& run, const CoordinatedParameters& parameters)
    : run_(run),
      k_(parameters),
      operator_(parameters.make_operator ? parameters.make_operator(run, parameters.gives_start)
                                         : std::make_unique<AutoStartOperator>(
                                               run.process(), run.command_server(), parameters.gives_start)),
      links_(run.process(), parameters.arms, *operator_, parameters.clock),
      recorder_(parameters.arms.size(), TraceNumbers::coordinator, parameters.dt, parameters.n_s),
      traces_(parameters.arms.size()) {}

Outcome CoordinatedLinks::begin() {
  Order first;
  first.arm.n_s = static_cast<std::uint16_t>(k_.n_s);
  first.arm.n_Q = static_cast<std::uint16_t>(k_.n_s - 1);
  return links_.begin(first);
}

void CoordinatedLinks::observe(int m, std::string_view name, std::string_view until,
                               std::span<const Report> reports) {
  const std::int64_t i = links_.i();
  const double now = static_cast<double>(i) * k_.n_s * k_.dt;
  recorder_.note(i, m, reports);
  recorder_.add_rows(traces_);
  if (m != m_) run_.announce()(now, fmt::format("m = {}  {}", m, name));
  m_ = m;
  run_.set_state(m == 0                    ? TaskState::waiting_for_start
                 : links_.clock().paused() ? TaskState::paused
                                           : TaskState::running,
                 std::ranges::find(k_.by_trigger, m) != k_.by_trigger.end());
  run_.board().set_behaviour(m, name, until);
  run_.board().set_progress(-1, std::string(name));
  for (std::size_t arm = 0; arm < reports.size(); ++arm) run_.board().set_arm(arm, reports[arm], "");
  run_.each_macrostep(i, now);
}

void CoordinatedLinks::finish() {
  Order last;
  last.arm.n_s = static_cast<std::uint16_t>(k_.n_s);
  last.arm.n_Q = static_cast<std::uint16_t>(k_.n_s - 1);
  last.finished = true;
  links_.send(std::vector<Order>(k_.arms.size(), last));
  run_.board().set_progress(1, "done");
}

}  // namespace mrroc::mp
