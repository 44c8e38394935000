// Position regulator with a model of its drive: feed-forward of speed and load, observer of unknown loads.
#pragma once
#include <cstdint>
#include <limits>

#include "base/hardware.hpp"

namespace mrroc::edp {

/// A regulator's model of the drive of one motor; everything at the shaft. Nominal: the real figures
/// may differ by tens of per cent.
struct DriveModel {
  double resistance{1};     ///< of winding and bridge [ohm], positive
  double inertia{1};        ///< of all that turns with the shaft [kg m^2], positive
  double friction{};        ///< that is compensated [N m]. A shaft with less is none the worse for it: the
                            ///< compensation follows the set motion, so it cannot make the loop hunt
  double presliding{0.02};  ///< turn in which friction builds up after a reversal [rad], positive
  /// To which the drive limits its current [A], positive: the torque grows no further.
  double current_limit{std::numeric_limits<double>::infinity()};
  /// From which on the supervision stops the arm [A]: not below current_limit, so the drive has not limited its current.
  /// Regulators that know their drive ask for no more than 0.8 of it, and than current_limit.
  double max_current{std::numeric_limits<double>::infinity()};
  double torque_constant{0.105};  ///< [N m/A], equal to the voltage constant [V s/rad]
  double supply{48};              ///< voltage at full duty cycle [V]

  /// @return speed of the free shaft per duty cycle [rad/s per 1/255]
  [[nodiscard]] constexpr double speed_per_pwm() const { return supply / kPwmScale / torque_constant; }
  /// @return duty cycle that holds a torque at rest [1/255 per N m]
  [[nodiscard]] constexpr double pwm_per_torque() const {
    return resistance / torque_constant * kPwmScale / supply;
  }
  /// @return of speed after a step of voltage [s]
  [[nodiscard]] constexpr double time_constant() const {
    return resistance * inertia / (torque_constant * torque_constant);
  }
};

/// Coefficients of one CompensatingRegulator.
struct CompensationCoefficients {
  double bandwidth{};  ///< of the position loop: its double pole [rad/s], positive
  double observer{};   ///< of the observer: its triple pole [rad/s], positive
};

/// Numbers of a CompensatingRegulator, in encoder increments, steps and 1/255 of the supply.
struct CompensationGains {
  double alpha;          ///< model: share of the speed that is kept in a step without current
  double beta;           ///< its way in that step, per speed
  double gain;           ///< speed per duty cycle
  double k_p, k_v;       ///< of the regulator
  double l_p, l_v, l_d;  ///< of the observer
};

/// Position regulator with feed-forward of speed and gravity, and compensation of friction.
///
/// With p and v the position and speed of the shaft, Set the sum of all set increments r before this step, and
/// a load d that an observer estimates together with p and v from the encoder and the duty cycles sent:
///
///     e_p = Set - r(k-1)/2 - p,   e_v = r(k-1) - v
///     u = u_r + K_p e_p + K_v e_v - d + u_g + u_f,   clipped
///
/// u_r is the duty cycle that takes the model of the drive from speed r(k-1) to r(k) in one step; on the way the
/// shaft is half a step behind its set position. u_g is the gravity feed-forward that is told, u_f is Dahl's
/// friction of a shaft that moves as it is set to. What is left of the load - friction and inertia that are
/// not as expected, forces of contact - is the observer's d: there is no other integral action, so
/// nothing winds up when the output is clipped. It is clipped at
/// 0.8 of the largest current and at the drive's limit too, as the model has it.
///
/// Units: encoder increments, steps, and 1/255 of the supply. Real-time safe but for the constructor.
class CompensatingRegulator {
 public:
  CompensatingRegulator() = default;
  /// @param increments_per_rad encoder increments per radian of the shaft  @param dt duration of a step [s]
  CompensatingRegulator(const CompensationCoefficients& c, const DriveModel& drive, double increments_per_rad,
                        double dt);

  /// @param set_increment         motion of the set position in this step [increments]
  /// @param error                 set position before this step minus measured position [increments]
  /// @param gravity_feed_forward  torque that holds the known load, e.g. gravity [N m]
  /// @return duty cycle, within +-kMaxPwm
  [[nodiscard]] double step(double set_increment, double error, double gravity_feed_forward) noexcept;

  /// Goes on where a regulator of another kind has left off: the next duty cycle is pwm, and its difference from
  /// what this regulator asks for fades away. The load is the one that pwm has been holding.
  /// @param set_increment of the step before [increments]
  /// @param error         set position after that step minus position measured in it [increments]
  void resume(double set_increment, double error, double pwm) noexcept;
  /// Goes on where a regulator with other coefficients has left off, likewise.
  void resume(const CompensatingRegulator& other, double pwm) noexcept;
  /// The shaft was held by brakes and may have moved: it stands, and the load is the one known before.
  void restart() noexcept;
  /// Forgets the past: the shaft stands where it is set to be, without load.
  void reset() noexcept;

  /// @return whether the last step would have asked for more current than it may
  [[nodiscard]] bool at_limit() const noexcept { return at_limit_; }
  /// @return what the regulator is, but for friction and what clips it
  [[nodiscard]] CompensationGains gains() const noexcept {
    return {alpha_, beta_, gain_, k_p_, k_v_, l_p_, l_v_, l_d_};
  }

 private:
  double alpha_{}, beta_{}, gain_{};  // model: speed kept in a step, its way [steps], speed per duty cycle
  double per_gain_{}, per_rise_{};    // duty cycle per speed, and per rise of speed in a step
  double k_p_{}, k_v_{};
  double l_p_{}, l_v_{}, l_d_{};
  double torque_scale_{}, max_pull_{};
  double per_presliding_{};  // of Dahl's spring: one over the turn in which it yields [1/increments]
  double stiffness_{};       // of the same: duty cycle per deflection

  double p_{}, v_{}, d_{};  // predicted: position relative to the set one, speed, load
  double r_{};              // set increment of the step before
  double deflection_{};     // of Dahl's spring [increments]
  double bump_{};           // what is left of the difference from the regulator before
  double joined_pwm_{};     // its last duty cycle
  bool at_limit_{};         // of the current, in the last step
  bool restarted_{true};    // position and speed are to be taken from the next measurement
  enum class Join : std::uint8_t { none, with_its_load, without };
  Join join_{Join::none};
};

}  // namespace mrroc::edp
