#include "mp/solo_run.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/agent_images.hpp"
#include "base/linked_port.hpp"

namespace mrroc::mp {

/// c_c0: what the arms are told of one another, constant during a run; and whether a trigger is for the present behaviour.
struct SoloRun::DormantMemory {
  Coordinate* coordinate{};
  Ask* ask{};
  int m{};                 // behaviour of the first arm
  std::int64_t trigger{};  // triggers before it began
};

/// The coordinator: starts and pauses its arms, and waits until they are done.
struct SoloRun::Dormant : CoordinatorAgent<DormantMemory, std::dynamic_extent, None, SensorSetting> {
  static Memory retain(const X& x) { return x.c; }
  static Memory note_trigger(const X& x) {
    Memory c = x.c;
    const int m = x.T.agent.front().m;
    if (m != c.m) c.trigger = x.T.h.trigger;
    c.m = m;
    return c;
  }
  static None nothing(const X&) { return {}; }
  static SensorSetting no_question(const X&) { return {}; }
  static SensorSetting question(const X& x) { return x.c.ask ? x.c.ask(x.T.agent) : SensorSetting{}; }
  static std::vector<Order> orders(const X& x, SoloOrder m, bool finished) {
    return std::vector<Order>(x.T.agent.size(), {.m = static_cast<int>(m), .finished = finished});
  }
  static std::vector<Order> wait(const X& x) { return orders(x, SoloOrder::wait, false); }
  static std::vector<Order> work(const X& x) {
    std::vector<Order> y = orders(x, x.T.h.paused ? SoloOrder::pause : SoloOrder::work, false);
    y.front().go_on[0] = x.T.agent.front().m == x.c.m && x.T.h.trigger > x.c.trigger;
    if (x.c.coordinate) x.c.coordinate(x.T.agent, y);
    return y;
  }
  static bool may_start(const X& x) {
    return x.T.h.started && std::ranges::all_of(x.T.agent, &Report::ready);
  }
  static bool all_done(const X& x) {
    return std::ranges::all_of(x.T.agent, [](const Report& r) { return r.event == kWorkDone; });
  }

  static constexpr Motion<Dormant> wait_for_start();
  static constexpr Motion<Dormant> wait_for_end();
};

constexpr Motion<SoloRun::Dormant> SoloRun::Dormant::wait_for_start() {
  return {0, "wait for start", retain, retain, nothing, no_question, wait, may_start, "start, arms ready"};
}
constexpr Motion<SoloRun::Dormant> SoloRun::Dormant::wait_for_end() {
  return {1, "the arms work", retain, note_trigger, nothing, question, work, all_done, "all arms are done"};
}

SoloRun::SoloRun(TaskRun& run, const SoloParameters& parameters)
    : run_(run),
      k_(parameters),
      operator_(parameters.make_operator ? parameters.make_operator(run, parameters.gives_start)
                                         : std::make_unique<AutoStartOperator>(
                                               run.process(), run.command_server(), parameters.gives_start)),
      setting_out_(parameters.ask ? std::optional<link::OutgoingLink<SensorSetting>>(
                                        std::in_place, run.process(), parameters.sensor)
                                  : std::nullopt),
      links_(run.process(), parameters.arms, *operator_, TaskClock::ramped(), others()),
      recorder_(parameters.arms.size(), TraceNumbers::agents, parameters.dt, parameters.n_s),
      traces_(parameters.arms.size()),
      m_(parameters.arms.size()) {}

link::OtherLinks SoloRun::others() {
  link::OtherLinks all = k_.others;
  if (setting_out_) all.outgoing.push_back(&*setting_out_);
  return all;
}

Outcome SoloRun::execute() {
  using X = Dormant::X;
  const auto observe_x = [this](const Motion<Dormant>& motion, const X& x) {
    observe(x.T.agent, motion.m == 1);
  };
  CoordinatorPort<Dormant, decltype(observe_x)> links(links_, observe_x);
  const auto give = [this](const Dormant::Y& y) {
    if (setting_out_) setting_out_->set(y.V);
  };
  LinkedPort port(links, give, [](X&) {});
  X x;
  x.c.coordinate = k_.coordinate;
  x.c.ask = k_.ask;
  x.T.agent.resize(k_.arms.size());
  if (const Outcome o = links_.begin({}); o != Outcome::terminated) return o;
  port.read(x);
  Outcome o = move(Dormant::wait_for_start(), x, port);
  if (o == Outcome::terminated) o = move(Dormant::wait_for_end(), x, port);
  if (o != Outcome::terminated) return o;
  links_.send(Dormant::orders(x, SoloOrder::wait, true));
  run_.board().set_progress(1, "done");
  return o;
}

double SoloRun::progress(bool working) {
  if (!working) return 0;
  const double time = links_.clock().now().time;
  if (!working_since_) working_since_ = time;
  if (k_.lasts > 0) return std::min(1.0, (time - *working_since_) / static_cast<double>(k_.lasts));
  const Report& r = links_.report(0);
  if (r.event == kWorkDone) return 1;
  return std::max(0.0, (r.m - 1) / static_cast<double>(std::max<std::size_t>(1, k_.behaviours.size())));
}

void SoloRun::observe(std::span<const Report> reports, bool working) {
  const std::int64_t i = links_.i();
  recorder_.note(i, 0, reports);
  if (working) recorder_.add_rows(traces_);
  if (k_.watch) k_.watch();
  show(working);
  run_.each_macrostep(i, static_cast<double>(i) * k_.n_s * k_.dt);
}

bool SoloRun::waits_for_trigger(int m) const {
  const auto number = static_cast<std::size_t>(std::max(0, m));
  return number >= 1 && number <= k_.behaviours.size() && k_.behaviours[number - 1].by_trigger;
}

void SoloRun::show(bool working) {
  run_.set_state(!working                  ? TaskState::waiting_for_start
                 : links_.clock().paused() ? TaskState::paused
                                           : TaskState::running,
                 working && waits_for_trigger(links_.report(0).m));
  for (std::size_t arm = 0; arm < m_.size(); ++arm) {
    const Report& r = links_.report(arm);
    const auto number = static_cast<std::size_t>(std::max(0, r.m));
    const BehaviourWords words = number >= 1 && number <= k_.behaviours.size() ? k_.behaviours[number - 1]
                                 : r.event == kWorkDone                        ? BehaviourWords{"done"}
                                                        : BehaviourWords{"waits", "start given"};
    if (working && r.m != m_[arm])
      run_.announce()(static_cast<double>(links_.i()) * k_.n_s * k_.dt,
                      fmt::format("{}  m = {}  {}", k_.arms[arm], r.m, words.name));
    if (arm == 0) {
      run_.board().set_behaviour(r.m, words.name, words.until);
      run_.board().set_progress(progress(working), words.name);
    }
    run_.board().set_arm(arm, r, "");
    m_[arm] = r.m;
  }
}

}  // namespace mrroc::mp
