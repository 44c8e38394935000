// The mass matrix of a description against the engines' bodies.
#include "test/sim/link_mass.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "sim/engine.hpp"
#include "sim/simulated_arm.hpp"
#include "test/rig/engines.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {
namespace {

class LinkMass : public testing::TestWithParam<PhysicsEngine> {};

TEST_P(LinkMass, IsThatOfTheEnginesBodies) {
  WorldParameters p = rig::irb6_cell();
  p.arms.resize(1);
  std::vector<ArmPlan> plans;
  plans.push_back(plan_arm(p.arms[0]));
  const auto engine = GetParam() == PhysicsEngine::mujoco ? mujoco_engine(p, plans) : bullet_engine(p, plans);
  const ArmAtRest rest = engine->arm(0).at_rest();
  const AxisMatrix mass = link_mass(plans[0].chain, rest.joints);
  EXPECT_LT((mass - rest.mass).cwiseAbs().maxCoeff(), 1e-3 * rest.mass.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Engines, LinkMass, testing::ValuesIn(rig::engines()), rig::engine_name);

}  // namespace
}  // namespace mrroc::sim
