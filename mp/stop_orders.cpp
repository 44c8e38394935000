#include "mp/stop_orders.hpp"

#include <fmt/core.h>

#include <chrono>
#include <utility>

namespace mrroc::mp {
namespace {

/// Macrosteps that last so long leave time for a message to reach everybody within half of one: then a stop does not
/// wait for the coordinator's next macrostep.
constexpr std::chrono::milliseconds kPromptly{10};

/// Without a macrostep for so long, a stop does not wait for the next one.
constexpr std::chrono::seconds kTimeout{2};

}  // namespace

StopOrders::StopOrders(OperatorCommandServer& command_server, Supervisor& supervisor, link::Process& process,
                       std::function<Fault()> reason)
    : command_server_(command_server),
      supervisor_(supervisor),
      process_(process),
      reason_(std::move(reason)) {}

void StopOrders::look(bool impatient) {
  settle();
  if (command_server_.emergency()) {
    supervisor_.stop({.code = FaultCode::emergency_stop}, 0);
    command_server_.repeat_emergency();
  }
  // The first macrostep that the coordinator has not thought of begins in half of one at the earliest, see
  // CoordinatorLinks::wait_for_late_orders(): nobody has passed it.
  if (const std::int64_t as_of = i_ + 1; begun_ && process_.context().macrostep >= kPromptly &&
                                         !process_.over() && command_server_.take_stop(as_of - kAhead))
    supervisor_.stop(reason_(), as_of);
  const bool in_vain = Clock::now() - last_macrostep_ > kTimeout;
  if (command_server_.stop_accepted() && (in_vain || impatient)) supervisor_.stop(reason_(), 0);
}

void StopOrders::each_macrostep(std::int64_t i) {
  i_ = i;
  begun_ = true;
  last_macrostep_ = Clock::now();
  if (command_server_.stop_ordered() && !process_.over()) supervisor_.stop(reason_(), i + kAhead);
}

void StopOrders::settle() {
  if (!command_server_.stop_waits()) return;
  if (!supervisor_.unconfirmed().empty())
    command_server_.settle_stops(
        {.code = FaultCode::stop_not_confirmed,
         .text = fmt::format("not confirmed by {}, which is ended by a signal, or cut off on another "
                             "host; its drives brake",
                             supervisor_.unconfirmed())},
        {});
  else if (supervisor_.stop_confirmed())
    command_server_.settle_stops({}, "every process has confirmed it");
}

}  // namespace mrroc::mp
