#include "base/link/process.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/counted.hpp"
#include "base/link/text.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;

// A wait that lasts this long may be for a lost message: own ones are repeated. What else arrives says
// nothing about that.
constexpr auto kRepeat = 100ms;
constexpr auto kStatusPeriod = 500ms;  // between signs of life
constexpr auto kReadyPeriod = 20ms;    // the same while assembling

}  // namespace

std::string_view to_string(ProcessState s) {
  switch (s) {
    case ProcessState::starting:
      return "starting";
    case ProcessState::ready:
      return "ready";
    case ProcessState::running:
      return "running";
    case ProcessState::done:
      return "done";
    case ProcessState::faulted:
      return "faulted";
    case ProcessState::dead:
      return "dead";
  }
  return "?";
}

std::string end_of_behaviour(std::string_view name, std::string_view until, std::string_view lasted) {
  return until.empty() ? fmt::format("{}, ended after {}", name, lasted) : fmt::format("{}: {}", name, until);
}

Process::Process(Bus& bus, NodeContext context)
    : bus_(bus),
      context_(std::move(context)),
      status_out_(bus, route(context_.name + ".status"), context_.session_id),
      console_out_(bus, route(context_.name + ".console"), context_.session_id),
      supervisor_in_(bus, route("supervisor"), context_.session_id) {
  put_text(status_.name, context_.name);
}

Process::~Process() = default;

Route Process::route(const std::string& name, Group group) const {
  return {group, context_.session + "." + name};
}

void Process::add(OutboxBase& box) {
  if (outboxes_.size() == std::size(status_.hash))
    throw FaultError(FaultCode::internal_error, "too many links in process " + context_.name);
  outboxes_.push_back(&box);
  sent_.push_back(box.channel());
}

bool Process::sends(std::string_view channel) const {
  return std::ranges::find(sent_, channel) != sent_.end();
}

void Process::in_behaviour(int m, std::string_view name, std::string_view until) {
  if (m == m_ && name == behaviour_) return;
  if (!behaviour_.empty())
    put_text(status_.ended_because,
             end_of_behaviour(behaviour_, until_, counted(status_.macrostep - behaves_since_, "macrostep")));
  m_ = m;
  behaviour_ = name;
  until_ = until;
  behaves_since_ = status_.macrostep;
  status_.m = m;
  put_text(status_.behaviour, name);
  send_status();
}

std::string Process::behaviour() const {
  return behaviour_.empty() ? std::string() : fmt::format("{}, {}", m_, behaviour_);
}

bool Process::assemble() {
  status_.state = static_cast<int>(ProcessState::ready);
  send_status();
  await([this] { return phase() != Phase::assembling; });
  status_.state = static_cast<int>(ProcessState::running);
  send_status();
  // A process that hears of a stop in a later macrostep before it has heard of the beginning takes part until then:
  // the others wait for it.
  return phase() == Phase::running || (phase() == Phase::stopping && stop_as_of() > 0);
}

void Process::service(Clock::time_point deadline) {
  const auto now = Clock::now();
  auto timeout = std::chrono::duration_cast<std::chrono::milliseconds>(kReadyPeriod);
  if (deadline != Clock::time_point::max())
    timeout = std::clamp(std::chrono::ceil<std::chrono::milliseconds>(deadline - now), 0ms, timeout);
  bus_.wait(timeout);
  if (now - waiting_since_ > kRepeat &&
      !unled()) {  // repetitions would fill what the system keeps for a process that is suspended
    waiting_since_ = now;
    for (OutboxBase* box : outboxes_) box->repeat();
  }
  const bool assembling = status_.state == static_cast<int>(ProcessState::ready);
  if (now - last_status_ > (assembling ? std::chrono::milliseconds(kReadyPeriod) : kStatusPeriod))
    send_status();
  if (on_service) on_service();
  watch_supervisor();
  confirm();
  count(Clock::now());
}

void Process::poll() {
  const auto now = Clock::now();
  while (bus_.wait(0ms)) {
  }
  if (now - last_status_ > kStatusPeriod) send_status();
  if (on_service) on_service();
  watch_supervisor();
  confirm();
}

bool Process::leads() const { return context_.roster.empty() || context_.name == context_.roster.front(); }

bool Process::unled() const { return !leads() && supervisor_.counted() > kSupervisorSilent; }

void Process::watch_supervisor() {
  if (leads() || context_.timeout.count() == 0) return;
  const Counters& c = supervisor_in_.counters();
  const auto now = Clock::now();
  if (const auto heard = c.received + c.repeated; heard != heard_) {
    heard_ = heard;
    supervisor_.hear(now);
    return;
  }
  supervisor_.look(now);
  if (!alone_ && !lock_step() && phase() == Phase::running && supervisor_.counted() > kSupervisorSilent)
    come_to_rest_alone();
  // A child on this host ends with its parent; on another host nobody tells it.
  if (context_.alone.count() > 0 && supervisor_.counted() > context_.alone)
    throw FaultError(FaultCode::peer_silent, "nothing has been heard of the supervisor");
}

void Process::come_to_rest_alone() {
  supervisor_t word = *this->word();
  word.phase = static_cast<int>(Phase::stopping);
  word.as_of = 0;
  own_word_ = word;
  alone_ = true;
  Fault fault{.code = FaultCode::supervisor_silent, .process = context_.roster.front()};
  fault.text = fmt::format("{} was not heard for {} ms by {}", context_.roster.front(),
                           kSupervisorSilent.count(), context_.name);
  log(fmt::format("{}: comes to rest without it", fault.text.view()), fault.code);
  report_fault(fault);
}

void Process::confirm() {
  const supervisor_t* const s = word();
  if (s && (s->phase != status_.phase || s->as_of != status_.as_of)) send_status();
}

void Process::begin_counting(Clock::time_point now) {
  counted_ = now;
  excused_ = {};
}

void Process::count(Clock::time_point now) {
  const Clock::duration passed = now - counted_;
  counted_ = now;
  excused_ +=
      unled() ? passed : std::max(Clock::duration{}, passed - Clock::duration(HeartbeatMonitor::kMostAtOnce));
}

const supervisor_t* Process::word() const {
  const supervisor_t* const heard = supervisor_in_.newest();
  if (!own_word_) return heard;
  const bool ends = alone_ && heard && heard->phase >= static_cast<int>(Phase::finished);
  return ends ? heard : &*own_word_;
}

Phase Process::phase() const {
  const supervisor_t* const s = word();
  if (!s) return Phase::assembling;
  return static_cast<Phase>(std::clamp(s->phase, 0, static_cast<int>(Phase::finished)));
}

std::int64_t Process::stop_as_of() const {
  const supervisor_t* const s = word();
  return s ? s->as_of : 0;
}

bool Process::dead(const std::string& name) const {
  const supervisor_t* const s = word();
  if (!s || s->dead == 0) return false;
  const auto it = std::ranges::find(context_.roster, name);
  return it != context_.roster.end() && (s->dead >> (it - context_.roster.begin()) & 1) != 0;
}

void Process::report_progress(std::int64_t macrostep, std::int64_t step) {
  status_.macrostep = macrostep;
  status_.step = step;
}

void Process::report_skipped(std::int64_t count) { status_.skipped += count; }

void Process::report_effector(int state) {
  const int effector = state + 1;
  if (effector == status_.effector) return;
  status_.effector = effector;
  if (over()) send_status();
}

void Process::report_rest(bool at_rest, int stop_steps) {
  status_.at_rest = at_rest;
  status_.stop_steps = stop_steps;
  send_status();
}

void Process::log(const std::string& text, FaultCode code) {
  console_t line{};
  put_text(line.process, context_.name);
  line.code = static_cast<int>(code);
  put_text(line.text, text);
  console_out_.publish(line, status_.macrostep);
}

void Process::log_counters() {
  for (const InboxBase* box : inboxes_) {
    const Counters& c = box->counters();
    if (c.malformed == 0 && c.foreign == 0 && c.gaps == 0) continue;
    log(fmt::format("{}: {} taken, {} malformed, {} of another session, {} missing",
                    std::string_view(box->channel()).substr(context_.session.size() + 1),
                    counted(c.received, "message"), c.malformed, c.foreign, c.gaps));
  }
  if (const Dropped d = bus_.dropped(); d != Dropped{})
    log(
        fmt::format("network: dropped {} that are no messages, {} forged, {} that came again, {} of too many "
                    "senders, {} by the kernel (no message, too large, or no room)",
                    d.malformed, d.forged, d.replayed, d.crowded, d.kernel));
}

void Process::seal_fingerprints() {
  if (status_.n_hashes > 0) return;
  for (const OutboxBase* box : outboxes_) {
    channel_hash_t& h = status_.hash[status_.n_hashes++];
    // The name of the session differs from run to run.
    put_text(h.channel, std::string_view(box->channel()).substr(context_.session.size()));
    h.hash = static_cast<std::int64_t>(box->hash());
    h.count = box->count();
  }
}

void Process::report_done() {
  log_counters();
  if (status_.state != static_cast<int>(ProcessState::faulted))
    status_.state = static_cast<int>(ProcessState::done);
  seal_fingerprints();
  send_status();
}

void Process::stay() {
  await([this] { return phase() == Phase::finished; });
}

void Process::report_fault(const Fault& fault) {
  status_.state = static_cast<int>(ProcessState::faulted);
  status_.fault.code = static_cast<int>(fault.code);
  status_.fault.axis = fault.axis;
  status_.fault.value = fault.value;
  status_.fault.limit = fault.limit;
  put_text(status_.fault.process,
           fault.process.empty() ? std::string_view(context_.name) : fault.process.view());
  put_text(status_.fault.text, fault.text.view());
  send_status();
}

void Process::send_status() {
  last_status_ = Clock::now();
  if (const supervisor_t* const s = word()) {
    status_.phase = s->phase;
    status_.as_of = s->as_of;
  }
  status_out_.publish(status_, status_.macrostep);
}

}  // namespace mrroc::link
