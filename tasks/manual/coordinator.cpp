#include "tasks/manual/coordinator.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tasks/manual/arm.hpp"

namespace mrroc::manual {
namespace {

using X = Coordinator::X;

bool idle(const X& x) {
  for (std::size_t arm = 0; arm < x.c.given.size(); ++arm)
    if (x.T.agent[arm].event != x.c.given[arm].number) return false;
  return true;
}

std::vector<ManualOrder> orders(const X& x) {
  std::vector<ManualOrder> given = x.c.given;
  for (std::size_t arm = 0; arm < given.size(); ++arm)
    if (const auto& wanted = x.T.hands.orders[arm]) {
      const std::int64_t number = given[arm].number + 1;
      given[arm] = *wanted;
      given[arm].number = number;
    }
  return given;
}

Nothing nothing(const X&) { return {}; }
Coordinator::Memory retain(const X& x) { return x.c; }
Coordinator::Memory given(const X& x) { return {orders(x)}; }

Coordinator::Said pass_on(const X& x) {
  const Order order{.m = static_cast<int>(x.T.h.paused ? SoloOrder::pause : SoloOrder::work)};
  return {std::vector<Order>(x.T.agent.size(), order), orders(x)};
}

/// @return instructions that any arm has got
std::int64_t taken(const X& x) {
  std::int64_t sum = 0;
  for (const ManualOrder& o : x.c.given) sum += o.number;
  return sum;
}

std::vector<std::string> keys_of(const std::vector<ArmInfo>& arms) {
  std::vector<std::string> keys;
  for (const ArmInfo& a : arms) keys.push_back(a.key);
  return keys;
}

bool ended(const X& x) { return x.T.hands.end && idle(x); }

}  // namespace

const Motion<Coordinator> kManualOperation{
    1, "manual operation", retain, given, nothing, nothing, pass_on, ended, "the operator's end, arms idle"};

Coordinator::Said farewell(const Coordinator::X& x) {
  const Order over{.m = static_cast<int>(SoloOrder::work), .finished = true};
  return {std::vector<Order>(x.T.agent.size(), over), x.c.given};
}

/// Connects Move with the links.
class ManualRun::Port {
 public:
  explicit Port(ManualRun& run) : run_(run) {}
  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    run_.links_.in_behaviour(motion.m, motion.name, motion.until);
    run_.send(y.T);
    given_ = y.c.given;
  }
  Outcome wait() { return run_.links_.wait(); }
  void read(X& x) {
    x.c.given = given_;
    run_.read(x);
  }

 private:
  ManualRun& run_;
  std::vector<ManualOrder> given_;
};

ManualRun::ManualRun(mp::TaskRun& run, const ManualParameters& parameters)
    : run_(run),
      k_(parameters),
      operator_(run.process(), run.command_server(), false),
      links_(run.process(), keys_of(parameters.arms), operator_),
      command_server_(run.process(), parameters.arms, parameters.script, parameters.record),
      m_(parameters.arms.size()),
      tripped_(parameters.arms.size()) {
  for (const ArmInfo& arm : k_.arms)
    manual_out_.push_back(run.process().outbox<manual_order_t>(arm.key + ".manual"));
  if (k_.script.empty()) run_.set_attended();
}

Outcome ManualRun::execute() {
  X x;
  x.c.given.resize(k_.arms.size());
  for (const auto& out : manual_out_) out->publish(to_message(ManualOrder{}), 1);
  if (const Outcome o = links_.begin({}); o != Outcome::terminated) return o;
  read(x);
  Port port(*this);
  const Outcome o = move(kManualOperation, x, port);
  if (o == Outcome::terminated) send(farewell(x));
  return o;
}

void ManualRun::send(const Coordinator::Said& said) {
  for (std::size_t arm = 0; arm < manual_out_.size(); ++arm)
    manual_out_[arm]->publish(to_message(said.manual[arm]), links_.i() + 1);
  links_.send(said.order);
}

void ManualRun::read(X& x) {
  const bool end = x.T.hands.end;
  x.i = links_.i();
  x.T.h = links_.operator_image();
  x.T.agent.clear();
  for (std::size_t arm = 0; arm < k_.arms.size(); ++arm) x.T.agent.push_back(links_.report(arm));
  std::vector<std::int64_t> numbers;
  for (const ManualOrder& o : x.c.given) numbers.push_back(o.number);
  x.T.hands = command_server_.take(x.i, numbers, x.T.agent, x.T.h.paused);
  x.T.hands.end = x.T.hands.end || end;
  show(x);
  run_.set_idle(!k_.script.empty() && command_server_.over() && !x.T.hands.end && idle(x));
  run_.each_macrostep(x.i, static_cast<double>(x.i) * k_.macrostep_s);
  report_trips(x);
}

void ManualRun::show(const X& x) {
  run_.set_state(links_.clock().paused() ? TaskState::paused : TaskState::running, false);
  run_.board().set_behaviour(kManualOperation.m, kManualOperation.name, kManualOperation.until);
  run_.board().set_progress(-1, fmt::format("instructions taken: {}", taken(x)));
  for (std::size_t arm = 0; arm < m_.size(); ++arm) {
    const Report& r = x.T.agent[arm];
    const auto m = static_cast<std::size_t>(std::clamp(r.m, 1, static_cast<int>(kManual.size())));
    if (r.m != m_[arm])
      run_.announce()(static_cast<double>(x.i) * k_.macrostep_s,
                      fmt::format("{}  {}{}", k_.arms[arm].key, kManual[m - 1].name,
                                  r.fault ? ": " + describe(r.fault) : ""));
    m_[arm] = r.m;
    run_.board().set_arm(arm, r, "");
  }
}

void ManualRun::report_trips(const X& x) {
  for (std::size_t arm = 0; arm < tripped_.size(); ++arm) {
    const Report& r = x.T.agent[arm];
    const bool tripped = r.driver_state == DriverState::faulted;
    // Which fault it is comes later, or is not told again, where a command on its way was refused.
    if (tripped && r.fault && !tripped_[arm] && r.fault.code != FaultCode::emergency_stop) {
      const std::string& key = k_.arms[arm].key;
      run_.announce()(static_cast<double>(x.i) * k_.macrostep_s,
                      fmt::format("{}  fault: {}", key, describe(r.fault)));
      Fault fault = r.fault;
      fault.process = "edp-" + key;
      run_.report_recoverable_fault(fault,
                                    fmt::format("remove the cause, then `ui_cli manual reset {}`", key));
    }
    tripped_[arm] = tripped && (tripped_[arm] || r.fault);
  }
}

}  // namespace mrroc::manual
