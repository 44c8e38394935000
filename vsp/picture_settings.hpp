// Settings y_cV of receptors that look at pictures: assigns an agent's settings to the pictures.
#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include "base/link/transmission_link.hpp"

namespace mrroc::vsp {

/// Decides whether the setting for a picture has come.
class PictureSetting {
 public:
  virtual ~PictureSetting() = default;
  /// @param step  at which the picture is taken
  /// @return whether the setting for it has come, in lock-step; always, with the wall clock
  [[nodiscard]] virtual bool here(std::int64_t step) = 0;
};

/// Settings from an agent, one per macrostep; the one of the macrostep in which a picture is taken is for that picture, so
/// that a reading does not depend on how long the receptor looks at pictures. The agent's macrosteps have n_s steps.
/// @tparam V  what is set; V{}: nothing is asked of the receptor
template <link::Transmitted V>
class PictureSettings final : public PictureSetting {
 public:
  /// @param channel  without the session  @param n_s  steps of a macrostep
  PictureSettings(link::Process& process, const std::string& channel, int n_s)
      : process_(process),
        in_(process.bus(), process.route(channel), process.context().session_id),
        channel_(channel),
        n_s_(n_s) {}

  [[nodiscard]] bool here(std::int64_t step) override {
    collect();
    const std::int64_t i = step / n_s_;
    const bool ended = end_ != 0 && i >= end_;
    const bool stopped = process_.over() && i > process_.stop_as_of();
    return !process_.lock_step() || i == 0 || ended || stopped || come_.contains(i);
  }
  /// @param step  at which the picture was taken; never goes back
  /// @return what is set for it; with the wall clock the newest setting of a macrostep not above the picture's
  /// @throws FaultError malformed_message
  const V& at(std::int64_t step) {
    collect();
    const auto after = come_.upper_bound(step / n_s_);
    if (after != come_.begin()) {
      const auto& m = std::prev(after)->second;
      if (!is_proper(m))
        throw FaultError(FaultCode::malformed_message, channel_ + ": a number is not proper");
      value_ = from_message(m);
      come_.erase(come_.begin(), after);
    }
    return value_;
  }

 private:
  using M = link::MessageOf<V>;
  static constexpr std::size_t kMost =
      10000;  // of an agent that is ahead; latencies of cameras are far below

  void collect() {
    while (const auto m = in_.take()) {
      if (m->header.stamp == link::kEndOfLink)
        end_ = m->header.number;
      else if (come_.size() < kMost)
        come_.insert_or_assign(m->header.stamp, *m);
    }
  }

  link::Process& process_;
  link::Queue<M> in_;
  std::string channel_;
  int n_s_;
  std::map<std::int64_t, M> come_;  // by macrostep
  std::int64_t end_{};              // first macrostep without one, 0: not known
  V value_{};
};

}  // namespace mrroc::vsp
