// Detects from the encoders that a robot has come to rest.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/axes.hpp"

namespace mrroc::edp {

/// When the motors of one robot moved last. Needs no model of the robot and no plant that tells the truth. Real-time safe.
class StandstillDetector {
 public:
  /// Motors that stay within so many encoder increments have not moved: regulators and quantisation turn a shaft that
  /// stands by one or two.
  static constexpr double kPlay = 2;
  /// A robot whose motors have stood for so many steps is at rest.
  static constexpr std::int64_t kSettled = 100;
  /// No stop takes that many steps: a robot that moves still longer after its last command moves by itself.
  static constexpr std::int64_t kLongestStop = 1000;

  /// Takes one step.
  /// @param step             number of the step; the first one is any
  /// @param increment        of the motors of the axes since the step before [encoder increments]
  /// @param commanded_until  first step after the last commanded macrostep; never falls
  /// @param holds            the brakes are closed, or the set point stands
  void step(std::int64_t step, const AxisVector& increment, std::int64_t commanded_until,
            bool holds) noexcept {
    if (away_.size() != increment.size()) {
      away_ = AxisVector::Zero(increment.size());
      moved_ = step - 1;
    }
    away_ += increment;
    now_ = step;
    commanded_until_ = commanded_until;
    holds_ = holds;
    if (away_.cwiseAbs().maxCoeff() <= kPlay) return;
    moved_ = step;
    away_.setZero();
  }

  /// @return whether the robot rests: nothing commands it, the brakes are closed or the set point stands, and the motors
  ///         have not moved for kSettled steps
  [[nodiscard]] bool at_rest() const noexcept {
    return holds_ && now_ >= commanded_until_ && now_ - moved_ > kSettled;
  }
  /// @param stopped  step of the stop
  /// @return steps from the end of the last commanded macrostep to rest; of a robot that had moved by itself for
  ///         longer, as in homing, from the stop to rest
  [[nodiscard]] int stop_steps(std::int64_t stopped) const noexcept {
    const bool by_itself = moved_ - commanded_until_ > kLongestStop;
    const std::int64_t from = by_itself ? std::max(stopped, commanded_until_) : commanded_until_;
    return static_cast<int>(std::max<std::int64_t>(0, moved_ + 1 - from));
  }

 private:
  AxisVector away_;  // from where the motors stood when they moved last [encoder increments]
  std::int64_t now_{};
  std::int64_t moved_{-1};  // last step in which they moved
  std::int64_t commanded_until_{};
  bool holds_{};
};

}  // namespace mrroc::edp
