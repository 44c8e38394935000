// Watches how arms come to rest after the last command.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace mrroc::sim {

/// When each arm moved last. Real-time safe.
class RestWatch {
 public:
  /// The tip of an arm at rest is slower than this [m/s].
  static constexpr double kRestSpeed = 0.0005;
  /// The tool of an arm at rest turns more slowly than this [rad/s]: as fast as kRestSpeed 0.2 m from the axis, farther
  /// than what an arm can turn without moving the tip reaches.
  static constexpr double kRestTurn = kRestSpeed / 0.2;
  /// An arm that has been at rest for so many steps stays at rest.
  static constexpr std::int64_t kSettled = 100;
  /// No stop takes that many steps: an arm that moves still longer after its last command moves by itself.
  static constexpr std::int64_t kLongestStop = 1000;

  /// Takes one step of one arm.
  /// @param speed            of the tool tip [m/s]
  /// @param turn             angular speed of the tool [rad/s]
  /// @param commanded_until  first step after the last commanded macrostep
  void step(int arm, std::int64_t step, double speed, double turn, std::int64_t commanded_until) {
    auto& a = arms_[static_cast<std::size_t>(arm)];
    now_ = step;
    a.commanded_until = std::max(a.commanded_until, commanded_until);
    if (speed >= kRestSpeed || turn >= kRestTurn) a.moved = step;
    known_ = std::max(known_, arm + 1);
  }

  /// @return whether every arm has been at rest for kSettled steps
  [[nodiscard]] bool at_rest() const {
    return std::all_of(arms_.begin(), arms_.begin() + known_, [this](const Arm& a) {
      return now_ >= a.commanded_until && now_ - a.moved > kSettled;
    });
  }
  /// @param stopped  step of the stop
  /// @return steps from the end of the last commanded macrostep to rest, per arm; of an arm that had moved by itself
  ///         for longer, as in homing, from the stop to rest; -1 for arms that are not there
  [[nodiscard]] std::array<int, 4> stop_steps(std::int64_t stopped) const {
    std::array<int, 4> steps{-1, -1, -1, -1};
    for (int k = 0; k < known_; ++k) {
      const Arm& a = arms_[static_cast<std::size_t>(k)];
      const bool by_itself = a.moved - a.commanded_until > kLongestStop;
      const std::int64_t from = by_itself ? std::max(stopped, a.commanded_until) : a.commanded_until;
      steps[static_cast<std::size_t>(k)] = static_cast<int>(std::max<std::int64_t>(0, a.moved + 1 - from));
    }
    return steps;
  }

 private:
  struct Arm {
    std::int64_t commanded_until{};
    std::int64_t moved{-1};  // last step in which it moved
  };
  std::array<Arm, 4> arms_{};
  std::int64_t now_{};
  int known_{};
};

}  // namespace mrroc::sim
