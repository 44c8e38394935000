#include "tasks/drawing/hand_operator.hpp"

#include <algorithm>

#include "base/hand.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {
namespace {

HandAction action(int m, std::size_t arm) {
  if (m == 1 || m == 2) return arm == 0 ? HandAction::lead_along : HandAction::release;
  return m == 3 ? HandAction::lead_to : HandAction::release;
}

}  // namespace

HandOperator::HandOperator(link::Process& process, mp::OperatorCommandServer& command_server,
                           const HandPlan& plan)
    : process_(process),
      command_server_(command_server),
      plan_(plan),
      order_out_(process.outbox<hand_order_t>("hand.order")),
      image_out_(process.outbox<operator_image_t>("operator.image")),
      report_in_(process.inbox<hand_report_t>("hand.report")) {}

void HandOperator::inform(std::int64_t i, int m) {
  hand_order_t order{};
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    order.action[arm] = static_cast<int>(action(m, arm));
    order.x[arm] = plan_.start.x();
    order.y[arm] = plan_.start.y();
    order.height[arm] = plan_.height;
  }
  order.new_sheet[0] = m == 3 && m_ == 2;  // the taught sheet is put away
  order_out_->publish(order, i);
  command_server_.set_behaviour(m);
  if (m != m_) {
    m_ = m;
    steady_ = 0;
    triggered_ = false;
    done_ = false;
  }
}

bool HandOperator::here(std::int64_t i) const {
  return process_.lock_step() ? report_in_->at(i) != nullptr : report_in_->newest() != nullptr;
}

OperatorImage HandOperator::image(std::int64_t i) {
  const hand_report_t* const report = process_.lock_step() ? report_in_->at(i) : report_in_->newest();
  if (report) decide(*report);
  const OperatorImage image = command_server_.take(i);
  image_out_->publish(
      {.header = {}, .trigger = image.trigger, .started = image.started, .paused = image.paused}, i);
  return image;
}

void HandOperator::decide(const hand_report_t& report) {
  progress_ = report.progress[0];
  const bool led = m_ == 3 ? report.done[0] && report.done[1] : report.done[0] != 0;
  done_ = led && (m_ == 2 || m_ == 3);
  steady_ = led ? steady_ + 1 : 0;
  if (!plan_.gives_orders) return;
  if (command_server_.state() == TaskState::waiting_for_start) command_server_.give(OperatorOrder::start);
  if (!done_ || steady_ < plan_.steady || triggered_ || command_server_.state() != TaskState::running) return;
  triggered_ = command_server_.give(OperatorOrder::trigger);
}

}  // namespace mrroc::drawing
