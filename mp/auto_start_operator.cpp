#include "mp/auto_start_operator.hpp"

namespace mrroc::mp {

AutoStartOperator::AutoStartOperator(link::Process& process, OperatorCommandServer& command_server,
                                     bool gives_start)
    : command_server_(command_server),
      gives_start_(gives_start),
      image_out_(process.outbox<operator_image_t>("operator.image")) {}

OperatorImage AutoStartOperator::image(std::int64_t i) {
  if (gives_start_ && command_server_.state() == TaskState::waiting_for_start)
    command_server_.give(OperatorOrder::start);
  const OperatorImage image = command_server_.take(i);
  image_out_->publish(
      {.header = {}, .trigger = image.trigger, .started = image.started, .paused = image.paused}, i);
  return image;
}

}  // namespace mrroc::mp
