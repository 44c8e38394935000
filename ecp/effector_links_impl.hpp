// Bodies of ecp/effector_links.hpp, for the files that instantiate them.
#pragma once
#include "ecp/effector_links.hpp"

#include "base/hash.hpp"
#include "base/msg/finite.hpp"

namespace mrroc::ecp {
namespace detail {

/// The owner of an effector within its system; the same in every run, so that runs can be compared.
inline std::int64_t session_of(const std::string& process) {
  Hash hash;
  hash.add(process);
  return static_cast<std::int64_t>(hash.value() >> 1);
}

/// With the wall clock, macrosteps in a row in which the driver may see nothing of what is sent: a second.
inline constexpr int kLateAttempts = 50;

/// @return the message for that macrostep, or the newest one; null when there is none at all
template <class M>
const M* at_or_newest(const link::Inbox<M>& in, std::int64_t i) {
  const M* const exact = in.at(i);
  return exact ? exact : in.newest();
}

}  // namespace detail

template <Effector E>
EffectorLinks<E>::EffectorLinks(link::Process& process, const EffectorLinkNames& names)
    : process_(process),
      has_sensor_(!names.sensor.empty()),
      command_out_(process.outbox<CommandMessage>(names.robot + ".command")),
      report_out_(process.outbox<agent_report_t>(names.robot + ".report")),
      reply_in_(process.inbox<ReplyMessage>(names.robot + ".reply")),
      order_in_(process.inbox<agent_order_t>(names.robot + ".order")),
      others_(names.others),
      client_(detail::session_of(process.context().name), process.lock_step() ? 0 : detail::kLateAttempts) {
  sources_ = {reply_in_.get(), order_in_.get()};
  const link::Sources others = others_.all_sources();
  sources_.insert(sources_.end(), others.begin(), others.end());
  if (!has_sensor_) return;
  setting_out_ = std::make_unique<link::OutgoingLink<SensorSetting>>(process, names.sensor + ".setting");
  reading_in_ = process.inbox<sensor_reading_t>(names.sensor);
  sources_.push_back(reading_in_.get());
}

template <Effector E>
Outcome EffectorLinks<E>::begin() {
  if (!process_.assemble()) return Outcome::aborted;
  send({}, {});
  return wait();
}

template <Effector E>
void EffectorLinks<E>::set_sensor(const SensorSetting& setting) {
  if (setting_out_) setting_out_->set(setting);
}

template <Effector E>
void EffectorLinks<E>::send(const Command& command, const Report& report) {
  command_out_->publish(to_message(client_.next(command, i_ + 1)), i_ + 1);
  report_out_->publish(to_message(report), i_ + 1);
  if (setting_out_) setting_out_->send(i_ + 1);
  others_.send(i_ + 1);
}

template <Effector E>
void EffectorLinks<E>::end() {
  send({.instruction = Instruction::release}, {.ready = true});
  if (setting_out_) setting_out_->end();
  others_.end();
}

template <Effector E>
Outcome EffectorLinks<E>::wait() {
  ++i_;
  process_.report_progress(i_, 0);
  return receive();
}

template <Effector E>
Outcome EffectorLinks<E>::receive() {
  const auto stopped = [this] { return process_.over() && i_ >= process_.stop_as_of(); };
  const bool all = process_.lock_step();
  const auto here = [&] {
    if (!all) return reply_in_->newest() && reply_in_->newest()->header.stamp >= i_;
    return reply_in_->at(i_) && (!has_sensor_ || reading_in_->at(i_)) && order_in_->at(i_) &&
           others_.all_here(i_, reply_in_->at(i_)->step);
  };
  process_.await_from(sources_, FaultCode::peer_silent, [&] { return here() || stopped(); });
  if (stopped()) return Outcome::aborted;
  if (!all) go_on_to_newest();

  const ReplyMessage& reply = *reply_in_->at(i_);
  if (!is_proper(reply))
    throw FaultError(FaultCode::malformed_message, reply_in_->channel() + ": a number is not proper");
  reply_ = from_message(reply);
  if (has_sensor_)
    if (const auto* m = detail::at_or_newest(*reading_in_, i_)) reading_ = from_message(*m);
  if (const auto* m = detail::at_or_newest(*order_in_, i_)) {
    order_ = from_message(*m);
    order_.late = m->header.stamp < i_;
  }
  others_.receive(i_);
  client_.see(reply_);
  return client_.fault() ? Outcome::faulted : Outcome::terminated;
}

template <Effector E>
void EffectorLinks<E>::go_on_to_newest() {
  process_.poll();
  const std::int64_t newest = reply_in_->newest()->header.stamp;
  process_.report_skipped(newest - i_);
  i_ = newest;
  process_.report_progress(i_, 0);
}

}  // namespace mrroc::ecp
