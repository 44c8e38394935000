#include "mp/wait_notice.hpp"

#include <fmt/core.h>

namespace mrroc::mp {

std::optional<std::chrono::seconds> WaitNotice::look(Clock::time_point now, double sim_s,
                                                     const std::string& state, bool stands) {
  if (state_ != state) {
    state_ = state;
    since_ = now;
    since_s_ = sim_s;
    next_ = kFirst;
  }
  const auto waited = std::chrono::floor<std::chrono::seconds>(now - since_);
  if (waited < next_ || (!stands && sim_s - since_s_ < kLongest)) return std::nullopt;
  next_ = 2 * waited;
  return waited;
}

std::string what(const Wait& w) {
  std::string text =
      w.behaviour.empty() ? "the first behaviour has not begun" : fmt::format("m = {}, {}", w.m, w.behaviour);
  if (!w.until.empty()) text += fmt::format(", goes on until: {}", w.until);
  return text;
}

std::string to_string(const Wait& w) {
  std::string text = what(w);
  if (w.scripted)
    text += w.next_in_script ? fmt::format("; the script's next order is for macrostep {}", *w.next_in_script)
                             : "; the script has ended";
  if (w.order.empty()) return text + "; `ui_cli stop` ends the run";
  return text + fmt::format("; the run waits for {}: `ui_cli {}`", w.order, w.command);
}

}  // namespace mrroc::mp
