// Trapezoidal velocity through a list of poses, all axes synchronised ("newsmooth" of MRROC++).
#pragma once
#include <vector>

#include "ecp/generators/space.hpp"

namespace mrroc::ecp {

/// A pose of the list, and how to go there. Fractions are of the limits, above 0 up to 1.
struct ViaPoint {
  Coordinates pose;           ///< in the space of the motion
  double velocity{0.15};      ///< fraction of the largest velocity
  double acceleration{0.02};  ///< fraction of the largest acceleration
  bool pass{};                ///< blend: goes through it without stopping; the last pose is always a stop
};

/// For generators that take such lists.
/// @throws FaultError bad_trajectory  as Trapezoid's constructor
void check_list(const Coordinates& from, const std::vector<ViaPoint>& list, const MotionLimits& limits,
                double macrostep_s);

/// Every axis accelerates, keeps its speed and slows down, all in the same time, as fast as the limits of the
/// slowest one allow. Time to a pose is a whole number of macrosteps, so that a set position lies exactly on
/// every pose. Where poses are passed, each axis has one speed before and behind: the smaller of the mean
/// speeds of both sections, none where it turns round. So speed is continuous and acceleration never beyond
/// its limit.
class Trapezoid final : public Curve {
 public:
  /// @param from   first pose, at rest
  /// @param list   at least one pose
  /// @param macrostep_s  duration of a macrostep, > 0 [s]
  /// @throws FaultError bad_trajectory  no pose, sizes that differ, numbers that are not finite, a fraction
  ///         or a limit out of its range
  Trapezoid(const Coordinates& from, std::vector<ViaPoint> list, const MotionLimits& limits,
            double macrostep_s);

  [[nodiscard]] double duration() const override;
  [[nodiscard]] Coordinates at(double t) const override;
  /// @return macrosteps from the first pose to each pose of the list
  [[nodiscard]] const std::vector<long>& arrivals() const { return arrivals_; }

 private:
  /// One axis between two poses: from v0 to vc, constant, to v1, with the acceleration a.
  struct Profile {
    double p0{}, v0{}, vc{}, v1{}, a{};
  };
  struct Section {
    std::vector<Profile> axes;
  };
  class Planner;

  double macrostep_s_;
  Coordinates end_;
  std::vector<Section> sections_;
  std::vector<long> arrivals_;
};

}  // namespace mrroc::ecp
