// Detects that a run has stood still for long, and tells what it waits for.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace mrroc::mp {

/// A watch over something that ought to change.
class WaitNotice {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time: it is a person who waits
  static constexpr std::chrono::seconds kFirst{
      10};                                ///< until the first notice; each next one takes twice as long
  static constexpr double kLongest = 30;  ///< a behaviour that is well may last so long in simulated time [s]

  /// Call it often.
  /// @param sim_s   simulated time [s]
  /// @param state   whatever changes when the run goes on
  /// @param stands  nothing but an order can change it: kLongest does not count
  /// @return how long the state has been the same, when it is time to tell
  std::optional<std::chrono::seconds> look(Clock::time_point now, double sim_s, const std::string& state,
                                           bool stands);

 private:
  std::optional<std::string> state_;
  Clock::time_point since_{};
  double since_s_{};  // simulated [s]
  std::chrono::seconds next_{kFirst};
};

/// The reason why a run stands still, and what would help.
struct Wait {
  int m{};                  ///< behaviour of the coordinator
  std::string behaviour{};  ///< its name; empty: none has begun
  std::string until{};      ///< what ends it, in the words of its row (base/motion.hpp); may be empty
  std::string command{};    ///< of `ui_cli` that gives the order below
  std::string order{};      ///< of the operator that it needs, such as "trigger 2"; empty: none
  bool scripted{};          ///< orders come from a script ...
  std::optional<std::int64_t> next_in_script{};  ///< ... the next one in this macrostep; none: it has ended
};

/// @return the behaviour and what ends it, in one line
[[nodiscard]] std::string what(const Wait& wait);
/// @return the same with what is known of the script, and the order that would help
[[nodiscard]] std::string to_string(const Wait& wait);

}  // namespace mrroc::mp
