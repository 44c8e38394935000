// Readings of a sensor with a clock of its own, such as a camera, for the agent that uses them (rules R6, R7).
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/fault.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"

namespace mrroc::link {

/// When a sensor measures: reading n is taken at step n * period of the effector drivers, and is visible `latency` steps
/// later.
struct SensorClock {
  std::int64_t period{1};   ///< [steps], > 0
  std::int64_t latency{0};  ///< [steps], >= 0

  /// @return number of the newest reading that is visible at a step; -1: there is none yet
  [[nodiscard]] constexpr std::int64_t newest(std::int64_t step) const {
    return step < latency ? -1 : (step - latency) / period;
  }
};

/// In lock-step the reading that must be visible is taken, with the wall clock the newest one, however old it is.
/// @tparam Message  one for every reading, its stamp is the reading's number
template <class Message>
class ClockedInbox {
 public:
  /// Make this before the process assembles.
  ClockedInbox(Process& process, const std::string& channel, const SensorClock& clock)
      : process_(process), clock_(clock), in_(process.inbox<Message>(channel)) {}

  /// @return what is waited for
  [[nodiscard]] const InboxBase* source() const { return in_.get(); }
  /// @return whether what is visible at a step has come (OtherLinks::here)
  [[nodiscard]] bool here(std::int64_t step) const {
    const std::int64_t n = clock_.newest(step);
    return n < 0 || in_->at(n) != nullptr;
  }
  /// @return the newest reading that is visible at a step; nothing when there is none
  /// @throws FaultError malformed_message
  [[nodiscard]] auto at(std::int64_t step) const {
    using Value = decltype(from_message(std::declval<const Message&>()));
    const Message* const m = process_.lock_step() ? in_->at(clock_.newest(step)) : in_->newest();
    if (!m) return std::optional<Value>{};
    if (!is_proper(*m))
      throw FaultError(FaultCode::malformed_message, in_->channel() + ": a number is not proper");
    return std::optional<Value>(from_message(*m));
  }

 private:
  Process& process_;
  SensorClock clock_;
  std::unique_ptr<Inbox<Message>> in_;
};

}  // namespace mrroc::link
