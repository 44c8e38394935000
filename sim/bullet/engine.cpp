#include "sim/engine.hpp"

#include <algorithm>

#include "sim/bullet/arm_mechanics.hpp"
#include "sim/bullet/cube_body.hpp"
#include "sim/bullet/free_body.hpp"
#include "sim/bullet/scene.hpp"

namespace mrroc::sim {
namespace {

class BulletEngine final : public Engine {
 public:
  BulletEngine(const WorldParameters& p, const std::vector<ArmPlan>& plans)
      : h_(kStep / p.substeps), share_(1.0 / p.substeps), scene_(p.solver_iterations) {
    const bool on_belt =
        std::ranges::any_of(p.arms, [](const ArmParameters& arm) { return arm.type->belt.has_value(); });
    for (std::size_t k = 0; k < p.arms.size(); ++k) {
      const ArmParameters& arm = p.arms[k];
      if (!on_belt) scene_.add_table(arm.T_UB * arm.paper.T_0P, kTableEdge);
      scene_.add_plate(arm.T_UB * arm.paper.T_0P, arm.plate);
      arms_.push_back(std::make_unique<BulletArm>(arm, plans[k], scene_, h_));
    }
    if (p.artefact) scene_.add_artefact(*p.artefact);
    if (!p.cube && !p.free_body) {
      scene_.on_contacts([this] {
        for (const auto& each : arms_) each->drop_stale_contacts();
      });
      return;
    }
    scene_.prepare_for_grasping();
    scene_.on_contacts([this] {
      for (const auto& each : arms_) each->share_stiffness();
    });
    if (p.free_body) add_free_body(p);
    if (!p.cube) return;
    cube_ =
        std::make_unique<CubeBody>(*p.cube, bullet_arm(p.cube->held_by).T_UE() * p.cube->T_EC, scene_, h_);
  }

  ArmMechanics& arm(int k) override { return bullet_arm(k); }

  void begin_step() override {
    if (cube_) cube_->begin_step();
    if (free_body_) free_body_->begin_step();
  }
  void integrate() override {
    if (cube_) cube_->push();
    if (free_body_) free_body_->push();
    scene_.integrate(h_);
  }
  void follow() override {
    if (cube_) cube_->follow(share_);
    if (free_body_) free_body_->follow(share_);
  }
  void end_step() override {
    if (cube_) cube_->end_step();
    if (free_body_) free_body_->end_step();
  }

  [[nodiscard]] const CubeTruth* cube() const override { return cube_ ? &cube_->truth() : nullptr; }
  [[nodiscard]] const FreeBodyTruth* free_body() const override {
    return free_body_ ? &free_body_->truth() : nullptr;
  }
  void set_face_friction(cube::Face face, const FaceFriction& friction) override {
    if (cube_) cube_->set_friction(face, friction);
  }
  bool lay_cube(int axis) override { return cube_ && cube_->lay(axis); }

  void visit_state(const std::function<void(double)>& take) const override {
    if (cube_) cube_->visit_state(take);
    if (free_body_) free_body_->visit_state(take);
  }

 private:
  BulletArm& bullet_arm(int k) { return *arms_.at(static_cast<std::size_t>(k)); }

  void add_free_body(const WorldParameters& p) {
    std::vector<PalmBearer> bearers;
    for (std::size_t k = 0; k < arms_.size(); ++k)
      bearers.push_back({.body = arms_[k]->body(),
                         .turning = [arm = arms_[k].get()] { return arm->tool().angular_velocity; },
                         .friction = p.arms[k].palm ? p.arms[k].palm->friction : 0});
    free_body_ = std::make_unique<FreeBody>(*p.free_body, std::move(bearers), scene_, h_);
  }

  double h_;
  double share_;  // of an integration in the means over a step
  Scene scene_;
  std::vector<std::unique_ptr<BulletArm>> arms_;
  std::unique_ptr<CubeBody> cube_;
  std::unique_ptr<FreeBody> free_body_;
};

}  // namespace

std::unique_ptr<Engine> bullet_engine(const WorldParameters& parameters, const std::vector<ArmPlan>& plans) {
  return std::make_unique<BulletEngine>(parameters, plans);
}

}  // namespace mrroc::sim
