#include "sim/world.hpp"

namespace mrroc::sim {

ArmParameters arm_parameters(const robots::RobotType& type) {
  ArmParameters p;
  p.type = &type;
  p.T_UB = type.T_UB;
  p.motors = type.motors;
  return p;
}

}  // namespace mrroc::sim
