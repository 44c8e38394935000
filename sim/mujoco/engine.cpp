#include <cstdio>
#include <cstdlib>

#include "sim/engine.hpp"
#include "sim/mujoco/arm.hpp"
#include "sim/mujoco/model.hpp"

namespace mrroc::sim {
namespace {

/// By itself MuJoCo writes what it has to say into a file in the working directory. A state that is not finite is seen in
/// the readings; a call that it refuses is an error of this program.
void silence() {
  mju_user_warning = [](const char*) {};
  mju_user_error = [](const char* text) {
    std::fprintf(stderr, "MuJoCo: %s\n", text);
    std::abort();
  };
}

class MujocoEngine final : public Engine {
 public:
  MujocoEngine(const WorldParameters& p, CellModel cell) : cell_(std::move(cell)) {
    find_motion();
    for (std::size_t k = 0; k < cell_.arms.size(); ++k)
      arms_.push_back(
          std::make_unique<MujocoArm>(cell_.arms[k], *cell_.model, *cell_.data, p.arms[k].motors));
  }

  ArmMechanics& arm(int k) override { return *arms_.at(static_cast<std::size_t>(k)); }

  void integrate() override {
    mj_step(cell_.model.get(), cell_.data.get());
    for (const auto& arm : arms_) arm->take_over();
    find_motion();
  }

 private:
  /// Poses and velocities that belong to the present joints: a step computes them at its beginning only.
  void find_motion() {
    mj_kinematics(cell_.model.get(), cell_.data.get());
    mj_comPos(cell_.model.get(), cell_.data.get());
    mj_comVel(cell_.model.get(), cell_.data.get());
  }

  CellModel cell_;
  std::vector<std::unique_ptr<MujocoArm>> arms_;
};

}  // namespace

bool has_mujoco() { return true; }

std::unique_ptr<Engine> mujoco_engine(const WorldParameters& parameters, const std::vector<ArmPlan>& plans) {
  silence();
  return std::make_unique<MujocoEngine>(parameters, cell_model(parameters, plans));
}

}  // namespace mrroc::sim
