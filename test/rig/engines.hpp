// The physics engines of this build, for tests of what all of them have in common.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/engine.hpp"

namespace mrroc::rig {

/// @return those that this build has
[[nodiscard]] inline std::vector<sim::PhysicsEngine> engines() {
  std::vector<sim::PhysicsEngine> all{sim::PhysicsEngine::bullet};
  if (sim::has_mujoco()) all.push_back(sim::PhysicsEngine::mujoco);
  return all;
}

/// @return name of the engine, as the configuration has it
[[nodiscard]] inline std::string engine_name(const testing::TestParamInfo<sim::PhysicsEngine>& info) {
  return info.param == sim::PhysicsEngine::mujoco ? "mujoco" : "bullet";
}

}  // namespace mrroc::rig
