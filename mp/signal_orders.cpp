#include "mp/signal_orders.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <utility>

#include "mp/gnuplot.hpp"
#include "mp/print_line.hpp"

namespace mrroc::mp {
namespace {

std::atomic<int> interrupts{0};
std::atomic<int> last_signal{0};
std::atomic<std::int64_t> looked_at{0};  // signals, last [ms]
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Signals from the third one on are for a program that must end.
constexpr int kLastWord = 3;
/// A process that has not looked at signals for so long will not look at them any more [ms].
constexpr std::int64_t kHangs = 2000;

/// Safe in a handler of signals. @return [ms]
std::int64_t milliseconds_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

void interrupt(int signal) {
  last_signal = signal;
  const int count = ++interrupts;
  if (count >= kLastWord && milliseconds_now() - looked_at > kHangs)
    ::_exit(exit_status(FaultCode::process_hung));  // the system kills the nodes with it
}

std::atomic<int> suspensions{0};
std::atomic<int> continuations{0};
void suspend(int) { ++suspensions; }
void go_on(int) { ++continuations; }

/// In lock-step everything waits for MP: it can be suspended, and says so before. Safe in a handler of signals.
void suspend_at_once(int) {
  constexpr std::string_view kLine =
      "suspended, and with it the simulated time; `fg` goes on, Ctrl-C after that stops\n";
  [[maybe_unused]] const auto written = ::write(STDOUT_FILENO, kLine.data(), kLine.size());
  ::raise(SIGSTOP);
}

/// Signals that stop the task, and their names.
constexpr std::array<std::pair<int, std::string_view>, 3> kStops{
    {{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}}};

std::string_view name_of(int signal) {
  const auto* const found = std::ranges::find(kStops, signal, &std::pair<int, std::string_view>::first);
  return found == kStops.end() ? "a signal" : found->second;
}

/// From now on that handler gets the signals that stop, but those which are ignored.
void handle_stops(void (*handler)(int)) {
  for (const auto& [number, name] : kStops)
    if (std::signal(number, handler) == SIG_IGN) std::signal(number, SIG_IGN);
}

}  // namespace

HeldStops::HeldStops() {
  sigset_t held;
  ::sigemptyset(&held);
  for (const auto& [number, name] : kStops) ::sigaddset(&held, number);
  ::pthread_sigmask(SIG_BLOCK, &held, &before_);
}

HeldStops::~HeldStops() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

SignalOrders::SignalOrders(OperatorCommandServer& command_server, Supervisor& supervisor,
                           link::Process& process)
    : command_server_(command_server),
      supervisor_(supervisor),
      process_(process),
      by_wall_clock_(!process.lock_step()) {
  interrupts = suspensions = continuations = 0;
  looked_at = milliseconds_now();
  handle_stops(interrupt);
  std::signal(SIGTSTP, by_wall_clock_ ? suspend : suspend_at_once);
  std::signal(SIGCONT, go_on);
}

SignalOrders::~SignalOrders() {
  handle_stops(SIG_DFL);
  std::signal(SIGTSTP, SIG_DFL);
  std::signal(SIGCONT, SIG_DFL);
}

void SignalOrders::look() {
  looked_at = milliseconds_now();
  look_after_stops();
  look_after_suspension();
}

void SignalOrders::look_after_stops() {
  const int signals = interrupts;
  if (signals == signals_) return;
  if (finishing_) return end_pictures(signals);
  if (command_server_.give(OperatorOrder::stop, name_of(last_signal))) signal_ = last_signal;
  if (signals > 1 && signals < kLastWord) {
    print_line("a second signal: the stop waits for nothing any more; a third one kills all processes");
    supervisor_.hurry();
  }
  if (signals >= kLastWord) {
    print_line("a third signal: all processes are killed, the drives brake");
    if (command_server_.stop_accepted() || process_.over()) supervisor_.stop(stop_reason(), 0);
    supervisor_.kill_all();
  }
  signals_ = signals;
}

void SignalOrders::look_after_suspension() {
  if (continuations > continuations_ && !by_wall_clock_) process_.log("goes on after a suspension");
  if (continuations > continuations_ && paused_by_signal_)
    paused_by_signal_ = !command_server_.give(OperatorOrder::resume);
  continuations_ = continuations;
  if (suspensions == suspensions_) return;
  suspensions_ = suspensions;
  if (paused_by_signal_) {
    paused_by_signal_ =
        !command_server_.give(OperatorOrder::resume);  // refused while the arms still come to rest
    return;
  }
  paused_by_signal_ = command_server_.give(OperatorOrder::pause);
  print_line(
      paused_by_signal_
          ? "Ctrl-Z pauses: arms that go by the wall clock need their program. Ctrl-Z again, or "
            "`ui_cli resume`, goes on; Ctrl-C stops"
          : "Ctrl-Z does nothing now: arms that go by the wall clock need their program; Ctrl-C stops");
}

void SignalOrders::set_finishing(bool finishing) {
  finishing_ = finishing;
  if (!finishing) return;
  gave_up_pictures_ = false;
  allow_gnuplot(true);
}

// The run is over, and its summary is written: nothing but pictures is lost.
void SignalOrders::end_pictures(int signals) {
  const bool again = gave_up_pictures_ || signals - signals_ > 1;  // two may come between two looks
  gave_up_pictures_ = true;
  signals_ = signals;
  print_line(
      again ? "again a signal: the program ends at once, without the rest of tables and pictures"
            : "a signal: gnuplot is killed, and no more pictures are drawn; another one ends the program");
  if (again) ::_exit(exit_status(FaultCode::interrupted));
  allow_gnuplot(false);
}

Fault SignalOrders::stop_reason() const {
  if (signal_ == 0) return {.code = FaultCode::operator_stop};
  return {.code = FaultCode::interrupted, .text = name_of(signal_)};
}

}  // namespace mrroc::mp
