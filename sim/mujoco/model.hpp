// The work cell as a model of MuJoCo.
#pragma once
#include <mujoco/mujoco.h>

#include <memory>
#include <vector>

#include "sim/engine.hpp"

namespace mrroc::sim {

/// MuJoCo's objects, freed by itself.
struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
};
template <class Object>
using MujocoPtr = std::unique_ptr<Object, MujocoDeleter>;

/// Where the parts of an arm are in the model.
struct ArmInModel {
  std::vector<int> links;  ///< bodies of the chain's links
  int joint{};             ///< place of the first joint among positions and speeds; the others follow
  int joints{};            ///< how many there are
  int tool{};              ///< body of the tool
  int pen{-1};             ///< shape of the pen's ball; -1: there is none
  int brake{};             ///< tendon that is the shaft of the first motor; the others follow
  int force{};             ///< place of the force of its sensor among sensor data; the torque follows
  Pose T_GS;               ///< as Chain has it
  Pose T_GE;               ///< as Chain has it
};

/// Model and state of all arms, at rest at their beginning.
struct CellModel {
  MujocoPtr<mjModel> model;      ///< never null
  MujocoPtr<mjData> data;        ///< never null
  std::vector<ArmInModel> arms;  ///< in their order
};

/// @throws std::invalid_argument  there is something that this engine does not have
[[nodiscard]] CellModel cell_model(const WorldParameters& parameters, const std::vector<ArmPlan>& plans);

}  // namespace mrroc::sim
