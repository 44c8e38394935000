#include "test/rig/driven_arms.hpp"

namespace mrroc::rig {

void DrivenArms::dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
  m_ = motion.m;
  for (std::size_t arm = 0; arm < rubik::kArms; ++arm) x_[arm].T = y.T[arm];
}

Outcome DrivenArms::wait() {
  for (std::size_t arm = 0; arm < rubik::kArms; ++arm) {
    const int number = static_cast<int>(arm);
    x_[arm].e = cell_.reply(number);
    x_[arm].i = cell_.i();
    const rubik::Arm::Y y = agents_[arm].step(x_[arm]);
    cell_.send(number, y.e);
    reports_[arm] = y.T;
  }
  watch_(m_);
  if (cell_.wait() == Outcome::faulted) {
    for (int arm = 0; arm < static_cast<int>(rubik::kArms); ++arm) {
      const EffectorReply& reply = cell_.reply(arm);
      if (reply.verdict == Verdict::refused || reply.verdict == Verdict::failed) fault_ = reply.fault;
    }
    return Outcome::faulted;
  }
  return cell_.world().steps() < end_ ? Outcome::terminated : Outcome::aborted;
}

void DrivenArms::read(Coordinator::X& x) {
  x.i = cell_.i();
  x.T.agent = reports_;
}

}  // namespace mrroc::rig
