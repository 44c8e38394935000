// Digital position regulators of the motors: increments of the shaft in, PWM duty cycle out.
#pragma once
#include <algorithm>

namespace mrroc::edp {

/// Coefficients of one IncrementalRegulator. Source: the original framework's regulators of the IRp-6 arms.
struct RegulatorCoefficients {
  double epsilon{};  ///< weight of the position error against the increment error
  double a{};        ///< pole of the filter
  double b0{};       ///< zero, leading [1/255 of supply per encoder increment]
  double b1{};       ///< zero, delayed [1/255 of supply per encoder increment]
};

/// Largest duty cycle that a regulator may ask for, in 1/255 of the supply.
inline constexpr double kMaxPwm = 190;

/// Position regulator that works on increments of one step, in encoder increments:
///
///     e(k) = r(k) - y(k)
///     delta(k) = delta(k-1) + (1 + epsilon) e(k) - (1 - epsilon) e(k-1)
///     u(k) = (1 + a) u(k-1) - a u(k-2) + b0 delta(k) - b1 delta(k-1),  clipped to +-kMaxPwm
///
/// Real-time safe.
class IncrementalRegulator {
 public:
  constexpr IncrementalRegulator() = default;
  /// Begins at rest: no errors and duty cycles before.
  constexpr explicit IncrementalRegulator(const RegulatorCoefficients& k) : k_(k) {}

  /// @param set_increment       r: motion of the set position in this step [encoder increments, need not be
  /// whole]
  /// @param measured_increment  y: motion of the shaft in the step before [encoder increments]
  /// @return u: duty cycle [1/255 of the supply], within +-kMaxPwm
  constexpr double step(double set_increment, double measured_increment) noexcept {
    const double e = set_increment - measured_increment;
    const double delta = delta_ + (1 + k_.epsilon) * e - (1 - k_.epsilon) * e_;
    const double u =
        std::clamp((1 + k_.a) * u1_ - k_.a * u2_ + k_.b0 * delta - k_.b1 * delta_, -kMaxPwm, kMaxPwm);
    e_ = e;
    delta_ = delta;
    u2_ = u1_;
    u1_ = u;
    return u;
  }

  /// Goes on where another regulator has left off: the next u differs from pwm only by the answer to the next
  /// increments.
  /// @param error          position set minus position of the shaft [encoder increments]; it is not lost
  /// @param last_increment r - y of the step before [encoder increments]
  /// @param pwm            the last duty cycle [1/255 of the supply]
  constexpr void resume(double error, double last_increment, double pwm) noexcept {
    e_ = last_increment;
    delta_ = (1 - k_.epsilon) * last_increment + 2 * k_.epsilon * error;
    u1_ = u2_ = pwm;
  }

  /// Forgets the past: no error, no output.
  constexpr void reset() noexcept { e_ = delta_ = u1_ = u2_ = 0; }

 private:
  RegulatorCoefficients k_{};
  double e_{}, delta_{}, u1_{}, u2_{};
};

}  // namespace mrroc::edp
