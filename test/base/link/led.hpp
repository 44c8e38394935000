// One process in a thread of its own, and the test in this one, which leads it as the supervisor does.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"

namespace mrroc::link::test {

/// A system of MP, which is the test, and one process. Make what the test sends and hears between the two phases: after
/// construction, and before start().
class Led {
 public:
  using Body = std::function<void(Process&)>;

  /// @param name  of the process  @param session  that both belong to
  explicit Led(std::string name, ClockKind clock = ClockKind::step, std::string session = "test")
      : name_(std::move(name)),
        session_(std::move(session)),
        clock_(clock),
        bus_(hub_.open()),
        mp(*bus_, context_of("mp")),
        supervisor_(*bus_, mp.route("supervisor"), mp.context().session_id),
        status_(*bus_, mp.route(name_ + ".status"), mp.context().session_id) {
    mp.on_service = [this] {
      while (const auto s = status_.take()) heard_ = *s;
      if (said_ && Process::Clock::now() - said_at_ > kSaidAgain) say(*said_);
    };
  }
  ~Led() { end(); }
  Led(const Led&) = delete;
  Led& operator=(const Led&) = delete;

  /// Begins the process. @param body  what it does
  void begin(const Body& body) {
    thread_ = std::jthread([this, body] {
      const auto bus = hub_.open();
      Process process(*bus, context_of(name_));
      body(process);
      ended_ = true;
    });
  }
  /// Ends the system, and waits for the process, which may not have been listening yet: the word is said until it has obeyed.
  /// To be called before what the body uses is destroyed. A process that does not end within a minute ends the test program.
  void end() {
    say(Phase::finished);
    if (!thread_.joinable()) return;
    if (!mp.await([this] { return ended(); }, Process::Clock::now() + std::chrono::minutes(1))) {
      std::cerr << name_ << " does not end\n";
      std::abort();
    }
    thread_.join();
  }
  /// Waits until the process is ready, and lets it run. @return whether it became ready
  bool run() {
    const bool ready = await([this] { return state() == ProcessState::ready; });
    say(Phase::running);
    return ready;
  }
  /// @return false when it took more than a minute: on a busy host every step waits for a core
  template <class Ready>
  bool await(Ready ready) {
    return mp.await(ready, Process::Clock::now() + std::chrono::minutes(1));
  }
  /// What the supervisor says from now on, ten times a second while the test waits.
  void say(Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    said_ = phase;
    said_at_ = Process::Clock::now();
    supervisor_.publish(m, 0);
  }
  /// @return what the process has told last
  [[nodiscard]] const process_status_t& status() const { return heard_; }
  /// @return its state, as it has told last
  [[nodiscard]] ProcessState state() const { return static_cast<ProcessState>(heard_.state); }
  /// @return whether the body has come to its end
  [[nodiscard]] bool ended() const { return ended_; }
  /// @return who belongs to the system, as that one
  [[nodiscard]] NodeContext context_of(const std::string& name) const {
    NodeContext m;
    m.clock = name == "mp" ? ClockKind::step : clock_;
    m.session = session_;
    m.name = name;
    m.roster = {"mp", name_};
    return m;
  }

 private:
  static constexpr std::chrono::milliseconds kSaidAgain{100};

  std::string name_, session_;
  ClockKind clock_;
  MemoryHub hub_;
  std::unique_ptr<Bus> bus_;

 public:
  Process mp;  ///< of the test

 private:
  Outbox<supervisor_t> supervisor_;
  Queue<process_status_t> status_;
  process_status_t heard_{};
  std::optional<Phase> said_;
  Process::Clock::time_point said_at_{};
  std::atomic<bool> ended_{false};
  std::jthread thread_;  // the last one: it ends before what it uses
};

}  // namespace mrroc::link::test
