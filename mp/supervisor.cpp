#include "mp/supervisor.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/link/text.hpp"
#include "base/with_remedy.hpp"

namespace mrroc::mp {
namespace {

using link::Phase;
using link::ProcessState;
using namespace std::chrono_literals;

constexpr auto kRepeat = 100ms;      // between the supervisor's own messages
constexpr auto kLook = 20ms;         // between looks at the children
constexpr auto kComeToEnd = 1s;      // for a process to end by a signal
constexpr int kLastMacrosteps = 20;  // that all make meanwhile

#ifdef MRROC_SANITIZED
constexpr bool kWatchHangs = false;  // sanitizers slow processes down without a bound
#else
constexpr bool kWatchHangs = true;
#endif

double in_seconds(std::chrono::milliseconds time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

bool is_operators_word(FaultCode reason) {
  return reason == FaultCode::operator_stop || reason == FaultCode::interrupted ||
         reason == FaultCode::emergency_stop;
}

Supervisor::Supervisor(link::Process& mp, std::vector<NodeSpec> nodes, const std::filesystem::path& messages,
                       const SupervisorTimes& times)
    : mp_(mp),
      out_(mp.bus(), mp.route("supervisor"), mp.context().session_id),
      assembling_(Clock::now()),
      escalation_(Clock::now()),
      times_(times),
      messages_(messages) {
  nodes_.push_back(std::make_unique<SupervisedNode>(mp, NodeSpec{.name = mp.context().name}));
  for (NodeSpec& p : nodes) nodes_.push_back(std::make_unique<SupervisedNode>(mp, std::move(p)));
  mp_.on_service = [this] { poll(); };
}

Supervisor::~Supervisor() {
  if (abandons_threads_) {  // they use what would be destroyed now
    std::fflush(nullptr);
    std::_Exit(exit_status(FaultCode::process_hung));
  }
  mp_.on_service = nullptr;
  if (said_.phase != static_cast<int>(Phase::finished)) {
    said_.phase = static_cast<int>(Phase::finished);
    publish();  // threads must end before their handles do
  }
}

void Supervisor::start_processes(const std::vector<std::string>& common, const std::string& input) {
  for (const auto& node : nodes_) node->start_process(common, input);
}

void Supervisor::start_threads(link::MemoryHub& hub) {
  for (const auto& node : nodes_) node->start_thread(hub, mp_.context());
}

void Supervisor::poll() {
  hear();
  const auto now = Clock::now();
  if (now - last_look_ > kLook) {
    last_look_ = now;
    watch_children();
    watch_hangs();
    watch_leavers();
    watch_stop();
  }
  lead();
  if (now - last_said_ > kRepeat) publish();
}

void Supervisor::hear() {
  for (const auto& node : nodes_) {
    while (const auto line = node->take_line())
      messages_.write(node->name(), link::get_text(line->text),
                      fault_code(line->code).value_or(FaultCode::none));
    while (const auto news = node->take_status(Clock::now())) {
      if (news->late > 0)
        messages_.write(node->name(),
                        fmt::format("late: {} skipped, {} in all", news->late, node->status().skipped),
                        FaultCode::none);
      if (news->begun) ++behaviours_begun_;
      if (news->fault) log_and_stop(*news->fault);
    }
  }
}

void Supervisor::watch_children() {
  for (const auto& node : nodes_) {
    if (node->thread_ended() && node->state() == ProcessState::faulted) publish_dead(*node);
    link::Child* const child = node->child();
    if (!child || !child->reap()) continue;
    const bool well = child->ended_well();
    if (ending_ || (well && fault_)) {
      if (node->state() < ProcessState::done) node->set_state(ProcessState::done);
      continue;
    }
    hear();
    if (node->state() == ProcessState::faulted) {  // it has told why
      publish_dead(*node);
      continue;
    }
    // Nobody leaves before he is told to.
    Fault fault{.code = well ? FaultCode::ended_early : FaultCode::process_died, .process = node->name()};
    fault.text = fmt::format("{} ended with {}{}", node->name(), *child->ended(),
                             well ? " while the system was running" : "");
    declare_dead(*node, fault);
  }
}

void Supervisor::watch_hangs() {
  if (!kWatchHangs) return;
  for (const auto& node : nodes_) {
    const auto silence = node->silence(Clock::now());
    link::Child* const child = node->child();
    if (!child || child->ended() || silence < times_.hang) continue;
    Fault fault{.code = FaultCode::process_hung, .process = node->name()};
    fault.text = fmt::format("{} has not been heard for {:g} s", node->name(), in_seconds(times_.hang));
    child->kill();
    declare_dead(*node, fault);
  }
}

// A node that has done its work stays until the system ends. Before the task's program has come to its end
// nobody can have.
void Supervisor::watch_leavers() {
  if (program_ended_ || fault_ || said_.phase != static_cast<int>(Phase::running)) return;
  for (const auto& node : nodes_) {
    if (node == nodes_.front() || node->state() != ProcessState::done) continue;
    if (node->left(Clock::now()) < times_.leaves) continue;
    Fault fault{.code = FaultCode::ended_early, .process = node->name()};
    fault.text = fmt::format("{} says that it is done, and the task is not", node->name());
    stop(fault, 0);
  }
}

bool Supervisor::stop_confirmed() const {
  return said_.phase >= static_cast<int>(Phase::stopping) &&
         std::all_of(nodes_.begin() + 1, nodes_.end(),
                     [this](const auto& node) { return node->confirms(said_.as_of); });
}

void Supervisor::watch_stop() {
  if (said_.phase < static_cast<int>(Phase::stopping) || stop_confirmed())
    return escalation_.settle(Clock::now());
  escalation_.wait(Clock::now());
  if (!kWatchHangs || ending_ || !fault_ || !escalation_.asks()) return;
  for (const auto& node : nodes_) {
    if (node == nodes_.front() || node->confirms(said_.as_of)) continue;
    if (!node->asked_to_end)
      ask_to_end(*node);
    else if (escalation_.kills())
      kill_unconfirmed(*node);
  }
}

void Supervisor::ask_to_end(SupervisedNode& node) {
  const double time = in_seconds(escalation_.timeout());
  node.asked_to_end = true;
  escalation_.add(node.name());
  const bool ordered = is_operators_word(fault_->code) || fault_->code == FaultCode::stop_not_confirmed;
  if (ordered && led_) {  // before that nothing moves
    fault_ = Fault{.code = FaultCode::stop_not_confirmed, .process = node.name()};
    fault_->text = fmt::format("not confirmed in {:.1f} s by {}", time, escalation_.unconfirmed());
  }
  alarm(node, fmt::format("{} has not confirmed the stop in {:.1f} s: {}", node.name(), time,
                          node.child() ? "SIGTERM" : "it is a thread, with which the whole program ends"));
  if (node.child()) node.child()->terminate();
}

void Supervisor::kill_unconfirmed(SupervisedNode& node) {
  if (!node.child()) return;
  alarm(node, fmt::format("{} does not end by SIGTERM either: SIGKILL", node.name()));
  node.child()->kill();
  declare_dead(node, {.code = FaultCode::stop_not_confirmed, .process = node.name()});
}

void Supervisor::alarm(const SupervisedNode& node, const std::string& line) {
  messages_.write(node.name(), line, FaultCode::stop_not_confirmed);
  if (on_alarm) on_alarm(line);
}

void Supervisor::kill_all() {
  for (const auto& node : nodes_) {
    if (!node->child() || node->child()->ended()) continue;
    node->child()->kill();
    node->set_state(ProcessState::dead);
    publish_dead(*node);
  }
}

void Supervisor::declare_dead(SupervisedNode& node, const Fault& fault) {
  node.set_state(ProcessState::dead);
  publish_dead(node);
  stop(fault, 0);
}

void Supervisor::publish_dead(const SupervisedNode& node) {
  const auto index =
      std::ranges::find_if(nodes_, [&](const auto& n) { return n.get() == &node; }) - nodes_.begin();
  const std::int64_t bit = std::int64_t{1} << index;
  if ((said_.dead & bit) != 0) return;
  said_.dead |= bit;
  publish();
}

void Supervisor::lead() {
  if (said_.phase != static_cast<int>(Phase::assembling)) return;
  if (all(ProcessState::ready)) {
    said_.phase = static_cast<int>(Phase::running);
    led_ = true;
    publish();
    return;
  }
  assembling_.look(Clock::now());
  if (assembling_.counted() > times_.assembling) {
    std::string missing;
    for (const auto& node : nodes_)
      if (node->state() < ProcessState::ready) missing += (missing.empty() ? "" : ", ") + node->name();
    stop({.code = FaultCode::not_ready,
          .text = fmt::format("not there after {:g} s: {}", in_seconds(times_.assembling), missing)},
         0);
  }
}

void Supervisor::stop(const Fault& reason, std::int64_t as_of) {
  if (!fault_) {
    fault_ = reason;
    // The log writes class and code itself.
    messages_.write(reason.process.empty() ? mp_.context().name : std::string(reason.process.view()),
                    with_remedy(what_happened(reason), fault_entry(reason.code).remedy), reason.code);
  }
  if (said_.phase >= static_cast<int>(Phase::stopping)) {
    // A death in a system that stops already must not wait for the agreed macrostep.
    if (as_of == 0 && said_.as_of != 0) {
      said_.as_of = 0;
      publish();
    }
    return;
  }
  said_.phase = static_cast<int>(Phase::stopping);
  said_.as_of = as_of;
  publish();
}

void Supervisor::log_and_stop(const Fault& fault) {
  if (fault_ && fault_->code == fault.code && fault_->process.view() == fault.process.view()) return;
  if (fault_)
    messages_.write(fault.process.view(), describe(fault), fault.code);  // the first one is told by stop()
  stop(fault, 0);
}

void Supervisor::publish() {
  last_said_ = Clock::now();
  if (!mp_.context().replayed) mp_.lead(said_);  // a replay hears what was said in the run
  out_.publish(said_, 0);
}

bool Supervisor::all(ProcessState at_least) const {
  return std::ranges::all_of(nodes_, [&](const auto& node) { return node->state() >= at_least; });
}

// What a driver that is dead has told last may be of a time when its robot stood.
bool Supervisor::robots_rest() const {
  return std::ranges::all_of(
      nodes_, [this](const auto& node) { return node->ended() ? plant_rests(*node) : node->rests(); });
}

// A driver that has done its work has left its robot at rest.
bool Supervisor::plant_rests(const SupervisedNode& driver) const {
  if (driver.plant().empty() || driver.state() == ProcessState::done) return true;
  const auto plant =
      std::ranges::find_if(nodes_, [&](const auto& node) { return node->name() == driver.plant(); });
  return plant == nodes_.end() || (*plant)->ended() || (*plant)->state() == ProcessState::faulted ||
         (*plant)->status().at_rest;
}

std::optional<int> Supervisor::stop_steps() const {
  std::optional<int> most;
  for (const auto& node : nodes_)
    if (const auto steps = node->stop_steps()) most = std::max(most.value_or(0), *steps);
  return most;
}

bool Supervisor::await_for(std::chrono::milliseconds time, const std::function<bool()>& ready) {
  link::HeartbeatMonitor waited(Clock::now());
  bool there = false;
  mp_.await([&] {
    waited.look(Clock::now());
    there = ready();
    return there || waited.counted() > time;
  });
  return there;
}

void Supervisor::await_work() {
  const auto last =
      std::chrono::duration_cast<std::chrono::milliseconds>(mp_.context().macrostep * kLastMacrosteps);
  const auto done = [this] { return all(ProcessState::done) || fault_; };
  if (!kWatchHangs) {
    mp_.await(done);
    return;
  }
  if (await_for(times_.finish + last, done)) return;
  for (const auto& node : nodes_)
    if (node->state() < ProcessState::done && !fault_)
      log_and_stop({.code = FaultCode::process_hung,
                    .process = node->name(),
                    .text = fmt::format("the task is over, and {} does not come to its end", node->name())});
}

void Supervisor::end() {
  program_ended_ = true;
  if (!fault_) await_work();
  if (fault_ && led_) await_for(times_.come_to_rest, [this] { return robots_rest(); });
  // Nodes that have not confirmed are ended and named before the others are let go.
  if (fault_ && kWatchHangs)
    await_for(StopEscalation::kConfirm + StopEscalation::kTerminate + kComeToEnd,
              [this] { return stop_confirmed(); });
  let_go();
  end_threads();
  mp_.poll();  // their last words may have come after the last look
  hear();
}

void Supervisor::let_go() {
  ending_ = true;
  said_.phase = static_cast<int>(Phase::finished);
  publish();
  const auto gone = [this] {
    return std::ranges::none_of(nodes_, [](const auto& node) { return node->runs(); });
  };
  if (mp_.await(gone, Clock::now() + times_.leave)) return;
  for (const auto& node : nodes_)
    if (node->child()) node->child()->kill();
  mp_.await(gone, Clock::now() + times_.leave);
}

void Supervisor::end_threads() {
  for (const auto& node : nodes_) {
    if (node->join()) continue;
    abandons_threads_ = true;
    log_and_stop({.code = FaultCode::process_hung,
                  .process = node->name(),
                  .text = fmt::format("the thread {} does not end", node->name())});
  }
}

std::vector<NodeStatus> Supervisor::node_statuses() const {
  std::vector<NodeStatus> all;
  for (const auto& node : nodes_) all.push_back(node->summary(Clock::now()));
  return all;
}

std::int64_t Supervisor::skipped() const {
  std::int64_t sum = 0;
  for (const auto& node : nodes_) sum += node->status().skipped;
  return sum;
}

}  // namespace mrroc::mp
