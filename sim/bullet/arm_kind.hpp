// What differs between kinds of simulated arms: how they are made, of what bodies, and where they begin.
#pragma once
#include <memory>
#include <optional>

#include "edp/robot.hpp"
#include "sim/bullet/multibody.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// One kind of arms. Has no state.
class ArmKind {
 public:
  virtual ~ArmKind() = default;
  /// @return kinematics, transmissions and ranges of that arm
  [[nodiscard]] virtual std::unique_ptr<edp::Robot> make(const ArmParameters& p) const = 0;
  /// @param robot  of make() @param joints  at which the inertia of the rotors is taken [rad, track m]
  /// @param tool   beyond the last link; nothing: that of the description
  [[nodiscard]] virtual ArmBody build(const edp::Robot& robot, const ArmParameters& p,
                                      const AxisVector& joints,
                                      const std::optional<ToolMass>& tool) const = 0;
  /// @return joints at which an arm begins whose parameters do not say it [rad, track m]
  /// @throws std::invalid_argument  there are none
  [[nodiscard]] virtual AxisVector start(const edp::Robot& robot, const ArmParameters& p) const = 0;
};

/// @throws std::invalid_argument  the parameters name no kind
[[nodiscard]] const ArmKind& kind_of(const ArmParameters& p);

}  // namespace mrroc::sim
