#include "ecp/agent_links.hpp"

#include <utility>

#include "base/msg/convert.hpp"

namespace mrroc::ecp {

AgentLinks::AgentLinks(link::Process& process, AgentLinkNames names)
    : process_(process),
      names_(std::move(names)),
      report_out_(process.outbox<agent_report_t>(names_.agent + ".report")),
      order_in_(process.inbox<agent_order_t>(names_.agent + ".order")),
      sources_(names_.others.all_sources()) {
  sources_.push_back(order_in_.get());
}

Outcome AgentLinks::begin() {
  if (!process_.assemble()) return Outcome::aborted;
  send({});
  return wait();
}

void AgentLinks::send(const Report& report) {
  report_out_->publish(to_message(report), i_ + 1);
  names_.others.send(i_ + 1);
}

void AgentLinks::end() {
  send({.ready = true});
  names_.others.end();
}

Outcome AgentLinks::wait() {
  ++i_;
  process_.report_progress(i_, 0);
  const auto stopped = [this] { return process_.over() && i_ >= process_.stop_as_of(); };
  const auto here = [this] {
    if (!process_.lock_step()) return order_in_->newest() && order_in_->newest()->header.stamp >= i_;
    return order_in_->at(i_) && names_.others.all_here(i_, (i_ - 1) * names_.n_s);
  };
  process_.await_from(sources_, FaultCode::peer_silent, [&] { return here() || stopped(); });
  if (stopped()) return Outcome::aborted;
  if (!process_.lock_step()) go_on_to_newest();
  order_ = from_message(*order_in_->at(i_));
  names_.others.receive(i_);
  return Outcome::terminated;
}

void AgentLinks::go_on_to_newest() {
  process_.poll();
  const std::int64_t newest = order_in_->newest()->header.stamp;
  process_.report_skipped(newest - i_);
  i_ = newest;
  process_.report_progress(i_, 0);
}

}  // namespace mrroc::ecp
