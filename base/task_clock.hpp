// Task time, which a pause stops (rule R8 in docs/architecture.md).
#pragma once
#include <algorithm>

namespace mrroc {

/// Task time as transition functions see it: a part of an image x.
struct TaskTime {
  double time{};   ///< that has passed until this macrostep [macrosteps]
  double pace{1};  ///< that passes in the macrostep which is being decided on, 0..1
  bool paused{};   ///< a pause has been ordered
};

/// Counts task time, once per macrostep, and obeys a pause in one of two ways:
/// ramped: task time slows down to zero and comes back in the same way, and commanded velocities do, too;
/// at the next safe row: task time goes on as before until the task is in the behaviour in which its arms may stand.
class TaskClock {
 public:
  static constexpr int kRamp = 10;  ///< macrosteps from full pace to standstill, unless a task says otherwise

  /// @param ramp  macrosteps from full pace to standstill, at least 1
  [[nodiscard]] static constexpr TaskClock ramped(int ramp = kRamp) { return TaskClock(1.0 / ramp, 0); }
  /// @param m  number of the behaviour in which the arms may stand, not 0
  [[nodiscard]] static constexpr TaskClock at_safe_row(int m) { return TaskClock(1, m); }

  /// The next macrostep.
  /// @param paused  a pause has been ordered
  /// @param m       present behaviour; counts where a safe row is waited for
  constexpr void advance(bool paused, int m = 0) {
    if (begun_) now_.time += now_.pace;
    begun_ = true;
    now_.paused = paused;
    const bool stops = paused && (safe_m_ == 0 || m == safe_m_);
    now_.pace = std::clamp(now_.pace + (stops ? -change_ : change_), 0.0, 1.0);
  }

  /// @return task time in the present macrostep
  [[nodiscard]] constexpr const TaskTime& now() const { return now_; }
  /// @return whether the task is paused as the operator sees it: as soon as the pause is ordered, or when the safe row has come
  [[nodiscard]] constexpr bool paused() const { return now_.paused && (safe_m_ == 0 || now_.pace == 0); }

 private:
  constexpr TaskClock(double change, int safe_m) : change_(change), safe_m_(safe_m) {}

  double change_;  // of the pace per macrostep
  int safe_m_;     // 0: any behaviour
  TaskTime now_;
  bool begun_{};
};

}  // namespace mrroc
