#include "mp/coordinator_links.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"

namespace mrroc::mp {

CoordinatorLinks::CoordinatorLinks(link::Process& process, const std::vector<std::string>& arms,
                                   OperatorAgent& human, const TaskClock& clock, link::OtherLinks others)
    : process_(process),
      operator_(human),
      control_out_(process.outbox<simulation_control_t>("simulation.control")),
      others_(std::move(others)),
      sources_(others_.all_sources()),
      reports_(arms.size()),
      clock_(clock) {
  for (const std::string& arm : arms) {
    order_out_.push_back(process.outbox<agent_order_t>(arm + ".order"));
    report_in_.push_back(process.inbox<agent_report_t>(arm + ".report"));
    sources_.push_back(report_in_.back().get());
  }
  sources_.push_back(human.inbox());
}

Outcome CoordinatorLinks::begin(const Order& order) {
  send(std::vector<Order>(order_out_.size(), order));
  return wait();
}

void CoordinatorLinks::send(std::span<const Order> orders) {
  for (std::size_t arm = 0; arm < orders.size(); ++arm)
    order_out_[arm]->publish(to_message(orders[arm]), i_ + 1);
  simulation_control_t control{};
  control.paused = image_.paused;
  control.finished = orders[0].finished;
  control.hands = operator_.has_hands();
  control_out_->publish(control, i_ + 1);
  others_.send(i_ + 1);
  if (orders[0].finished) others_.end();
  operator_.inform(i_ + 1, orders[0].m);
}

Outcome CoordinatorLinks::wait() {
  ++i_;
  const auto stopped = [this] { return process_.over() && i_ >= process_.stop_as_of(); };
  const auto here = [this] {
    if (!process_.lock_step()) return newest() >= i_ && operator_.here(i_);
    return std::ranges::all_of(report_in_, [this](const auto& in) { return in->at(i_) != nullptr; }) &&
           others_.all_here(i_, 0) && operator_.here(i_);
  };
  process_.report_progress(i_, 0);
  try {
    process_.await_from(sources_, FaultCode::peer_silent, [&] { return here() || stopped(); });
  } catch (const FaultError& e) {
    fault_ = e.fault();
    return Outcome::faulted;
  }
  if (stopped()) return Outcome::aborted;
  if (!process_.lock_step()) {
    process_.poll();
    process_.report_skipped(newest() - i_);
    i_ = newest();
    process_.report_progress(i_, 0);
  }
  wait_for_late_orders([&] { return stopped() || newest() > i_; });
  if (stopped()) return Outcome::aborted;
  return receive();
}

void CoordinatorLinks::wait_for_late_orders(const std::function<bool()>& ends) {
  const auto macrostep = process_.context().macrostep;
  if (macrostep.count() > 0) process_.await(ends, link::Process::Clock::now() + macrostep * 3 / 5);
}

std::int64_t CoordinatorLinks::newest() const {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const auto& in : report_in_) least = std::min(least, in->newest() ? in->newest()->header.stamp : -1);
  return least;
}

Outcome CoordinatorLinks::receive() {
  for (std::size_t arm = 0; arm < report_in_.size(); ++arm) {
    const agent_report_t* const exact = report_in_[arm]->at(i_);
    const agent_report_t* const m = exact ? exact : report_in_[arm]->newest();
    if (!finite(*m)) {
      fault_ = Fault{.code = FaultCode::malformed_message};
      fault_.text = fmt::format("{}: a number is not finite", report_in_[arm]->channel());
      return Outcome::faulted;
    }
    reports_[arm] = from_message(*m);
    if (reports_[arm].verdict == Verdict::none || !reports_[arm].fault ||
        reports_[arm].fault.code == FaultCode::lost_command)
      continue;
    fault_ = reports_[arm].fault;
    return Outcome::faulted;
  }
  try {
    others_.receive(i_);
  } catch (const FaultError& e) {
    fault_ = e.fault();
    return Outcome::faulted;
  }
  image_ = operator_.image(i_);
  clock_.advance(image_.paused, m_);
  return Outcome::terminated;
}

}  // namespace mrroc::mp
