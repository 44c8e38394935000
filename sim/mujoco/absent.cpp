// A build without MuJoCo (MRROC_MUJOCO=OFF).
#include <stdexcept>

#include "sim/engine.hpp"

namespace mrroc::sim {

bool has_mujoco() { return false; }

std::unique_ptr<Engine> mujoco_engine(const WorldParameters& /*parameters*/,
                                      const std::vector<ArmPlan>& /*plans*/) {
  throw std::invalid_argument("world: this build has no MuJoCo");
}

}  // namespace mrroc::sim
