#include "ecp/effector_client.hpp"

#include <algorithm>

namespace mrroc::ecp {

void EffectorClient::see(const EffectorReply& reply) {
  const Sent s = sent(reply.macrostep - 1);
  if (s.macrostep != reply.macrostep - 1 || s.number == 0) return;
  const bool lost = reply.verdict == Verdict::none || reply.fault.code == FaultCode::lost_command;
  if (!lost && reply.number == s.number) {
    while (!pending_.empty() && pending_.front().number <= s.number) {
      pending_.pop_front();
      if (sent_of_pending_ > 0) --sent_of_pending_;
    }
    failures_ = 0;
    return;
  }
  if (s.macrostep < repeated_from_) return;
  repeated_from_ = reply.macrostep + 1;
  sent_of_pending_ = 0;
  if (++failures_ < kAttempts) return;
  fault_ = Fault{.code = FaultCode::command_repeated_refused};
  fault_->value = static_cast<double>(s.number);
  fault_->limit = kAttempts;
  fault_->text = reply.fault ? reply.fault.text : FixedText<160>("the driver did not see it");
}

EffectorCommand EffectorClient::next(EffectorCommand wanted, std::int64_t macrostep) {
  wanted.session = session_;
  const bool silent = wanted.instruction == Instruction::keep || wanted.instruction == Instruction::release;
  if (!silent) {
    wanted.number = ++number_;
    pending_.push_back(wanted);
  }
  EffectorCommand out = wanted;
  if (sent_of_pending_ < pending_.size() && wanted.instruction != Instruction::release) {
    out = pending_[sent_of_pending_++];
    sent(macrostep) = {macrostep, out.number};
  } else {
    out.number = number_;
    sent(macrostep) = {macrostep, 0};
  }
  out.macrostep = macrostep;
  return out;
}

}  // namespace mrroc::ecp
