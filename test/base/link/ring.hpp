// A system of dummy agents in a ring, each in its own thread, and a supervisor that leads them: for the rules
// of time (docs/architecture.md), over any transport.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::link::test {

inline const std::vector<std::string> kRoster{"boss", "a", "b", "c"};

inline NodeContext context_of(const std::string& name, std::int64_t session_id = 1) {
  NodeContext m;
  m.session = "ring";
  m.session_id = session_id;
  m.name = name;
  m.roster = kRoster;
  return m;
}

/// Actions of a dummy agent besides its part in the ring.
struct Behaviour {
  std::int64_t macrosteps{100};
  std::int64_t dies_in{};  ///< says nothing any more from this macrostep on; 0: never
  std::atomic<bool>* died{};
};

/// The end of an agent.
struct Trace {
  std::int64_t ended_in{};   ///< first macrostep that it did not compute
  std::int64_t silent_in{};  ///< first macrostep computed without a living predecessor; 0: none
  std::int64_t value{};
};

/// Computes macrostep i from the messages stamped i alone: rule R1.
inline Trace run_agent(Bus& bus, const NodeContext& me, const std::string& before,
                       const Behaviour& behaviour) {
  Process process(bus, me);
  const auto in = process.inbox<operator_order_t>(before + ".out");
  const auto out = process.outbox<operator_order_t>(me.name + ".out");
  Trace trace;
  trace.value = std::int64_t{static_cast<unsigned char>(me.name[0])};
  const auto publish = [&](std::int64_t stamp) {
    operator_order_t m{};
    m.id = trace.value;
    out->publish(m, stamp);
  };
  if (!process.assemble()) return trace;
  publish(1);
  for (std::int64_t i = 1; i <= behaviour.macrosteps; ++i) {
    trace.ended_in = i;
    if (i == behaviour.dies_in) {
      if (behaviour.died) *behaviour.died = true;
      return trace;
    }
    const auto stopped = [&] { return process.over() && i >= process.stop_as_of(); };
    process.await([&] { return in->at(i) || stopped() || process.dead(before); });
    if (stopped()) break;
    if (!in->at(i) && trace.silent_in == 0) trace.silent_in = i;
    const std::uint64_t x = static_cast<std::uint64_t>(trace.value) * 6364136223846793005U +
                            static_cast<std::uint64_t>(in->at(i) ? in->at(i)->id : -1) + 1442695040888963407U;
    trace.value = static_cast<std::int64_t>(x);
    publish(i + 1);
    process.report_progress(i, 10 * i);
    trace.ended_in = i + 1;
  }
  process.report_done();
  process.stay();
  return trace;
}

/// A supervisor without duties of its own.
class Boss {
 public:
  explicit Boss(Bus& bus, std::int64_t session_id = 1)
      : process_(bus, context_of("boss", session_id)), out_(bus, process_.route("supervisor"), session_id) {
    for (const std::string& name : kRoster)
      status_in_.push_back(
          std::make_unique<Queue<process_status_t>>(bus, process_.route(name + ".status"), session_id));
    process_.on_service = [this] {
      for (std::size_t k = 0; k < kRoster.size(); ++k)
        while (const auto s = status_in_[k]->take()) status[kRoster[k]] = *s;
      if (Process::Clock::now() - said_at_ > std::chrono::milliseconds(20)) say();
    };
  }

  std::map<std::string, process_status_t> status;  ///< last one of each

  [[nodiscard]] bool is(const std::string& name, ProcessState state) const {
    const auto it = status.find(name);
    return it != status.end() && it->second.state == static_cast<int>(state);
  }
  [[nodiscard]] bool all(ProcessState state) const {
    return is("a", state) && is("b", state) && is("c", state);
  }
  void say(Phase phase, std::int64_t as_of = 0) {
    said_.phase = static_cast<int>(phase);
    said_.as_of = as_of;
    say();
  }
  void declare_dead(std::size_t index) {
    said_.dead |= std::int64_t{1} << index;
    say();
  }
  /// @return false when it took more than a minute: on a busy host every step waits for a core
  template <class Ready>
  bool await(Ready ready) {
    return process_.await(ready, Process::Clock::now() + std::chrono::minutes(1));
  }
  Process& process() { return process_; }

 private:
  void say() {
    said_at_ = Process::Clock::now();
    out_.publish(said_, 0);
  }

  Process process_;
  Outbox<supervisor_t> out_;
  std::vector<std::unique_ptr<Queue<process_status_t>>> status_in_;
  supervisor_t said_{};
  Process::Clock::time_point said_at_{};
};

/// @return the fingerprints that a process told with its last status, by channel
inline std::map<std::string, std::int64_t> hashes_of(const process_status_t& status) {
  std::map<std::string, std::int64_t> hashes;
  for (int k = 0; k < status.n_hashes; ++k) hashes[get_text(status.hash[k].channel)] = status.hash[k].hash;
  return hashes;
}

/// Agents a, b, c and their boss.
class Ring {
 public:
  using Open = std::function<std::unique_ptr<Bus>(const std::string& name)>;

  Ring(const Open& open, const std::map<std::string, Behaviour>& behaviours, std::int64_t session_id = 1)
      : bus_(open("boss")), boss(*bus_, session_id) {
    for (std::size_t k = 1; k < kRoster.size(); ++k) {
      const std::string& name = kRoster[k];
      const std::string before = k == 1 ? kRoster.back() : kRoster[k - 1];
      threads_.emplace_back(
          [this, open, name, before, session_id, b = behaviours.at(name), &trace = traces[name]] {
            const auto bus = open(name);
            trace = run_agent(*bus, context_of(name, session_id), before, b);
            ++ended_;
          });
    }
  }
  ~Ring() { finish(); }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  /// Ends everything; traces are complete then. The word is said until everybody has obeyed: it may be lost.
  void finish() {
    boss.say(Phase::finished);
    while (ended_ < threads_.size()) boss.await([this] { return ended_ == threads_.size(); });
    for (auto& t : threads_)
      if (t.joinable()) t.join();
  }

 private:
  std::unique_ptr<Bus> bus_;

 public:
  Boss boss;
  std::map<std::string, Trace> traces;

 private:
  std::atomic<std::size_t> ended_{};  ///< of the threads
  std::vector<std::jthread> threads_;
};

}  // namespace mrroc::link::test
