// The reach of an arm, as an interface: the robot knows it, the task asks.
#pragma once
#include <optional>

#include "base/effector_command.hpp"
#include "ecp/generators/space.hpp"

namespace mrroc::manual {

/// Ranges of an arm. Pure: the same question gets the same answer.
class Reach {
 public:
  virtual ~Reach() = default;
  /// @param space  of the goal: motors, joints, or a pose of E in the base
  /// @param now    what the driver says: joints, motors and T_0E tell where the arm is and which tool it has
  /// @param model  kinematic model in force; nothing: that of the configuration
  /// @return why the arm cannot be there: axis, value and limit of the first one beyond. Nothing: it can, or it is not
  ///         known where it is
  [[nodiscard]] virtual std::optional<Fault> validation_error(Representation space,
                                                              const ecp::Coordinates& goal,
                                                              const EffectorReply& now,
                                                              std::optional<int> model) const = 0;
};

}  // namespace mrroc::manual
