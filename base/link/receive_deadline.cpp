#include "base/link/receive_deadline.hpp"
#include "base/counted.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mrroc::link {

ReceiveDeadline::ReceiveDeadline(const Sources& sources, FaultCode silent, std::chrono::milliseconds timeout)
    : sources_(sources),
      silent_(silent),
      timeout_(timeout),
      begun_(Clock::now()),
      deadline_(timeout.count() > 0 ? begun_ + timeout : Clock::time_point::max()) {
  for (std::size_t k = 0; k < std::min(kMost, sources.size()); ++k)
    if (sources[k]) before_[k] = sources[k]->counters();
}

const InboxBase* ReceiveDeadline::find(bool malformed) const {
  for (std::size_t k = 0; k < std::min(kMost, sources_.size()); ++k) {
    if (!sources_[k]) continue;
    const Counters& now = sources_[k]->counters();
    const bool nothing = now.received == before_[k].received;
    if (nothing && (!malformed || now.malformed > before_[k].malformed)) return sources_[k];
  }
  return nullptr;
}

void ReceiveDeadline::check(Clock::time_point now) const {
  if (timeout_.count() == 0 || now - begun_ < timeout_ / 5) return;
  const InboxBase* source = find(true);
  const bool malformed = source != nullptr;
  if (!malformed && now < deadline_) return;
  if (!source) source = find(false);
  Fault fault{.code = malformed ? FaultCode::malformed_message : silent_};
  const double seconds = std::chrono::duration<double>(now - begun_).count();
  if (source) {
    const Counters& c = source->counters();
    fault.text =
        fmt::format("{}, waited for {:.1f} s; {} taken, {} malformed, {} of another session",
                    source->channel(), seconds, counted(c.received, "message"), c.malformed, c.foreign);
  } else {
    fault.text = fmt::format("messages come, but not the one that is waited for, since {:.1f} s", seconds);
  }
  throw FaultError(fault);
}

}  // namespace mrroc::link
