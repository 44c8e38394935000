// Makes the commands of single macrosteps from a curve.
#pragma once
#include <cstdint>
#include <memory>

#include "base/effector_command.hpp"
#include "ecp/generators/curve.hpp"

namespace mrroc::ecp {

/// How a motion is cut into macrosteps. n_s is the original's, and n_Q the one that the framework's drivers
/// expect.
struct Pacing {
  double dt{0.002};       ///< duration of a step [s]
  std::uint16_t n_s{10};  ///< number_of_steps of a macrostep
  std::uint16_t n_Q{9};   ///< value_in_step_no

  /// @return duration of a macrostep [s]
  [[nodiscard]] constexpr double macrostep_s() const { return dt * n_s; }
};

/// Meaning of the coordinates for the driver.
struct Coding {
  Representation space{Representation::joints};  ///< of the coordinates
  Reference reference{Reference::absolute};      ///< relative: commands carry the increment of the macrostep
  Interpolation mu{Interpolation::mim};          ///< mim or tcim_pose; motors and joints need mim
};

/// A curve, ready to be executed: at macrostep k -> set pose and command. A value that shares the curve,
/// cheap to copy: it belongs into the memory c_c, and f' takes from it what x.i - x.i_0 asks for.
class Trajectory {
 public:
  /// No motion: it has ended before its first macrostep, and has no coordinates.
  Trajectory() = default;
  /// @throws FaultError bad_trajectory  motors or joints with TCIM, a pacing that makes no sense
  Trajectory(std::shared_ptr<const Curve> curve, const Coding& coding, const Pacing& pacing = {});

  /// @return macrosteps from the first to the last point
  [[nodiscard]] std::int64_t macrosteps() const { return macrosteps_; }
  /// @param k  macrosteps executed; 0 and less: the first point; macrosteps() and more: exactly the last one
  /// @return set position at the end of them. There must be a curve
  [[nodiscard]] Coordinates set_position(std::int64_t k) const;
  /// @param k  macrosteps executed before; from macrosteps() on the command is to stay
  /// @return SET ARM that moves from set_position(k) to set_position(k + 1); all axes of the task frame are
  ///         UNGUARDED, which the caller may change for TCIM. There must be a curve
  [[nodiscard]] ArmCommand command(std::int64_t k) const;

 private:
  [[nodiscard]] PoseNumbers increment(std::int64_t k) const;

  std::shared_ptr<const Curve> curve_;
  Coding coding_;
  Pacing pacing_;
  std::int64_t macrosteps_{};
};

}  // namespace mrroc::ecp
