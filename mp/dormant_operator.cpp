#include "mp/dormant_operator.hpp"

namespace mrroc::mp {

DormantOperator::DormantOperator(link::Process& process, OperatorDesk& desk, bool gives_start)
    : desk_(desk),
      gives_start_(gives_start),
      order_out_(process.outbox<hand_order_t>("hand.order")),
      image_out_(process.outbox<operator_image_t>("operator.image")) {}

void DormantOperator::inform(std::int64_t i, int, bool finished) {
  hand_order_t order{};  // every hand: release
  order.paused = paused_;
  order.finished = finished;
  order_out_->publish(order, i);
}

OperatorImage DormantOperator::image(std::int64_t i) {
  if (gives_start_ && desk_.state() == TaskState::waiting_for_start) desk_.give(OperatorOrder::start);
  const OperatorImage image = desk_.take(i);
  paused_ = image.paused;
  image_out_->publish(
      {.header = {}, .trigger = image.trigger, .started = image.started, .paused = image.paused}, i);
  return image;
}

}  // namespace mrroc::mp
