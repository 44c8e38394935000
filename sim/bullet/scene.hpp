// The Bullet world and all objects that it needs, owned in the right order.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "base/pose.hpp"
#include "sim/artefact.hpp"
#include "sim/bullet/contact_solver.hpp"
#include "sim/plate.hpp"

namespace mrroc::sim {

/// Pairs of bodies that may touch: pens touch paper, grippers, palms and the floor touch a cube or a free body, nothing
/// else touches anything.
inline constexpr int kPenGroup = 64;
inline constexpr int kPaperGroup = 128;
inline constexpr int kGripperGroup = 256;
inline constexpr int kCubeGroup = 512;
inline constexpr int kFloorGroup = 1024;

/// The dynamics with a word in between: after contacts have been found, before forces are. For hands that turn what
/// they hold, contacts are told differently, as contacts_turn says.
class ObservedDynamics final : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;
  /// Called there; may be empty.
  std::function<void()> contacts_found;
  /// Bullet keeps a point of contact with the normal that it had in the world when it was found, until the bodies part
  /// there: it would glue a hand to a cube that it has turned, so points are found anew in every integration. And it
  /// takes the velocity of each body at its own surface, which the other one is pressed into: two bodies that turn
  /// together would seem to slip by angular velocity times depth, and friction would turn the cube in the hand. Both
  /// are taken in the middle between the surfaces.
  bool contacts_turn{};

  void performDiscreteCollisionDetection() override {
    if (contacts_turn) each_manifold([](btPersistentManifold& manifold) { manifold.clearManifold(); });
    btMultiBodyDynamicsWorld::performDiscreteCollisionDetection();
    if (contacts_turn)
      each_manifold([](btPersistentManifold& manifold) {
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
          btManifoldPoint& point = manifold.getContactPoint(k);
          point.m_positionWorldOnA = point.m_positionWorldOnB =
              (point.m_positionWorldOnA + point.m_positionWorldOnB) / 2;
        }
      });
  }

 protected:
  void calculateSimulationIslands() override {
    if (contacts_found) contacts_found();
    btMultiBodyDynamicsWorld::calculateSimulationIslands();
  }

 private:
  template <class Do>
  void each_manifold(Do what) {
    for (int m = 0; m < getDispatcher()->getNumManifolds(); ++m)
      what(*getDispatcher()->getManifoldByIndexInternal(m));
  }
};

/// Gravity, contacts and the solver. Bodies of arms are added to dynamics() by their owners, which outlive no
/// scene.
class Scene {
 public:
  /// @param solver_iterations  at least 1
  explicit Scene(int solver_iterations);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Adds a table whose top is the xy plane of the pose.
  /// @param T_UP  middle of the table's top in the world @param edge [m]
  void add_table(const Pose& T_UP, double edge);

  /// Adds a plate that lies on a table.
  /// @param T_UP  of the table, as above
  void add_plate(const Pose& T_UP, const PlateParameters& plate);

  /// Adds balls that stand still, for pens to touch.
  void add_artefact(const ArtefactParameters& artefact);

  /// Adds the plate of a pedestal for a free body: square, level, with a square opening in its middle.
  /// @param top  middle of its upper side in the world [m] @param edge, opening [m]
  void add_pedestal(const Vector3& top, double edge, double opening);
  /// @return whether it is a part of a pedestal
  [[nodiscard]] bool is_pedestal(const btCollisionObject* object) const {
    return std::ranges::find(pedestal_, object) != pedestal_.end();
  }

  /// Adds the floor, for a cube or a free body to fall on, tells contacts as it is right for hands that turn the cube, takes
  /// friction in two directions, since in one alone a held cube turns in its pads, and lets the solver remember.
  void prepare_for_grasping();

  /// Integrates once. @param h [s]
  void integrate(double h) { dynamics_.stepSimulation(h, 0, h); }

  /// @return where bodies of arms and their constraints are added
  btMultiBodyDynamicsWorld& dynamics() { return dynamics_; }
  /// Calls in every integration after contacts have been found, before forces are.
  void on_contacts(std::function<void()> call) { dynamics_.contacts_found = std::move(call); }
  /// A body and its contacts were made anew.
  void forget_impulses() { solver_.forget(); }
  /// @return acceleration in the world [m/s^2]
  [[nodiscard]] Vector3 gravity() const;

 private:
  void add_body(std::unique_ptr<btCollisionShape> shape, const Pose& T_U, int group = kPaperGroup,
                int mask = kPenGroup);

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  ContactSolver solver_;
  ObservedDynamics dynamics_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> bodies_;
  std::vector<const btCollisionObject*> pedestal_;  // some of them
};

}  // namespace mrroc::sim
