#include "tasks/drawing/cell/paper.hpp"

#include "sim/config.hpp"

namespace mrroc::drawing {

std::array<Vector3, kArms> paper_places(const Config& config) {
  const sim::WorldParameters world = sim::read_world(config);
  return {world.arms.at(0).paper.T_0P.p, world.arms.at(1).paper.T_0P.p};
}

}  // namespace mrroc::drawing
