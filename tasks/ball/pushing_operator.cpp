#include "tasks/ball/pushing_operator.hpp"

#include "tasks/ball/ball.hpp"

namespace mrroc::ball {

PushingOperator::PushingOperator(link::Process& process, mp::OperatorCommandServer& command_server,
                                 bool gives_start, const HandPush& push, const Vector3& force_P)
    : process_(process),
      starts_(process, command_server, gives_start),
      push_(push),
      force_P_(force_P),
      order_out_(process.outbox<hand_order_t>("hand.order")),
      report_in_(process.inbox<hand_report_t>("hand.report")) {}

bool PushingOperator::here(std::int64_t i) const {
  return process_.lock_step() ? report_in_->at(i) != nullptr : report_in_->newest() != nullptr;
}

void PushingOperator::inform(std::int64_t i, int m) {
  if (m == kCircle) ++around_;
  const bool pushes = m == kCircle && around_ > push_.begin && around_ <= push_.begin + push_.duration;
  hand_order_t order{};
  order.action[push_.arm] = static_cast<int>(pushes ? HandAction::push : HandAction::release);
  order.x[push_.arm] = force_P_.x();
  order.y[push_.arm] = force_P_.y();
  order.height[push_.arm] = force_P_.z();
  order_out_->publish(order, i);
}

}  // namespace mrroc::ball
