// The curves of motions: which generator of ecp/generators makes one, how fast it is, and how slow it has to be.
#pragma once
#include <memory>
#include <vector>

#include "ecp/generators/space.hpp"
#include "ecp/generators/teach_in.hpp"
#include "ecp/generators/trajectory.hpp"
#include "tasks/move/motion_file.hpp"

namespace mrroc::any_motion {

/// Speeds and accelerations of the set points of a motion from macrostep to macrostep, as multiples of their limits
/// (ecp::default_limits). Of motors and joints one number per axis, of poses two: along and about.
struct Rates {
  std::vector<ecp::Coordinates> velocity;      ///< between set points k and k + 1
  std::vector<ecp::Coordinates> acceleration;  ///< at set point k; the motion begins and ends at rest
};

/// @param space  of the trajectory's coordinates; no frame
[[nodiscard]] Rates rates_of(const ecp::Trajectory& path, Representation space, int axes, double macrostep_s);

/// @return largest number of all; 0 without any
[[nodiscard]] double largest(const std::vector<ecp::Coordinates>& shares);

/// @return the positions from `from` on, absolute, each in the coordinates nearest to those before
[[nodiscard]] std::vector<ecp::Coordinates> way_of(const MotionSpec& motion, const ecp::Coordinates& from);

/// @param from  where the motion begins, in its coordinates (MotionSpec::planned)
/// @param axes  of the arm
/// @return the curve of any motion but a replay
/// @throws FaultError bad_trajectory
[[nodiscard]] std::shared_ptr<const ecp::Curve> curve_of(const MotionSpec& motion,
                                                         const ecp::Coordinates& from, int axes,
                                                         const ecp::Pacing& pacing);

/// @return the recording of a replay, from `from` on
[[nodiscard]] ecp::TaughtPath recording_of(const MotionSpec& motion, const ecp::Coordinates& from);

/// A curve that takes another time.
class Stretched final : public ecp::Curve {
 public:
  /// @param time  [s], above zero
  Stretched(std::shared_ptr<const ecp::Curve> curve, double time) : curve_(std::move(curve)), time_(time) {}
  [[nodiscard]] double duration() const override { return time_; }
  [[nodiscard]] ecp::Coordinates at(double t) const override {
    return curve_->at(t >= time_ ? curve_->duration() : t / time_ * curve_->duration());
  }

 private:
  std::shared_ptr<const ecp::Curve> curve_;
  double time_;
};

}  // namespace mrroc::any_motion
