#include "mp/leading_operator.hpp"

namespace mrroc::mp {

LeadingOperator::LeadingOperator(link::Process& process, OperatorCommandServer& command_server,
                                 StatusBoard& board, const FarewellPlan& plan)
    : process_(process),
      command_server_(command_server),
      board_(board),
      plan_(plan),
      order_out_(process.outbox<hand_order_t>("hand.order")),
      image_out_(process.outbox<operator_image_t>("operator.image")),
      report_in_(process.inbox<hand_report_t>("hand.report")) {}

const hand_report_t* LeadingOperator::report(std::int64_t i) const {
  return process_.lock_step() ? report_in_->at(i) : report_in_->newest();
}

HandAction LeadingOperator::action() const {
  if (part_ == Part::leads || part_ == Part::lets_go) return HandAction::follow;
  return part_ == Part::takes_away ? HandAction::lead_to : HandAction::release;
}

void LeadingOperator::inform(std::int64_t i, int m) {
  if (m > 0 && part_ == Part::waits) begin(Part::leads);
  hand_order_t order{};
  order.action[0] = static_cast<int>(action());
  order.x[0] = plan_.point.x();
  order.y[0] = plan_.point.y();
  order.height[0] = plan_.height;
  order_out_->publish(order, i);
}

void LeadingOperator::begin(Part part) {
  part_ = part;
  age_ = steady_ = 0;
  before_ = triggers_;
  board_.set_early("");
}

bool LeadingOperator::triggered(bool done) {
  if (triggers_ > before_) return true;
  steady_ = done ? steady_ + 1 : 0;
  board_.set_early(done ? "" : "the hand still leads the tool");
  const bool ready = steady_ >= plan_.steady && command_server_.state() == TaskState::running;
  if (ready && plan_.gives_orders) command_server_.give(OperatorOrder::trigger);
  command_server_.set_trigger_due(ready && !plan_.gives_orders);
  return false;
}

void LeadingOperator::decide(bool done) {
  ++age_;
  switch (part_) {
    case Part::waits:
      if (plan_.gives_orders && command_server_.state() == TaskState::waiting_for_start)
        command_server_.give(OperatorOrder::start);
      break;
    case Part::leads:
      if (triggered(done)) begin(Part::lets_go);
      break;
    case Part::lets_go:
      if (age_ > plan_.leave) begin(Part::takes_away);
      break;
    case Part::takes_away:
      if (triggered(done)) begin(Part::rests);
      break;
    case Part::rests:
      break;
  }
}

OperatorImage LeadingOperator::image(std::int64_t i) {
  const hand_report_t* const told = report(i);
  decide(told && told->done[0] != 0);
  const OperatorImage image = command_server_.take(i);
  triggers_ = image.trigger;
  image_out_->publish(
      {.header = {}, .trigger = image.trigger, .started = image.started, .paused = image.paused}, i);
  return image;
}

}  // namespace mrroc::mp
