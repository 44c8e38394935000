#include "mp/coordinator_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/msg/convert.hpp"

namespace mrroc::mp {

CoordinatorLinks::CoordinatorLinks(link::Process& process, const std::vector<std::string>& arms,
                                   OperatorAgent& human)
    : process_(process), operator_(human), reports_(arms.size()) {
  for (const std::string& arm : arms) {
    order_out_.push_back(process.outbox<agent_order_t>(arm + ".order"));
    report_in_.push_back(process.inbox<agent_report_t>(arm + ".report"));
  }
}

Outcome CoordinatorLinks::begin(const Order& order) {
  send(std::vector<Order>(order_out_.size(), order));
  return wait();
}

void CoordinatorLinks::send(std::span<const Order> orders) {
  for (std::size_t arm = 0; arm < orders.size(); ++arm)
    order_out_[arm]->publish(to_message(orders[arm]), i_ + 1);
  operator_.inform(i_ + 1, orders[0].m, orders[0].finished);
}

Outcome CoordinatorLinks::wait() {
  ++i_;
  process_.report_progress(i_, 0);
  const auto stopped = [this] { return process_.over() && i_ >= process_.stop_as_of(); };
  const auto here = [this] {
    return std::ranges::all_of(report_in_, [this](const auto& in) { return in->at(i_) != nullptr; }) &&
           operator_.here(i_);
  };
  // With the wall clock an agent that is late for a second is taken as it was.
  const auto deadline = process_.lock_step() ? link::Process::Clock::time_point::max()
                                             : link::Process::Clock::now() + std::chrono::seconds(1);
  process_.await([&] { return here() || stopped(); }, deadline);
  if (stopped() || (process_.lock_step() && !here())) return Outcome::aborted;

  for (std::size_t arm = 0; arm < report_in_.size(); ++arm) {
    const agent_report_t* const m = report_in_[arm]->at(i_);
    if (!m) continue;
    reports_[arm] = from_message(*m);
    if (reports_[arm].verdict == Verdict::none || !reports_[arm].fault ||
        reports_[arm].fault.code == FaultCode::lost_command)
      continue;
    fault_ = reports_[arm].fault;
    return Outcome::faulted;
  }
  image_ = operator_.image(i_);
  return Outcome::terminated;
}

}  // namespace mrroc::mp
