// Limits the wait for messages that must come, and raises a fault when they do not.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "base/fault.hpp"
#include "base/link/channel.hpp"

namespace mrroc::link {

/// A process that hangs is found by the supervisor after 10 s, see mp/supervisor.cpp; a process that waits
/// for it reports later, so that the better reason comes first. Sanitizers slow processes down without a
/// bound.
#ifdef MRROC_SANITIZED
inline constexpr std::chrono::seconds kReceiveTimeout{0};
#else
inline constexpr std::chrono::seconds kReceiveTimeout{30};
#endif

/// A process that has heard nothing of its supervisor for so long is alone. The supervisor gives a sign of life ten times
/// a second, at any speed of the run.
inline constexpr std::chrono::seconds kAlone{60};

/// The channels that somebody waits for.
using Sources = std::vector<const InboxBase*>;

/// The deadline of one wait, counted from its construction. Asks no clock but at its beginning.
class ReceiveDeadline {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time

  /// @param sources  must live longer than this object; its members may be null, and all of them may be
  /// @param silent   the fault when nothing comes
  /// @param timeout 0: the wait has no end
  ReceiveDeadline(const Sources& sources, FaultCode silent, std::chrono::milliseconds timeout);

  /// @throws FaultError when the wait has been too long by now: malformed_message after a fifth of the
  ///         timeout when a channel brought only such messages meanwhile, `silent` after all of it
  void check(Clock::time_point now) const;

  /// @return when check() is to be called at the latest
  [[nodiscard]] Clock::time_point deadline() const { return deadline_; }

 private:
  static constexpr std::size_t kMost = 8;  // sources whose counters are compared
  [[nodiscard]] const InboxBase* find(bool malformed) const;

  const Sources& sources_;
  FaultCode silent_;
  std::chrono::milliseconds timeout_;
  Clock::time_point begun_;
  Clock::time_point deadline_;
  std::array<Counters, kMost> before_{};
};

}  // namespace mrroc::link
