// Bodies of ecp/effector_client.hpp, for the files that instantiate them.
#pragma once
#include "ecp/effector_client.hpp"

#include <algorithm>

namespace mrroc::ecp {

template <Effector E>
void BasicEffectorClient<E>::settle_until(std::int64_t number) {
  if (pending_.empty() || pending_.front().number > number) return;
  while (!pending_.empty() && pending_.front().number <= number) {
    pending_.pop_front();
    if (sent_of_pending_ > 0) --sent_of_pending_;
  }
  failures_ = 0;
  late_ = 0;
}

template <Effector E>
void BasicEffectorClient<E>::see(const Reply& reply) {
  if (reply.session == session_ && reply.expected <= number_ + 1) settle_until(reply.expected - 1);
  const Sent s = sent(reply.macrostep - 1);
  if (s.macrostep != reply.macrostep - 1 || s.number == 0) {
    if (const Sent* const skipped = unanswered(reply.macrostep - 1)) send_again(reply, *skipped);
    return;
  }
  const bool unseen = reply.verdict == Verdict::none;
  if (!unseen && reply.fault.code != FaultCode::lost_command && reply.number == s.number) {
    settle_until(s.number);
    const bool uncounted = reply.verdict == Verdict::refused && reply.fault.code != FaultCode::not_owner &&
                           reply.expected == s.number;
    if (s.reset && reply.verdict == Verdict::executed)
      count_anew(reply.macrostep, s.number);
    else if (uncounted)
      count_anew(reply.macrostep, 1);
    return;
  }
  if (s.macrostep >= repeated_from_) send_again(reply, s);
}

template <Effector E>
const typename BasicEffectorClient<E>::Sent* BasicEffectorClient<E>::unanswered(
    std::int64_t macrostep) const {
  if (late_attempts_ == 0 || pending_.empty()) return nullptr;
  const auto found = std::ranges::find_if(sent_, [&](const Sent& s) {
    return s.macrostep >= repeated_from_ && s.macrostep < macrostep && s.number >= pending_.front().number;
  });
  return found == sent_.end() ? nullptr : &*found;
}

template <Effector E>
void BasicEffectorClient<E>::send_again(const Reply& reply, const Sent& s) {
  repeated_from_ = reply.macrostep + 1;
  sent_of_pending_ = 0;
  if (late_attempts_ > 0 ? ++late_ < late_attempts_ : ++failures_ < kAttempts) return;
  fault_ = Fault{.code = FaultCode::command_repeated_refused};
  fault_->value = static_cast<double>(s.number);
  fault_->limit = kAttempts;
  fault_->text = reply.fault ? reply.fault.text : FixedText<160>("the driver did not see it");
}

template <Effector E>
void BasicEffectorClient<E>::count_anew(std::int64_t macrostep, std::int64_t by) {
  number_ -= by;
  for (Command& command : pending_) command.number -= by;
  sent_of_pending_ = 0;
  repeated_from_ = macrostep + 1;
}

template <Effector E>
typename E::Command BasicEffectorClient<E>::next(Command wanted, std::int64_t macrostep) {
  wanted.session = session_;
  const bool silent = wanted.instruction == Instruction::keep || wanted.instruction == Instruction::release;
  if (!silent) {
    wanted.number = ++number_;
    pending_.push_back(wanted);
  }
  Command out = wanted;
  if (sent_of_pending_ < pending_.size() && wanted.instruction != Instruction::release) {
    out = pending_[sent_of_pending_++];
    E::renew(out, wanted);
    sent(macrostep) = {macrostep, out.number, out.instruction == Instruction::reset};
  } else {
    out.number = number_;
    sent(macrostep) = {macrostep, 0, false};
  }
  out.macrostep = macrostep;
  return out;
}

}  // namespace mrroc::ecp
