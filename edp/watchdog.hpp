// The effector driver's reaction when messages stop, with the wall clock or with real drives.
#pragma once
#include <cstdint>

namespace mrroc::edp {

/// Counts periods without a state of the drives, and macrosteps without a command. Real-time safe; asks no
/// clock: it is told what has come and what has not.
class Watchdog {
 public:
  /// Action to take.
  enum class Verdict : std::uint8_t {
    well,        ///< go on
    decelerate,  ///< the macrostep that begins has no command after one that had: the arm comes to rest and holds
    trip,        ///< the drives have been silent for too long: fault hardware_silent
  };

  /// @param state_timeout  periods without a state after which the drives count as silent, >= 1 [steps]
  constexpr explicit Watchdog(int state_timeout) : state_timeout_(state_timeout) {}

  /// A state has come.
  constexpr void state() noexcept { silent_ = 0; }
  /// A step's time has passed without a state.
  /// @return trip, once for each silence
  constexpr Verdict no_state() noexcept {
    return ++silent_ == state_timeout_ ? Verdict::trip : Verdict::well;
  }

  /// A macrostep begins.
  /// @param commanded  whether a command for it is there
  /// @return decelerate, once for each silence
  constexpr Verdict macrostep(bool commanded) noexcept {
    const bool ends = commanded_ && !commanded;
    commanded_ = commanded;
    holds_ += ends;
    return ends ? Verdict::decelerate : Verdict::well;
  }

  /// @return periods without a state since the last one [steps]
  [[nodiscard]] constexpr int silent() const noexcept { return silent_; }
  /// @return how often a command was missing after one that had come
  [[nodiscard]] constexpr std::int64_t holds() const noexcept { return holds_; }

 private:
  int state_timeout_;
  int silent_{};
  bool commanded_{};
  std::int64_t holds_{};
};

}  // namespace mrroc::edp
