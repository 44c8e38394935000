#include "mp/supervisor.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/program.hpp"
#include "mp/silence.hpp"

namespace mrroc::mp {
namespace {

using link::Phase;
using link::ProcessState;
using namespace std::chrono_literals;

constexpr auto kRepeat = 100ms;    // between the supervisor's own messages
constexpr auto kLook = 20ms;       // between looks at the children
constexpr auto kAssembling = 60s;  // until everybody must be there
constexpr auto kTellSkipped = 1s;  // between lines about lateness, of each process
constexpr auto kHang = 10s;        // without a sign of life
constexpr auto kComeToRest = 20s;  // for arms to come to rest after a stop

#ifdef MRROC_SANITIZED
constexpr bool kWatchHangs = false;  // sanitizers slow processes down without a bound
#else
constexpr bool kWatchHangs = true;
#endif

}  // namespace

struct Supervisor::Watched {
  Watched(link::Process& mp, Part p)
      : part(std::move(p)),
        status_in(mp.bus(), mp.route(part.name + ".status"), mp.membership().session_id),
        console_in(mp.bus(), mp.route(part.name + ".console"), mp.membership().session_id) {}

  Part part;
  link::Queue<process_status_t> status_in;
  link::Queue<console_t> console_in;
  process_status_t status{};
  ProcessState state{ProcessState::starting};
  Silence silence{Clock::now()};
  std::int64_t skipped_told{};
  Clock::time_point told_at{};
  std::optional<link::Child> child;
  std::atomic<bool> thread_ended{};
  std::jthread thread;
};

Supervisor::Supervisor(link::Process& mp, std::vector<Part> parts, const std::filesystem::path& messages,
                       std::chrono::milliseconds leave)
    : mp_(mp),
      out_(mp.bus(), mp.route("supervisor"), mp.membership().session_id),
      begun_(Clock::now()),
      leave_(leave),
      messages_(messages) {
  watched_.push_back(std::make_unique<Watched>(mp, Part{mp.membership().name, {}, {}, {}, {}}));
  for (Part& p : parts) watched_.push_back(std::make_unique<Watched>(mp, std::move(p)));
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

void Supervisor::start_processes(const std::vector<std::string>& common) {
  for (auto& w : watched_) {
    if (w->part.program.empty()) continue;
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), w->part.arguments.begin(), w->part.arguments.end());
    const bool here = w->part.start.empty();
    w->child.emplace(here ? program_beside(w->part.program) : program_folder() / w->part.program, arguments,
                     w->part.start);
    w->silence.hear(Clock::now());
  }
}

void Supervisor::start_threads(link::MemoryHub& hub) {
  for (auto& w : watched_) {
    if (!w->part.body) continue;
    link::Membership membership = mp_.membership();
    membership.name = w->part.name;
    w->thread = std::jthread([&hub, membership, body = w->part.body, &ended = w->thread_ended] {
      const auto bus = hub.open();
      link::Process process(*bus, membership);
      try {
        body(process);
      } catch (const FaultError& e) {
        process.report_fault(e.fault());
      } catch (const std::exception& e) {
        process.report_fault({.code = FaultCode::internal_error, .text = e.what()});
      }
      ended = true;
    });
  }
}

void Supervisor::poll() {
  hear();
  const auto now = Clock::now();
  if (now - last_look_ > kLook) {
    last_look_ = now;
    watch_children();
    watch_hangs();
  }
  lead();
  if (now - last_said_ > kRepeat) publish();
}

void Supervisor::hear() {
  for (auto& w : watched_) {
    while (const auto line = w->console_in.take())
      log(w->part.name, link::get_text(line->text), fault_code(line->code).value_or(FaultCode::none));
    while (const auto s = w->status_in.take()) {
      if (s->state < 0 || s->state >= static_cast<int>(ProcessState::dead)) continue;  // nobody says so
      const auto now = Clock::now();
      w->silence.hear(now);
      if (w->state == ProcessState::dead) continue;
      const bool leaves = s->state >= static_cast<int>(ProcessState::done);
      if (s->skipped > w->skipped_told && (leaves || now - w->told_at > kTellSkipped)) {
        log(w->part.name,
            fmt::format("late: {} skipped, {} in all", s->skipped - w->skipped_told, s->skipped),
            FaultCode::none);
        w->skipped_told = s->skipped;
        w->told_at = now;
      }
      if (s->m != w->status.m || !std::ranges::equal(s->behaviour, w->status.behaviour)) ++behaviours_begun_;
      w->status = *s;
      const auto state = static_cast<ProcessState>(s->state);
      const bool news = state != w->state;
      w->state = state;
      if (s->at_rest) {
        at_rest_ = true;
        std::ranges::copy(s->stop_steps, stop_steps_.begin());
      }
      if (news && state == ProcessState::faulted) {
        tell(from_message(s->fault));
      }
    }
  }
}

void Supervisor::watch_children() {
  for (auto& w : watched_) {
    if (w->thread_ended && w->state == ProcessState::faulted) tell_dead(*w);
    if (!w->child || !w->child->reap()) continue;
    if (w->child->ended_well() || ending_) {
      if (w->state < ProcessState::done) w->state = ProcessState::done;
      continue;
    }
    hear();
    if (w->state == ProcessState::faulted) {  // it has told why
      tell_dead(*w);
      continue;
    }
    Fault fault{.code = FaultCode::process_died, .process = w->part.name};
    fault.text = fmt::format("{} ended with {}", w->part.name, *w->child->ended());
    declare_dead(*w, fault);
  }
}

void Supervisor::watch_hangs() {
  if (!kWatchHangs) return;
  for (auto& w : watched_) {
    w->silence.look(Clock::now());
    if (!w->child || w->child->ended() || w->silence.counted() < kHang) continue;
    Fault fault{.code = FaultCode::process_hung, .process = w->part.name};
    fault.text = fmt::format("{} has not been heard for {} s", w->part.name, kHang.count());
    w->child->kill();
    declare_dead(*w, fault);
  }
}

void Supervisor::declare_dead(Watched& part, const Fault& fault) {
  part.state = ProcessState::dead;
  tell_dead(part);
  stop(fault, 0);
}

void Supervisor::tell_dead(const Watched& part) {
  const auto index =
      std::ranges::find_if(watched_, [&](const auto& w) { return w.get() == &part; }) - watched_.begin();
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
  } else if (Clock::now() - begun_ > kAssembling) {
    std::string missing;
    for (const auto& w : watched_)
      if (w->state < ProcessState::ready) missing += (missing.empty() ? "" : ", ") + w->part.name;
    stop({.code = FaultCode::not_ready,
          .text = fmt::format("not there after {} s: {}", kAssembling.count(), missing)},
         0);
  }
}

void Supervisor::stop(const Fault& reason, std::int64_t as_of) {
  if (!fault_) {
    fault_ = reason;
    // log() writes class and code itself.
    log(reason.process.empty() ? mp_.membership().name : std::string(reason.process.view()),
        fmt::format("{}; {}", what_happened(reason), fault_entry(reason.code).remedy), reason.code);
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

void Supervisor::tell(const Fault& fault) {
  if (fault_)
    log(std::string(fault.process.view()), describe(fault), fault.code);  // the first one is told by stop()
  stop(fault, 0);
}

void Supervisor::publish() {
  last_said_ = Clock::now();
  out_.publish(said_, 0);
}

bool Supervisor::all(ProcessState at_least) const {
  return std::ranges::all_of(watched_, [&](const auto& w) { return w->state >= at_least; });
}

bool Supervisor::world_is_dead() const {
  return std::ranges::any_of(
      watched_, [](const auto& w) { return w->part.name == "world" && w->state >= ProcessState::done; });
}

void Supervisor::end() {
  if (!fault_) {
    mp_.await([this] { return all(ProcessState::done) || fault_; });
  }
  if (fault_) {
    // Who runs for less than the time between two signs of life has told no step yet.
    if (led_ && watched_.size() > 1)
      mp_.await([this] { return at_rest_ || world_is_dead(); }, Clock::now() + kComeToRest);
  }
  ending_ = true;
  said_.phase = static_cast<int>(Phase::finished);
  publish();
  const auto gone = [this] {
    return std::ranges::all_of(watched_, [](const auto& w) {
      return (!w->child || w->child->ended()) && (!w->thread.joinable() || w->thread_ended);
    });
  };
  if (!mp_.await(gone, Clock::now() + leave_)) {
    for (auto& w : watched_)
      if (w->child) w->child->kill();
    mp_.await(gone, Clock::now() + leave_);
  }
  end_threads();
  hear();
}

void Supervisor::end_threads() {
  for (auto& w : watched_) {
    if (!w->thread.joinable()) continue;
    if (w->thread_ended) {
      w->thread.join();
      continue;
    }
    abandons_threads_ = true;
    tell({.code = FaultCode::process_hung,
          .process = w->part.name,
          .text = fmt::format("the thread {} does not end", w->part.name)});
  }
}

std::vector<PartStatus> Supervisor::parts() const {
  std::vector<PartStatus> all;
  for (const auto& w : watched_)
    all.push_back({w->part.name, w->state,
                   std::chrono::duration<double>(Clock::now() - w->silence.heard()).count(), w->status.m,
                   link::get_text(w->status.behaviour), link::get_text(w->status.ended_because)});
  return all;
}

std::int64_t Supervisor::skipped() const {
  std::int64_t sum = 0;
  for (const auto& w : watched_) sum += w->status.skipped;
  return sum;
}

std::uint64_t Supervisor::log_hash() const {
  std::map<std::string, const channel_hash_t*> by_channel;
  for (const auto& w : watched_) {
    if (w->status.state != static_cast<int>(ProcessState::done)) return 0;
    const auto told = std::min<std::size_t>(static_cast<std::size_t>(std::max(0, w->status.n_hashes)),
                                            std::size(w->status.hash));
    for (std::size_t k = 0; k < told; ++k)
      by_channel[link::get_text(w->status.hash[k].channel)] = &w->status.hash[k];
  }
  Hash hash;
  for (const auto& [channel, h] : by_channel) {
    hash.add(channel);
    hash.add(static_cast<std::uint64_t>(h->count));
    hash.add(static_cast<std::uint64_t>(h->hash));
  }
  return hash.value();
}

void Supervisor::log(const std::string& process, const std::string& text, FaultCode code) {
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  const std::string_view kind = code == FaultCode::none ? "info" : to_string(class_of(code));
  messages_ << fmt::format("{:10.3f}  {:10}  {:9}  {:20}  {}\n", seconds, process, kind,
                           code == FaultCode::none ? "-" : to_string(code), text)
            << std::flush;
  last_message_ = process + ": " + text;
  last_code_ = code;
}

}  // namespace mrroc::mp
