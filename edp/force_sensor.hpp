// Adjusted force: the force of the end effector on its surroundings, without the tool's weight.
// MG 8.2, eq. (44), (45).
#pragma once
#include <array>
#include <optional>

#include "base/fault.hpp"
#include "base/pose.hpp"
#include "edp/driver_parameters.hpp"

namespace mrroc::edp {

/// Error of a reading of the force sensor.
struct SensorDiagnostic {
  int component{};  ///< 0..5, along and about the axes of S; -1: all
  double value{};   ///< [N], [N m]
  double limit{};   ///< [N], [N m]; of a stuck component the number of equal readings allowed
};

/// Force/torque sensor in the wrist. Frames: W wrist, S sensor, G mass centre of the tool (orientation of W).
/// The raw reading is the external load on the tool side of the sensor, gravity and surroundings, in S.
/// Real-time safe.
class ForceSensor {
 public:
  /// State of the readings.
  enum class Health : std::uint8_t {
    good,        ///< the reading is used
    skipped,     ///< a bad reading was left out, the last good one stands
    silent,      ///< no component is a number in fault_after readings in succession: there is no sensor
    not_finite,  ///< a component is not finite in fault_after readings in succession
    saturated,   ///< a component is at the end of its range in fault_after readings in succession
    stuck,       ///< a component has not changed for stuck_after readings, not even by noise
  };
  /// Readings at rest of which the bias is the mean; when the arm has stood for a shorter time, of those that
  /// there are, at least the last one.
  static constexpr int kBiasWindow = 50;

  /// @param dt time between readings [s]
  explicit ForceSensor(const ForceSensorParameters& parameters, double dt = 0.002) noexcept;

  /// Takes the reading of one step.
  /// @param S_F_m  raw reading [N, N m]
  /// @param at_rest the arm stands still; readings of a moving arm do not count for the bias
  Health take(const Wrench& S_F_m, bool at_rest) noexcept;

  /// @return what was wrong with the last bad reading
  [[nodiscard]] const SensorDiagnostic& diagnostic() const noexcept { return diagnostic_; }

  /// Weight and mass centre of everything beyond the sensor; bias() must follow, the old one is void.
  /// @param w [N], >= 0  @param P W_G P [m], in W
  void set_tool(double w, const Vector3& P) noexcept;

  /// Memorises the present reading and orientation, eq. (44): from now on F_a is zero without contact. Only
  /// at standstill and without contact.
  /// @param R_0W orientation of the wrist in the base
  void bias(const Matrix3& R_0W) noexcept;

  /// Eq. (45). @param R_0W orientation of the wrist in the base
  /// @return W_F_a: force exerted on the surroundings, at W, expressed in W [N, N m]
  [[nodiscard]] Wrench adjusted(const Matrix3& R_0W) const noexcept;

 private:
  [[nodiscard]] Wrench gravity(const Matrix3& R_0W) const noexcept;
  [[nodiscard]] Health judge(const Wrench& S_F_m) noexcept;
  [[nodiscard]] Health count_bad(Health health, const SensorDiagnostic& diagnostic) noexcept;
  [[nodiscard]] bool stuck(const Wrench& S_F_m) noexcept;
  [[nodiscard]] Wrench mean_with(const Wrench& S_F_m) noexcept;

  ForceSensorParameters p_;
  double weight_of_new_;  // in the low pass
  Wrench S_F_m_;          // filtered
  Wrench S_F_0_;          // raw reading at the bias
  Wrench W_F_r_;          // compensation force
  std::array<Wrench, 4> recent_{};
  std::size_t recent_count_{};
  int bad_in_succession_{};
  Wrench last_{};
  std::array<int, 6> unchanged_{};  // readings since a component changed
  SensorDiagnostic diagnostic_{};
  std::array<Wrench, kBiasWindow> at_rest_{};
  std::size_t at_rest_count_{};
  bool was_at_rest_{};
};

/// @return the fatal fault that a health is, naming the component; nothing for good and skipped. Real-time safe
[[nodiscard]] std::optional<Fault> sensor_fault(ForceSensor::Health health,
                                                const SensorDiagnostic& diagnostic) noexcept;

}  // namespace mrroc::edp
