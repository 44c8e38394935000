#include "mp/order_wait.hpp"

#include <fmt/core.h>

#include <cmath>

#include "mp/stop_orders.hpp"

namespace mrroc::mp {

OrderWait::OrderWait(link::Process& process, OperatorCommandServer& command_server, const StatusBoard& board,
                     Supervisor& supervisor, const Announcer& announce, bool scripted)
    : process_(process),
      command_server_(command_server),
      board_(board),
      supervisor_(supervisor),
      announce_(announce),
      scripted_(scripted) {}

Wait OrderWait::wait() const {
  Wait w{.m = board_.m(),
         .behaviour = board_.behaviour(),
         .until = board_.until(),
         .command = {},
         .order = idle_ ? "the instruction that ends it" : command_server_.needed(),
         .scripted = scripted_ || idle_,
         .next_in_script = command_server_.next_in_script()};
  w.command = idle_ ? "manual end" : w.order.substr(0, w.order.find(' '));
  return w;
}

void OrderWait::let_last(double sim_s) {
  if (!process_.lock_step() || process_.context().macrostep.count() > 0) return;
  const auto over = [this] { return !(idle_ || command_server_.waits_for_a_person()) || process_.over(); };
  const std::chrono::microseconds macrostep(std::llround(1e6 * (sim_s - sim_s_)));
  process_.await(over, last_macrostep_ + macrostep);
}

void OrderWait::each_macrostep(std::int64_t i, double sim_s) {
  i_ = i;
  sim_s_ = sim_s;
  last_macrostep_ = Clock::now();
}

void OrderWait::look() {
  constexpr std::chrono::milliseconds kLook{100};
  const auto now = Clock::now();
  if (process_.over() || now - looked_at_ < kLook) return;
  looked_at_ = now;
  const std::string needed = command_server_.needed();
  if (attended_ && needed.empty()) return;
  const auto waited =
      notice_.look(now, sim_s_,
                   fmt::format("{} {} {} {}", board_.watched(), static_cast<int>(command_server_.state()),
                               supervisor_.behaviours_begun(), needed),
                   idle_ || !needed.empty());
  if (waited)
    announce_(sim_s_, fmt::format("nothing has changed for {} s of real time: {}", waited->count(),
                                  to_string(wait())));
  look_after_script(now);
}

// In lock-step nobody has to be there: then a script that lacks an order ends the run, and the log does not grow for ever.
void OrderWait::look_after_script(Clock::time_point now) {
  constexpr std::chrono::seconds kForATerminal{10};
  const bool lacks_order = idle_ || (scripted_ && command_server_.waits_for_a_person());
  const bool ends = process_.lock_step() && !command_server_.has_terminal();
  if (!lacks_order) {
    lacks_order_since_.reset();
  } else if (!lacks_order_since_) {
    lacks_order_since_ = now;
    announce_(sim_s_, to_string(wait()) + (ends ? "; without it the run ends in 10 s" : ""));
  } else if (ends && now - *lacks_order_since_ > kForATerminal) {
    supervisor_.stop(
        {.code = FaultCode::script_ended, .text = fmt::format("{}; {}", wait().order, what(wait()))},
        i_ + StopOrders::kAhead);
  }
}

}  // namespace mrroc::mp
