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

  /// The robot is regulated to the end of its way, as its last command wants it: what moves it there is no stop.
  /// @param until  first step after that; never falls
  void regulated(std::int64_t until) noexcept { regulated_until_ = until; }

  /// @return whether the robot rests: nothing commands it, the brakes are closed or the set point stands, and the motors
  ///         have not moved for kSettled steps
  [[nodiscard]] bool at_rest() const noexcept {
    return holds_ && now_ >= commanded_until_ && now_ - moved_ > kSettled;
  }
  /// @param stopped  step of the stop
  /// @return steps from the end of the last commanded macrostep, or of the last regulated one, to rest; of a robot that had
  ///         moved by itself for longer, as in homing, from the stop to rest
  [[nodiscard]] int stop_steps(std::int64_t stopped) const noexcept {
    const std::int64_t obeyed_until = std::max(commanded_until_, regulated_until_);
    const bool by_itself = moved_ - obeyed_until > kLongestStop;
    const std::int64_t from = by_itself ? std::max(stopped, obeyed_until) : obeyed_until;
    return static_cast<int>(std::max<std::int64_t>(0, moved_ + 1 - from));
  }

 private:
  AxisVector away_;  // from where the motors stood when they moved last [encoder increments]
  std::int64_t now_{};
  std::int64_t moved_{-1};  // last step in which they moved
  std::int64_t commanded_until_{};
  std::int64_t regulated_until_{};
  bool holds_{};
};

}  // namespace mrroc::edp
