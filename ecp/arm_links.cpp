#include "ecp/arm_links.hpp"

#include "base/hash.hpp"
#include "base/msg/convert.hpp"

namespace mrroc::ecp {
namespace {

/// The owner of an effector within its system; the same in every run, so that runs can be compared.
std::int64_t session_of(const std::string& process) {
  Hash hash;
  hash.add(process);
  return static_cast<std::int64_t>(hash.value() >> 1);
}

}  // namespace

ArmLinks::ArmLinks(link::Process& process, const ArmLinkNames& names)
    : process_(process),
      has_sensor_(!names.sensor.empty()),
      command_out_(process.outbox<effector_command_t>(names.robot + ".command")),
      report_out_(process.outbox<agent_report_t>(names.robot + ".report")),
      reply_in_(process.inbox<effector_reply_t>(names.robot + ".reply")),
      order_in_(process.inbox<agent_order_t>(names.robot + ".order")),
      client_(session_of(process.membership().name)) {
  if (has_sensor_) reading_in_ = process.inbox<sensor_reading_t>(names.sensor);
}

Outcome ArmLinks::begin() {
  if (!process_.assemble()) return Outcome::aborted;
  send({}, {});
  return wait();
}

void ArmLinks::send(const EffectorCommand& command, const Report& report) {
  command_out_->publish(to_message(client_.next(command, i_ + 1)), i_ + 1);
  report_out_->publish(to_message(report), i_ + 1);
}

Outcome ArmLinks::wait() {
  ++i_;
  process_.report_progress(i_, 0);
  return receive();
}

Outcome ArmLinks::receive() {
  const auto stopped = [this] { return process_.over() && i_ >= process_.stop_as_of(); };
  const bool all = process_.lock_step();
  const auto here = [&] {
    return reply_in_->at(i_) && (!all || ((!has_sensor_ || reading_in_->at(i_)) && order_in_->at(i_)));
  };
  process_.await([&] { return here() || stopped(); });
  if (stopped() || !here()) return Outcome::aborted;

  reply_ = from_message(*reply_in_->at(i_));
  if (has_sensor_)
    if (const auto* m = all ? reading_in_->at(i_) : reading_in_->newest()) reading_ = from_message(*m);
  if (const auto* m = all ? order_in_->at(i_) : order_in_->newest()) order_ = from_message(*m);
  client_.see(reply_);
  return client_.fault() ? Outcome::faulted : Outcome::terminated;
}

}  // namespace mrroc::ecp
