// Convex solids and the solids of an arm's links, with a test whether two solids touch. Uses Bullet's
// collision detection, which this header hides.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/axes.hpp"
#include "base/pose.hpp"
#include "base/shape.hpp"
#include "robots/catalogue.hpp"

namespace mrroc::sim {

/// Solids with numbers from 0. For one thread.
class CollisionSolids {
 public:
  CollisionSolids();
  ~CollisionSolids();
  CollisionSolids(const CollisionSolids&) = delete;
  CollisionSolids& operator=(const CollisionSolids&) = delete;

  /// @param shape  box, cylinder (its axis is z) or sphere @param size  along x, y, z [m] @return its number
  std::size_t add(Shape shape, const Vector3& size);
  /// @param corners  of the convex hull [m] @return its number
  std::size_t add_hull(std::span<const Vector3> corners);
  /// @param T_U  middle of the solid in the world, of a hull its frame
  void place(std::size_t solid, const Pose& T_U);
  /// Call this after all have been placed, before touch().
  void find_bounds();
  /// @return whether two solids touch or overlap
  [[nodiscard]] bool touch(std::size_t a, std::size_t b);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A solid of an arm's description.
struct LinkSolid {
  std::string link;               ///< name in the description
  int place{};                    ///< in the chain of the arm, 0: base
  Shape shape{};                  ///< its form
  Vector3 size{Vector3::Zero()};  ///< [m]
};

/// An arm with a gripper as its description has it, without what its tool carries.
class LinkChain {
 public:
  /// @param type  lives on @param model  number of the kinematic model @param T_UB  its base in the world
  LinkChain(const robots::RobotType& type, int model, const Pose& T_UB);
  ~LinkChain();
  LinkChain(LinkChain&&) noexcept;
  LinkChain& operator=(LinkChain&&) noexcept;

  /// @return the solids of the links
  [[nodiscard]] const std::vector<LinkSolid>& solids() const;
  /// @return number of joints
  [[nodiscard]] int joints() const;
  /// @param joints  [rad, track m]
  void set_joints(const AxisVector& joints);
  /// @return middle of a solid in the world
  [[nodiscard]] Pose place(std::size_t solid) const;
  /// @return E in the world
  [[nodiscard]] Pose T_UE() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
