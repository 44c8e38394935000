// The conveyor of MS 8.3 as the effector driver sees it (edp/robot.hpp): a robot with one axis.
#pragma once
#include <string_view>

#include "edp/robot.hpp"
#include "robots/catalogue.hpp"
#include "robots/conveyor/parameters.hpp"

namespace mrroc::conveyor {

/// The kernel of the driver. W is on the belt, where the middle of the first sheet lies; its z points down into the
/// sheet and its y against the belt's, as W of an arm does that writes there. Every function is real-time safe.
class Conveyor final : public edp::Robot {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "conveyor"; }
  [[nodiscard]] int axes() const noexcept override { return 1; }
  [[nodiscard]] const edp::AxisProperties& axis(int axis) const noexcept override;
  [[nodiscard]] Pose forward(const AxisVector& joints) const noexcept override;
  /// A pose off the belt's line, or turned, is out of reach; `missing` is its distance from that.
  [[nodiscard]] edp::InverseSolution inverse(const Pose& T_0W,
                                             const AxisVector& near) const noexcept override;
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& joints) const noexcept override;
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& motors) const noexcept override;
};

/// @return what driver, tasks and simulator must know of the conveyor
const robots::RobotType& type();

/// @return conveyor.urdf; the build puts it into the library
std::string_view urdf();

}  // namespace mrroc::conveyor
