// The arm of a plan, as an interface: the robot knows its kinematics, the task asks.
#pragma once
#include <optional>

#include "base/effector_command.hpp"
#include "base/pose.hpp"
#include "ecp/generators/curve.hpp"

namespace mrroc::any_motion {

/// Kinematics of an arm with its tool. Pure: the same question gets the same answer.
class Body {
 public:
  Body() = default;
  virtual ~Body() = default;
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  /// @return number of its axes
  [[nodiscard]] virtual int axes() const = 0;
  /// @return joints in which it usually stands [rad, track m]
  [[nodiscard]] virtual ecp::Coordinates usual_start() const = 0;
  /// @return T_0E
  [[nodiscard]] virtual Pose pose(const ecp::Coordinates& joints) const = 0;
  /// @return motor positions [rad]
  [[nodiscard]] virtual ecp::Coordinates motors(const ecp::Coordinates& joints) const = 0;
  /// @return joints of motor positions
  [[nodiscard]] virtual ecp::Coordinates joints_of_motors(const ecp::Coordinates& motors) const = 0;
  /// @param near  joints that choose the branch @return joints with which E is there; nothing: it is out of reach
  [[nodiscard]] virtual std::optional<ecp::Coordinates> joints_of_pose(
      const Pose& T_0E, const ecp::Coordinates& near) const = 0;
};

}  // namespace mrroc::any_motion
